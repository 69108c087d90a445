//! Which requirements a program breaks: those about what is wrong, and no others.

use adsdv_conform::suite::{Kind, Test};
use adsdv_conform::{ConformOptions, ConformReport, Outcome, conform};
use adsdv_spec::{Choice, Edition, Inputs, Machine, Mutation, Readings};
use serde_json::json;

use crate::erring::{Erring, Outputs};
use crate::programs::{TIMEOUT, example, machine, suite_only, tests};

fn tampered(
    tests: &[Test],
    options: &ConformOptions,
    tampers: fn(usize, &Inputs, &mut Outputs),
) -> ConformReport {
    let mut vcu = Erring { tampers, ..Erring::new(&Machine::REFERENCE) };
    conform(&mut vcu, tests, options, &mut |_| {}).expect("it answers")
}

fn flip(outputs: &mut Outputs, key: &str) {
    let flag = outputs[key].as_bool().expect("a flag");
    outputs.insert(key.to_owned(), json!(!flag));
}

/// The requirements with an outcome.
fn of(report: &ConformReport, outcome: Outcome) -> Vec<&str> {
    report.requirements.iter().filter(|one| one.outcome == outcome).map(|one| one.id.as_str()).collect()
}

fn failed(report: &ConformReport) -> Vec<&str> {
    of(report, Outcome::Fail)
}

#[test]
fn one_wrong_output_breaks_what_is_about_it() {
    let report = tampered(tests(), &suite_only(), |_, _, outputs| flip(outputs, "as_switch_status"));
    assert_eq!(report.failed_tests, tests().len());
    assert_eq!(failed(&report), ["MSG-44"]);
    assert!(of(&report, Outcome::NotChecked).is_empty());
    let broken = report.requirements.iter().find(|one| one.id == "MSG-44").expect("it is there");
    assert_eq!(broken.failed.len(), tests().len(), "every test shows it, whether it names it or not");

    let ami_state = |_: usize, _: &Inputs, outputs: &mut Outputs| {
        outputs.insert("ami_state".to_owned(), json!("SKIDPAD"));
    };
    assert_eq!(failed(&tampered(tests(), &suite_only(), ami_state)), ["MSG-49", "RDY-6"]);
    let flag = |_: usize, _: &Inputs, outputs: &mut Outputs| flip(outputs, "bms_fault");
    assert_eq!(failed(&tampered(tests(), &suite_only(), flag)), ["MSG-63", "D-17"]);
}

#[test]
fn what_is_wrong_in_one_state_breaks_what_is_about_that_state() {
    let driving = |_: usize, _: &Inputs, outputs: &mut Outputs| {
        if outputs["as_state"] == "AS_DRIVING" {
            outputs.insert("front_axle_trq".to_owned(), json!(7));
        }
    };
    let report = tampered(tests(), &suite_only(), driving);
    let torque = failed(&report);
    assert!(torque.contains(&"D-21"), "{torque:?}");
    assert!(torque.iter().all(|id| ["MSG-18", "D-21"].contains(id)), "{torque:?}");
    let passed = of(&report, Outcome::Pass);
    assert!(
        ["DRV-2", "FIN-5"].iter().all(|id| passed.contains(id)),
        "in other states it is right: {passed:?}"
    );
}

#[test]
fn a_wrong_output_does_not_hide_which_readings_are_followed() {
    for choice in [Choice::FaultEdge, Choice::EstopDriving, Choice::GoEdgeEnough] {
        let readings = Readings::DEFAULT.with(choice);
        let mut vcu = Erring {
            tampers: |_, _, outputs| flip(outputs, "as_switch_status"),
            ..Erring::new(&Machine::new(*Edition::DEFAULT, readings))
        };
        let report = conform(&mut vcu, tests(), &suite_only(), &mut |_| {}).expect("it answers");
        assert_eq!((report.readings, failed(&report)), (readings, vec!["MSG-44"]));
        let follows = report.follows.iter().find(|one| one.reading == choice.reading()).expect("it is there");
        assert_eq!((follows.possible.as_slice(), follows.mixes.len()), (&[choice][..], 0));
    }
}

#[test]
fn a_wrong_row_breaks_what_is_about_the_state() {
    let mutation = Mutation::all(Edition::DEFAULT).find(|one| one.to_string() == "3.7 term 1: dropped");
    let mutant = mutation.expect("a mutation").apply(Edition::DEFAULT);
    let report = machine(&Machine::new(mutant, Readings::DEFAULT), &suite_only());
    let row = failed(&report);
    assert!(row.contains(&"SM-13") && row.contains(&"DTE-2"), "{row:?}");
    // The flags and the numbers are wrong only because the state is. What else would have shown them is not known.
    for id in ["MSG-50", "MSG-55", "MSG-64", "D-12", "D-13", "D-15", "D-17", "D-40", "D-43"] {
        assert!(!row.contains(&id), "{id}: {row:?}");
    }
    let flags = report.requirements.iter().find(|one| one.id == "D-17").expect("it is there");
    assert!(flags.checked < flags.tests, "{flags:?}");
}

