//! Each fault and its cause: the flag, the number, what stays of it, and which of several counts.

use adsdv_spec::messages::AsState;
use adsdv_spec::{Atom, Choice, Fault, Faults, Inputs, Machine, Reading};

use super::{Walk, braking_by, terms, test, walk_cycle, words};
use crate::protocol::{Domain, INPUTS, InputField, ShownField};
use crate::suite::{Kind, Test};

/// The tests of what opens the shutdown circuit, and of what 520h tells of it.
pub(super) fn tests(machine: &Machine) -> Vec<Test> {
    let mut tests: Vec<Test> = causes(machine).flat_map(|field| of_cause(machine, field)).collect();
    tests.extend(switches(machine));
    tests.extend(warnings(machine));
    tests.extend(several(machine));
    tests.extend(levels(machine));
    tests
}

/// The inputs each of which is a fault by itself, while a master switch is on.
fn causes(machine: &Machine) -> impl Iterator<Item = &'static InputField> {
    let thresholds = machine.edition().rules.thresholds;
    INPUTS.iter().filter(move |field| {
        let mut inputs = Inputs { asms: true, ..Inputs::default() };
        field.domain == Domain::Flag
            && (field.set)(&mut inputs, 1)
            && !inputs.observe(&thresholds).faults().is_empty()
    })
}

/// The requirements of section 3.5 behind what opens the shutdown circuit; those of other inputs are the fault's.
const OF_3_5: [(&InputField, &str); 7] = [
    (InputField::of("remote_estop"), "RTE-2"),
    (InputField::of("res_link_lost"), "RTE-3"),
    (InputField::of("vehicle_estop"), "RTE-4"),
    (InputField::of("crash_sensor"), "RTE-5"),
    (InputField::of("critical_fault"), "RTE-6"),
    (InputField::of("bms_fault"), "RTE-7"),
    (InputField::of("mpp_dongle_removed"), "RTE-8"),
];

// Another one does not compile until its requirement stands above.
const _: () = {
    let (mut place, mut found) = (0, 0);
    while place < INPUTS.len() {
        if INPUTS[place].part.eq_ignore_ascii_case("sdc") {
            let same = found < OF_3_5.len() && OF_3_5[found].0.key.eq_ignore_ascii_case(INPUTS[place].key);
            assert!(same, "each input that opens the shutdown circuit has a requirement, in their order");
            found += 1;
        }
        place += 1;
    }
    assert!(found == OF_3_5.len(), "each of them is an input that opens the shutdown circuit");
};

fn cause_of_3_5(key: &str) -> Option<&'static str> {
    OF_3_5.iter().find(|(field, _)| field.key == key).map(|(_, id)| *id)
}

/// One cause: live in AS_OFF, where it goes with its input, and in AS_READY, where it leads to EMERGENCY_BRAKE and stays.
fn of_cause(machine: &Machine, field: &'static InputField) -> Vec<Test> {
    let key = field.key;
    let mut inputs = Inputs { asms: true, ..Inputs::default() };
    (field.set)(&mut inputs, 1);
    let faults = inputs.observe(&machine.edition().rules.thresholds).faults();
    let set = |value: i32| {
        move |inputs: &mut Inputs| {
            (field.set)(inputs, value);
        }
    };
    let ids =
        || faults.iter().map(Fault::requirement).chain(cause_of_3_5(key)).chain(["MSG-50", "MSG-64", "D-40"]);
    let live = Walk::new(machine)
        .set(|inputs| inputs.tsms = true)
        .step(walk_cycle(machine), set(1))
        .step(walk_cycle(machine), set(0));
    let mut tests = vec![
        test(
            Kind::Fault,
            format!("fault-{key}-live"),
            format!("{key} shows in AS_OFF while it is there"),
            "2.2",
            live,
        )
        .checks(ids().chain(["D-17"])),
    ];
    for state in [AsState::Ready, AsState::Driving, AsState::Finished] {
        let stays =
            Walk::to(machine, state).step(walk_cycle(machine), set(1)).step(walk_cycle(machine), set(0));
        let name = format!("fault-{key}-in-{state}");
        tests.push(if stays.state() == AsState::EmergencyBrake {
            let about =
                format!("{key} in {state} leads to EMERGENCY_BRAKE, and its cause stays when it goes");
            test(Kind::Fault, name, about, "3.5", stays).checks(ids().chain(["D-12", "D-14", "D-15", "D-17"]))
        } else {
            let about = format!("{key} in {state} shows while it is there, and is no reason to brake");
            test(Kind::Fault, name, about, "2.2", stays).checks(ids().chain(["D-17"]))
        });
    }
    if faults == Faults::NONE.with(Fault::ChargeProcedureFault) {
        let off = Walk::new(machine).step(walk_cycle(machine), set(1));
        let about = format!("{key} is no fault while both master switches are off");
        tests.push(
            test(Kind::Fault, format!("fault-{key}-with-switches-off"), about, "2.2", off).checks(["MSG-62"]),
        );
    }
    tests
}

