//! What is only otherwise than this project decided, where the document is silent, is observed, and fails nothing.

use adsdv_conform::{ConformOptions, ConformReport, Outcome, conform};
use adsdv_spec::mutation::Change;
use adsdv_spec::{Edition, Inputs, Machine, Mutation, Readings};
use serde_json::json;

use crate::erring::{Erring, Outputs};
use crate::programs::{TIMEOUT, example, machine, tests};

fn options(strict: bool) -> ConformOptions {
    ConformOptions { runs: 60, strict, possible: Readings::DEFAULT.choices(), ..ConformOptions::default() }
}

fn judged(strict: bool, tampers: fn(usize, &Inputs, &mut Outputs)) -> ConformReport {
    let mut vcu = Erring { tampers, ..Erring::new(&Machine::REFERENCE) };
    conform(&mut vcu, tests(), &options(strict), &mut |_| {}).expect("it answers")
}

fn of(report: &ConformReport, outcome: Outcome) -> Vec<&str> {
    report.requirements.iter().filter(|one| one.outcome == outcome).map(|one| one.id.as_str()).collect()
}

/// The brakes in AS_OFF are left to the driver by a decision of ours; this VCU brakes as it is asked.
fn brakes_in_off(_: usize, inputs: &Inputs, outputs: &mut Outputs) {
    if outputs["as_state"] == "AS_OFF" {
        outputs.insert("hyd_press_f".to_owned(), json!(inputs.ai.brake.hyd_press_f_req.raw()));
    }
}

#[test]
fn what_is_only_decided_is_observed_and_the_program_conforms() {
    let report = judged(false, brakes_in_off);
    assert!(report.conforms(), "{:?}", report.failures);
    assert_eq!((report.failed_tests, report.failed_runs), (0, 0));
    assert!(report.observed_tests > 0 && report.observed_runs > 0);
    assert_eq!((of(&report, Outcome::Fail), of(&report, Outcome::Differs)), (vec![], vec!["D-42"]));
    assert!(report.observations.iter().all(|one| one.requirements == ["D-42"]), "{:?}", report.observations);
}

#[test]
fn it_fails_where_that_is_asked_for() {
    let report = judged(true, brakes_in_off);
    assert!(!report.conforms() && report.observations.is_empty());
    assert_eq!((of(&report, Outcome::Fail), report.observed_tests), (vec!["D-42"], 0));
}

#[test]
fn what_is_decided_does_not_hide_what_the_document_asks_for() {
    let report = judged(false, |place, inputs, outputs| {
        brakes_in_off(place, inputs, outputs);
        if outputs["as_state"] == "AS_DRIVING" {
            outputs.insert("go_signal".to_owned(), json!(false));
            outputs.insert("ts_switch_status".to_owned(), json!(false));
        }
    });
    assert!(!report.conforms() && !report.observations.is_empty());
    let wrong = report.failures.iter().flat_map(|one| one.found.iter().flat_map(|found| &found.differences));
    let keys: Vec<&str> = wrong.map(|difference| difference.key).collect();
    assert!(keys.contains(&"ts_switch_status") && !keys.contains(&"hyd_press_f"), "{keys:?}");
}

/// Which of two rows of AS_READY comes first is D-22, and nothing else.
#[test]
fn the_order_of_rows_that_is_decided_is_observed() {
    let decided = |mutation: &Mutation| match mutation.change {
        Change::RowFirst(row) => Edition::DEFAULT.rules.table.rows()[row - 1].cites.order == ["D-22"],
        _ => false,
    };
    let mutation = Mutation::all(Edition::DEFAULT).find(decided).expect("a mutation");
    let mutant = Machine::new(mutation.apply(Edition::DEFAULT), Readings::DEFAULT);
    let report = machine(&mutant, &options(false));
    assert!(report.conforms(), "{:?}", report.failures);
    assert_eq!(of(&report, Outcome::Differs), ["D-22"]);
}

/// A state and a cause that there are not: the run goes on, and says so.
#[test]
fn a_value_outside_of_its_enumeration_is_a_finding_and_the_run_goes_on() {
    let report = judged(false, |_, _, outputs| {
        if outputs["as_state"] == "AS_FINISHED" {
            outputs.insert("as_state".to_owned(), json!(0));
        }
        if outputs["as_state"] == "EMERGENCY_BRAKE" {
            outputs.insert("shutdown_cause".to_owned(), json!("BRAKES_ON_FIRE"));
        }
    });
    assert!(!report.conforms() && report.failed_tests < tests().len(), "{}", report.failed_tests);
    let wrong = report.failures.iter().flat_map(|one| one.found.iter().flat_map(|found| &found.differences));
    let said: Vec<String> = wrong.map(ToString::to_string).collect();
    assert!(said.iter().any(|one| one == "as_state is 0; expected AS_FINISHED"), "{said:?}");
    assert!(
        said.iter().any(|one| one.starts_with("shutdown_cause is BRAKES_ON_FIRE; expected ")),
        "{said:?}"
    );
}

/// A VCU whose handshake bit turns at half the pace is answered by its own: it loses no communication, and only the bit is wrong.
#[test]
fn a_program_with_another_handshake_bit_is_answered_by_its_own() {
    let report = example("mutant", &["--slow-bit"], &options(false), TIMEOUT).expect("it answers");
    let failed = of(&report, Outcome::Fail);
    assert!(failed.contains(&"HS-4") || failed.contains(&"MSG-42"), "{failed:?}");
    assert!(failed.iter().all(|id| id.starts_with("HS-") || *id == "MSG-42"), "{failed:?}");
    assert!(report.notes.iter().any(|note| note.contains("its HANDSHAKE is not")), "{:?}", report.notes);
}
