//! The vehicle of 2026: its reference conforms, and what is wrong in the outputs that its database added breaks what asks for
//! them. What it has of version 4.0 is tried there.

use adsdv_conform::{ConformOptions, ConformReport, Outcome, conform};
use adsdv_spec::{Choice, Edition, Inputs, Machine, Reading};
use serde_json::json;

use crate::erring::{Erring, Outputs};
use crate::programs::{TIMEOUT, example, machine, tests_of};

const EDITION: Edition = Edition::V2026;
const REFERENCE: Machine = Machine::new(EDITION, EDITION.readings);

/// The suite alone, by the default readings: much faster, and the readings are those of 4.0.
fn by_default() -> ConformOptions {
    ConformOptions {
        runs: 0,
        possible: EDITION.readings.choices(),
        strict: true,
        ..ConformOptions::of(&EDITION)
    }
}

/// The requirements that came to this.
fn that(report: &ConformReport, outcome: Outcome) -> Vec<&str> {
    let those = report.requirements.iter().filter(|one| one.outcome == outcome);
    those.map(|one| one.id.as_str()).collect()
}

#[test]
fn the_reference_conforms_and_follows_every_default() {
    let options = ConformOptions { runs: 40, strict: true, ..ConformOptions::of(&EDITION) };
    let report = machine(&REFERENCE, &options);
    assert!(report.conforms() && report.failed_tests == 0 && report.failed_runs == 0);
    assert_eq!((report.readings, report.not_shown.len()), (EDITION.readings, 0));
    let torque = report.follows.iter().find(|follows| follows.reading == Reading::TorqueControl);
    assert_eq!(torque.expect("a question").possible, [Choice::TorqueNever]);
    let passed = that(&report, Outcome::Pass);
    assert_eq!(passed.len(), report.requirements.len());
    for id in ["MSG-106", "MSG-107", "MSG-108", "D-71", "D-72", "D-73", "IMP-8", "DTE-9", "MSG-85"] {
        assert!(passed.contains(&id), "{id}");
    }
    // What an answer is by default is no requirement, and these are of other editions.
    for id in ["D-53", "D-67", "MSG-109", "D-2", "HS-9"] {
        assert!(!passed.contains(&id), "{id}");
    }
}

/// Beside the reference: the other answer is found by the suite, and conforms.
#[test]
fn a_vehicle_whose_motors_are_always_in_torque_control_conforms_and_is_recognised() {
    let readings = EDITION.readings.with(Choice::TorqueAlways);
    let options = ConformOptions { runs: 0, strict: true, ..ConformOptions::of(&EDITION) };
    let report = machine(&Machine::new(EDITION, readings), &options);
    assert!(report.conforms());
    assert_eq!(report.readings, readings);
}

#[test]
fn through_the_pipe_it_conforms_too() {
    for (name, args) in [("adapter", &[][..]), ("mutant", &["--edition", "2026"])] {
        let report = example(name, args, &by_default(), TIMEOUT).expect("it answers");
        assert!(report.conforms() && report.not_shown.is_empty(), "{name}: {:?}", report.failures);
    }
}

/// A vehicle that tells its start as AS_INIT says the same as one that tells it as AS_OFF.
#[test]
fn a_program_that_begins_in_as_init_conforms() {
    let begins = |place: usize, inputs: &Inputs, outputs: &mut Outputs| {
        if place == 0 && !inputs.tsms && outputs["as_state"] == "AS_OFF" {
            outputs.insert("as_state".to_owned(), json!("AS_INIT"));
        }
    };
    let mut program = Erring { tampers: begins, ..Erring::new(&REFERENCE) };
    let report = conform(&mut program, tests_of(&EDITION), &by_default(), &mut |_| {}).expect("it answers");
    assert!(report.conforms(), "{:?}", report.failures);
}

#[test]
fn what_is_wrong_in_a_state_of_the_vehicle_breaks_what_asks_for_that_alone() {
    type Tampers = fn(usize, &Inputs, &mut Outputs);
    let wrong: [(Tampers, &[&str]); 5] = [
        (
            |_, inputs, outputs| {
                if inputs.reports.charging {
                    outputs["op_state"] = json!("OP_AUTO");
                }
            },
            &["MSG-106", "D-71"],
        ),
        (|_, _, outputs| outputs["op_state"] = json!("OP_INIT"), &["MSG-106", "D-71"]),
        (|_, _, outputs| outputs["ts_state"] = json!("TS_FAULT"), &["MSG-107", "D-72"]),
        // The VCU does not show that the EBS brakes.
        (
            |_, inputs, outputs| {
                if outputs["as_state"] == "EMERGENCY_BRAKE" {
                    outputs["ebs_state"] = json!(if inputs.tsms { "EBS_ARMED" } else { "EBS_INIT" });
                }
            },
            &["MSG-108", "D-73"],
        ),
        // The numbers of STATUS_EBS of 524h.
        (|_, inputs, outputs| outputs["ebs_state"] = json!(inputs.ebs.raw()), &["MSG-108", "D-73"]),
    ];
    for (tampers, broken) in wrong {
        let mut program = Erring { tampers, ..Erring::new(&REFERENCE) };
        let report =
            conform(&mut program, tests_of(&EDITION), &by_default(), &mut |_| {}).expect("it answers");
        assert_eq!(that(&report, Outcome::Fail), broken);
        assert!(!report.conforms());
    }
}

/// What is not shown is not checked, and is no failure.
#[test]
fn a_program_that_shows_no_state_of_the_vehicle_is_not_judged_by_them() {
    let tampers: fn(usize, &Inputs, &mut Outputs) = |_, _, outputs| {
        for key in ["op_state", "ts_state", "ebs_state"] {
            outputs.remove(key);
        }
    };
    let mut program = Erring { tampers, ..Erring::new(&REFERENCE) };
    let report = conform(&mut program, tests_of(&EDITION), &by_default(), &mut |_| {}).expect("it answers");
    assert!(report.failures.is_empty());
    let not_checked = that(&report, Outcome::NotChecked);
    assert_eq!(not_checked, ["MSG-106", "MSG-107", "MSG-108", "D-71", "D-72", "D-73"]);
    assert_eq!(report.not_shown, ["op_state", "ts_state", "ebs_state"]);
}

/// Steering of 4.0 ends at 21 degrees; that of 2026 goes on to 30.
#[test]
fn a_vehicle_that_steers_no_further_than_that_of_4_0_breaks_what_asks_for_the_steering() {
    let tampers: fn(usize, &Inputs, &mut Outputs) = |_, _, outputs| {
        if let Some(angle) = outputs["steer"].as_i64() {
            outputs["steer"] = json!(angle.clamp(-210, 210));
        }
    };
    let mut program = Erring { tampers, ..Erring::new(&REFERENCE) };
    let report = conform(&mut program, tests_of(&EDITION), &by_default(), &mut |_| {}).expect("it answers");
    assert_eq!(that(&report, Outcome::Fail), ["MSG-25", "D-21"]);
}