/// The switches that are reasons to brake without a number of their own.
fn switches(machine: &Machine) -> Vec<Test> {
    [Atom::Asms, Atom::GoOn]
        .map(|atom| {
            let walk = Walk::to(machine, AsState::Driving).show(atom, false).cycle().show(atom, true).cycle();
            let about = format!("{} in AS_DRIVING shows as an open circuit", words(machine, atom, false));
            let rows = braking_by(machine, atom).flat_map(|term| term.cites.requirements).copied();
            test(Kind::Fault, format!("fault-{atom}-off"), about, "3.7", walk)
                .checks(rows.chain(["D-13", "D-17"]))
        })
        .into()
}

/// Where it is settled that FINISHED and NEUTRAL count while they last: each is there before the vehicle moves.
fn levels(machine: &Machine) -> Vec<Test> {
    if machine.edition().choices.has(Choice::FaultEdge) {
        return Vec::new();
    }
    let level = |atom: Atom| {
        let walk = Walk::to(machine, AsState::Driving).show(Atom::AtRest, false).show(atom, true).cycle();
        let walk = walk.show(Atom::Moving, true).cycle();
        let rows = braking_by(machine, atom).flat_map(|term| term.cites.requirements).copied();
        let about = format!("{} before the vehicle moves", words(machine, atom, true));
        test(Kind::Fault, format!("fault-{atom}-level"), about, "4", walk)
            .checks(rows.chain([Reading::FaultTrigger.decision()]))
    };
    [Atom::MissionFinished, Atom::DirectionNeutral].map(level).into()
}

/// The warnings of 520h.
fn warnings(machine: &Machine) -> Vec<Test> {
    const WARNING: &ShownField = ShownField::of("warning_status");
    const OF_INPUTS: [(&InputField, &ShownField); 2] = [
        (InputField::of("batt_temp_high"), ShownField::of("warn_batt_temp_high")),
        (InputField::of("batt_soc_low"), ShownField::of("warn_batt_soc_low")),
    ];
    OF_INPUTS
        .map(|(input, shown)| {
            let key = input.key;
            let walk = Walk::to(machine, AsState::Ready).step(walk_cycle(machine), |inputs| {
                (input.set)(inputs, 1);
            });
            let about = format!("{key} is a warning, and no reason to brake");
            let ids = shown.requirements.iter().chain(WARNING.requirements).copied();
            test(Kind::Fault, format!("warning-{key}"), about, "2.2", walk).checks(ids)
        })
        .into()
}

/// Two faults at once, of which the lower number counts; and one after the other, of which the first does.
fn several(machine: &Machine) -> Vec<Test> {
    let faults: Vec<Fault> = Faults::OPENING.with(Fault::AiComputerRequest).iter().collect();
    let pairs = faults.iter().zip(faults.iter().skip(1));
    // Where each of them is a reason to brake.
    let from_ready =
        terms(machine).any(|(row, term)| row.from == AsState::Ready && term.on.has(Atom::AiEstop));
    let state = if from_ready { AsState::Ready } else { AsState::Driving };
    let mut tests: Vec<Test> = pairs
        .map(|(&low, &high)| {
            let at_once = Walk::to(machine, state).step(walk_cycle(machine), |inputs| {
                inputs.show_fault(low, true);
                inputs.show_fault(high, true);
            });
            let about = format!("{low} and {high} at once: the lower number is the cause");
            test(
                Kind::Fault,
                format!("faults-{}-and-{}", low.cause().raw(), high.cause().raw()),
                about,
                "2.2",
                at_once,
            )
            .checks(["MSG-64", "D-16"])
        })
        .collect();
    if let (Some(&first), Some(&last)) = (faults.last(), faults.first()) {
        let later = Walk::to(machine, state)
            .step(walk_cycle(machine), |inputs| inputs.show_fault(first, true))
            .step(walk_cycle(machine), |inputs| inputs.show_fault(last, true));
        let about = format!("{last} comes after {first}: the first cause stays");
        tests.push(
            test(Kind::Fault, "faults-one-after-the-other", about, "2.2", later).checks(["MSG-64", "D-15"]),
        );
    }
    tests
}