#[test]
fn a_random_scenario_breaks_the_row_that_it_finds_or_the_output() {
    // Nothing but the tests of the rows: none of them asks for torque.
    let rows: Vec<Test> = tests().iter().filter(|test| test.kind == Kind::Row).cloned().collect();
    let torque = |_: usize, inputs: &Inputs, outputs: &mut Outputs| {
        if inputs.ai.drive_f != Inputs::default().ai.drive_f && outputs["as_state"] == "AS_READY" {
            outputs.insert("front_axle_trq".to_owned(), json!(7));
        }
    };
    let report =
        tampered(&rows, &ConformOptions { runs: 200, strict: true, ..ConformOptions::default() }, torque);
    assert_eq!((report.failed_tests, failed(&report)), (0, vec!["DRV-2"]));
    let output = report.requirements.iter().find(|one| one.id == "DRV-2").expect("it is there");
    assert!(output.tests == 0 && output.failed[0].starts_with("random scenario "), "{output:?}");

    // AS_READY is entered once only.
    let options = ConformOptions { runs: 200, strict: true, ..ConformOptions::default() };
    let report = example("mutant", &["--once"], &options, TIMEOUT).expect("it answers");
    assert_eq!(report.failed_tests, 0);
    let mut broken: Vec<&str> = failed(&report);
    let row = tests().iter().find(|test| test.name == "3.1").expect("the row has a test");
    let mut named: Vec<&str> = row.requirements.iter().map(String::as_str).collect();
    broken.sort_unstable();
    named.sort_unstable();
    assert!(broken == named && broken.contains(&"RDY-5"), "{broken:?}");
}

#[test]
fn what_is_wrong_only_once_counts_against_all_that_the_test_names() {
    let report = example("mutant", &["--lie-at", "2"], &suite_only(), TIMEOUT).expect("it answers");
    let named: Vec<&str> = tests()[0].requirements.iter().map(String::as_str).collect();
    let broken = failed(&report);
    assert!(!named.is_empty() && named.len() == broken.len(), "{named:?} {broken:?}");
    assert!(named.iter().all(|id| broken.contains(id)), "{named:?} {broken:?}");
}

/// A requirement about several outputs is checked where all of them are shown, and broken where one is wrong.
#[test]
fn a_requirement_about_several_outputs_asks_for_all_of_them() {
    let report = tampered(tests(), &suite_only(), |_, _, outputs| {
        outputs.remove("shutdown_cause");
    });
    let not_checked = of(&report, Outcome::NotChecked);
    assert!(["MSG-64", "D-12", "D-13", "D-15"].iter().all(|id| not_checked.contains(id)), "{not_checked:?}");
    assert!(report.conforms() && of(&report, Outcome::Pass).contains(&"MSG-55"));
    let one = |_: usize, _: &Inputs, outputs: &mut Outputs| {
        outputs.remove("shutdown_cause");
        flip(outputs, "hvil_open_fault");
    };
    assert!(failed(&tampered(tests(), &suite_only(), one)).contains(&"D-12"));

    // Shown in another state only, it is not checked in this one.
    let report = tampered(tests(), &suite_only(), |_, _, outputs| {
        if outputs["as_state"] != "AS_DRIVING" {
            outputs.remove("front_axle_trq");
        }
    });
    assert!(
        of(&report, Outcome::NotChecked).contains(&"DRV-2") && !report.not_shown.contains(&"front_axle_trq")
    );
}

/// No report says that a program does not conform without a requirement that it breaks.
#[test]
fn whatever_is_wrong_breaks_something() {
    let options = ConformOptions { runs: 60, strict: true, ..ConformOptions::default() };
    let protocol = adsdv_conform::protocol::Protocol::of(Edition::DEFAULT);
    for (field, _) in protocol.shown() {
        let report = example("mutant", &["--lie", field.key], &options, TIMEOUT).expect("it answers");
        let broken = failed(&report);
        assert!(!report.conforms() && !broken.is_empty(), "{}", field.key);
        let other = |id: &&str| id.starts_with("RDY") || id.starts_with("SM") || id.starts_with("HS");
        if !["as_state", "handshake", "ai_comms_lost", "ami_state"].contains(&field.key) {
            assert!(!broken.iter().any(other), "{}: {broken:?}", field.key);
        }
    }
}

#[test]
fn more_failures_than_are_printed_are_counted() {
    let options = ConformOptions { runs: 50, strict: true, ..ConformOptions::default() };
    let report = example("mutant", &["--scramble"], &options, TIMEOUT).expect("it answers");
    let random = report.failures.iter().filter(|one| one.name.starts_with("random scenario")).count();
    assert!(report.failures.len() - random == 20 && random <= 20, "{random}");
    assert!(report.more_failures > 0);
    // None of the outputs that are wrong is lost in the table.
    assert!(failed(&report).len() > 20, "{:?}", failed(&report));
}
