//! What tells the answers to each open question apart.

use adsdv_spec::messages::AsState;
use adsdv_spec::{Atom, Choice, Machine};

use super::{Walk, rows, terms, test, under, walk_cycle};
use crate::suite::{Kind, Scenario, Test};

/// For each choice that is not the default, what it adds to the table, and one scenario that it does otherwise.
pub(super) fn tests(machine: &Machine) -> Vec<Test> {
    let others = machine.edition().alternatives();
    others.iter().flat_map(|choice| of_other(machine, choice)).collect()
}

fn of_other(machine: &Machine, choice: Choice) -> Vec<Test> {
    let other = under(machine, choice);
    let named = |test: Test| Test {
        name: format!("{choice}/{}", test.name),
        kind: Kind::Reading,
        reading: Some(choice.reading()),
        ..test.checks([choice.reading().decision()])
    };
    let own = terms(&other).filter(|(_, term)| term.readings.has(choice));
    let mut tests: Vec<Test> = own.flat_map(|(row, term)| rows::of(&other, row, term)).map(named).collect();
    tests.extend(distinguishing(machine, &other, choice).map(named));
    tests
}

/// The shortest of some scenarios that the two machines take otherwise.
fn distinguishing(machine: &Machine, other: &Machine, choice: Choice) -> Option<Test> {
    let candidates = candidates(machine).into_iter();
    let differs = |scenario: &Scenario| scenario.shown(machine).ne(scenario.shown(other));
    let shortest = candidates.filter(|walk| differs(&walk.clone().scenario())).min_by_key(|walk| {
        let scenario = walk.clone().scenario();
        (scenario.steps.len(), scenario.steps.iter().map(|step| u64::from(step.dt_ms)).sum::<u64>())
    })?;
    let about = format!("what the answer {choice} does otherwise than the default");
    Some(test(Kind::Reading, "otherwise", about, choice.reading().section(), shortest))
}

/// Scenarios in which an answer may show.
fn candidates(machine: &Machine) -> Vec<Walk<'_>> {
    let limit = u32::from(machine.edition().rules.timing.handshake_ms);
    let cycle = walk_cycle(machine);
    let mut walks = Vec::new();
    for state in AsState::ALL {
        let at = || Walk::to(machine, state);
        walks.push(at().step(cycle, |inputs| {
            inputs.sdc.vehicle_estop = true;
            inputs.asms = false;
        }));
        walks.push(at().step(cycle, |inputs| inputs.ai.status.estop_request = true));
        walks.push(at().step(cycle, |inputs| inputs.go = !inputs.go));
        walks.push(at().cycle().answering(false).step(limit, |_| {}));
    }
    walks.push(Walk::new(machine).cycle());
    // "Go" is seen off before the five seconds are over, and comes on right after.
    let dwell = u32::from(machine.edition().rules.timing.ready_dwell_ms);
    walks.push(Walk::to(machine, AsState::Ready).step(dwell, |inputs| inputs.go = true));
    // Everything is as AS_READY asks for, after an emergency.
    walks.push(Walk::after_an_emergency(machine).step(cycle, |inputs| inputs.asms = true));
    // An emergency and the end of the mission at once.
    walks.push(Walk::to(machine, AsState::Driving).step(cycle, |inputs| {
        inputs.ai.status.mission_status = adsdv_spec::messages::MissionStatus::Finished;
        inputs.go = false;
    }));
    // The battery, torque with a brake, and messages that nobody watches.
    walks.push(Walk::to(machine, AsState::Ready).step(cycle, |inputs| inputs.sdc.bms_fault = true));
    walks.push(
        Walk::to(machine, AsState::Driving)
            .show(Atom::FrontTorqueZero, false)
            .show(Atom::BrakeRequestZero, false)
            .cycle(),
    );
    walks.push(Walk::new(machine).show(Atom::AiMessagesMissed, true).cycle());
    walks
}
