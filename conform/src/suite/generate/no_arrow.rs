//! What Figure 2 has no arrow for: the state stays, whatever leads from other states to others.

use adsdv_spec::messages::{AsState, DirectionRequest, EbsState, MissionStatus};
use adsdv_spec::{Atom, Machine};

use super::{Walk, attempt, terms, test, walk_cycle};
use crate::suite::{Kind, Test};

/// The tests of the states that are not left.
pub(super) fn tests(machine: &Machine) -> Vec<Test> {
    let mut tests: Vec<Test> = AsState::ALL.map(|state| of_other_states(machine, state)).into();
    let entered = AsState::ALL.into_iter().filter(|&state| state != AsState::Off);
    tests.extend(entered.map(|state| of_what_led_there(machine, state)));
    let elsewhere = AsState::ALL.into_iter().filter(|&state| state != AsState::Driving);
    tests.extend(elsewhere.map(|state| of_driving(machine, state)));
    tests
}

/// For each state to which there is no arrow from this one: what leads there from another.
fn of_other_states(machine: &Machine, state: AsState) -> Test {
    let rows = machine.edition().rules.table.rows();
    let mut walk = Walk::to(machine, state);
    let usual = walk.inputs();
    let mut tried: Vec<AsState> = rows.iter().filter(|row| row.from == state).map(|row| row.to).collect();
    tried.push(state);
    for (row, term) in terms(machine) {
        if tried.contains(&row.to) {
            continue;
        }
        let mut there = walk.clone().set(|inputs| *inputs = usual);
        if term.on.has(Atom::DwellElapsed) {
            // "Go" is seen off for as long as AS_READY would have to last.
            let dwell = machine.edition().rules.timing.ready_dwell_ms;
            there = there.show(Atom::GoOn, false).step(dwell.into(), |_| {});
        }
        let there = attempt(machine, there, term, None);
        // Where it is the condition of an arrow of this state, that arrow has a test.
        if there.state() == state {
            walk = there;
            tried.push(row.to);
        }
    }
    let about = format!("what leads to other states from elsewhere does not lead there from {state}");
    test(Kind::NoArrow, format!("no-arrow-from-{state}"), about, "3", walk).checks(["SM-18"])
}

/// What AS_READY asks for and no arrow of another state does: TSMS, and an EBS that is armed.
fn of_what_led_there(machine: &Machine, state: AsState) -> Test {
    let cycle = walk_cycle(machine);
    // Where one that cannot brake is a reason to leave the state, one that brakes is not armed either.
    let asks = terms(machine).any(|(row, term)| row.from == state && term.on.has(Atom::EbsUnavailable));
    let ebs = if asks { EbsState::Triggered } else { EbsState::Unavailable };
    let walk = Walk::to(machine, state).step(cycle, |inputs| inputs.tsms = false).step(cycle, |inputs| {
        inputs.tsms = true;
        inputs.ebs = ebs;
    });
    let about = format!("TSMS goes off in {state}, and then the EBS is not armed: the state stays");
    test(Kind::NoArrow, format!("no-tsms-no-ebs-in-{state}"), about, "3.1", walk).checks(["D-36"])
}

/// What is an implausible operating condition in AS_DRIVING only.
fn of_driving(machine: &Machine, state: AsState) -> Test {
    let walk = Walk::to(machine, state)
        .set(|inputs| {
            inputs.ai.status.mission_status = MissionStatus::Finished;
            inputs.ai.status.direction_request = DirectionRequest::Neutral;
        })
        .show(Atom::Moving, true)
        .cycle();
    let about = format!("FINISHED and NEUTRAL while moving are no faults in {state}");
    test(Kind::NoArrow, format!("moving-in-{state}"), about, "4", walk).checks(["D-27"])
}
