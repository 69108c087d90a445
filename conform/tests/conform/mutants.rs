//! Every mutation of the specification fails, with the row that is broken and a short scenario.

use adsdv_conform::suite;
use adsdv_conform::{ConformOptions, ConformReport, Failure, Outcome, Why};
use adsdv_spec::mutation::Change;
use adsdv_spec::{Choice, Edition, Machine, Mutation, Readings};

use crate::programs::{TIMEOUT, example, machine, suite_only, tests_of};

/// Judged by the default readings only: some mutations are another reading of the document.
fn by_default() -> ConformOptions {
    by_default_of(Edition::DEFAULT)
}

fn by_default_of(edition: &Edition) -> ConformOptions {
    ConformOptions {
        possible: edition.readings.choices(),
        runs: 0,
        strict: true,
        ..ConformOptions::of(edition)
    }
}

fn mutated(mutation: &Mutation) -> Machine {
    Machine::new(mutation.apply(Edition::DEFAULT), Readings::DEFAULT)
}

fn named(name: &str) -> ConformReport {
    let mutation = Mutation::all(Edition::DEFAULT).find(|one| one.to_string() == name);
    machine(&mutated(&mutation.expect(name)), &by_default())
}

/// The failures, with the section of the row and the number of steps.
fn found(report: &ConformReport) -> Vec<(&str, usize)> {
    let one = |failure: &'_ Failure| {
        failure.found.as_ref().and_then(|found| found.why.row()).map(|row| row.section)
    };
    report
        .failures
        .iter()
        .map(|failure| (one(failure).unwrap_or("-"), failure.scenario.steps.len()))
        .collect()
}

#[test]
fn every_mutation_fails_in_its_row() {
    let fail = fail_in_their_rows(Edition::DEFAULT);
    let summary = include_str!("../../../TESTING.md");
    assert!(summary.contains(&format!(", {fail}: the others behave")), "TESTING.md: {fail} are found");
}

#[test]
fn every_mutation_of_version_4_0_fails_in_its_row() {
    assert_eq!(fail_in_their_rows(&Edition::V4_0), 172);
}

/// How many mutations of an edition fail under its default readings, each of them in its row.
fn fail_in_their_rows(edition: &Edition) -> usize {
    let table = edition.rules.table;
    let reference = Machine::new(*edition, edition.readings);
    let mut fail = 0;
    for mutation in Mutation::all(edition) {
        let mutant = Machine::new(mutation.apply(edition), edition.readings);
        let differs = |test: &suite::Test| test.scenario.shown(&reference).ne(test.scenario.shown(&mutant));
        let report = machine(&mutant, &by_default_of(edition));
        assert_eq!(!report.conforms(), tests_of(edition).iter().any(differs), "{mutation}");
        if report.conforms() {
            // It concerns other readings only.
            continue;
        }
        fail += 1;
        assert!(report.failures.iter().all(|failure| failure.found.is_some()), "{mutation}");
        assert!(report.requirements.iter().any(|one| one.outcome == Outcome::Fail), "{mutation}");
        let rows: Vec<usize> =
            report.failures.iter().filter_map(|one| Some(one.found.as_ref()?.why.row()?.place)).collect();
        match mutation.change {
            // A row that comes first is taken instead of the one before it, whichever of its alternatives holds.
            Change::RowFirst(row) => {
                assert!(
                    !rows.is_empty() && rows.iter().all(|&broken| broken == row - 1),
                    "{mutation}: {rows:?}"
                );
            }
            Change::RowDropped(row) | Change::RowLeadsTo(row, _) => {
                assert!(rows.contains(&row), "{mutation}: {rows:?}");
            }
            Change::Term(row, ..) => {
                let from = |row: usize| table.rows()[row].from;
                assert!(rows.contains(&row), "{mutation}: {rows:?}");
                assert!(rows.iter().all(|&other| from(other) == from(row)), "{mutation}: {rows:?}");
            }
            Change::Time(..) | Change::Threshold(..) => {}
        }
        // No way to a state and out of it is longer than to AS_FINISHED and out of that.
        let longest = found(&report).into_iter().map(|(_, steps)| steps).max();
        assert!(longest <= Some(8), "{mutation}: {:?}", found(&report));
    }
    fail
}

#[test]
fn the_shortest_scenario_is_found() {
    for (mutation, expected) in [
        ("3.1: dropped", ("3.1", 1)),
        ("3.1 term 0: ebs-armed dropped", ("3.1", 1)),
        ("3.6: dropped", ("3.6", 2)),
        ("3.5 term 0: dropped", ("3.5", 2)),
        ("3.2 term 0: go-edge dropped", ("3.2", 2)),
        ("3.2: dropped", ("3.2", 3)),
        ("3.7 term 1: dropped", ("3.7", 4)),
        ("3.9: dropped", ("3.9", 3)),
        ("3.4: dropped", ("3.4", 5)),
        ("ready dwell -1", ("3.2", 3)),
        ("EBS timer +1", ("3.9", 3)),
    ] {
        assert_eq!(found(&named(mutation)), [expected], "{mutation}");
    }
}

#[test]
fn a_shortest_scenario_has_nothing_that_it_does_not_need() {
    let report = named("EBS timer +1");
    let [failure] = report.failures.as_slice() else { panic!("{:?}", found(&report)) };
    let times: Vec<u32> = failure.scenario.steps.iter().map(|step| step.dt_ms).collect();
    assert_eq!(times, [0, 0, 15_000]);
    let moments = failure.timeline();
    let changed = |place: usize| moments[place].changes.iter().map(|(key, _)| *key).collect::<Vec<_>>();
    assert_eq!(changed(0), ["asms", "tsms", "ami", "ebs", "mission_status"]);
    assert!(changed(1).contains(&"asms"), "{moments:?}");
    // The AI Computer does not answer in time for it to matter; so that is said as well.
    assert_eq!((changed(1).len(), changed(2).len()), (3, 0));
    let shown = |place: usize| {
        let state = |state: &Option<adsdv_conform::protocol::Value>| state.as_ref().map(ToString::to_string);
        (state(&moments[place].expected), state(&moments[place].actual), moments[place].wrong)
    };
    let (brake, off) = (Some("EMERGENCY_BRAKE".to_owned()), Some("AS_OFF".to_owned()));
    assert_eq!(shown(1), (brake.clone(), brake.clone(), false));
    assert_eq!(shown(2), (off, brake, true));
    let why = &failure.found.as_ref().expect("it fails").why;
    assert!(
        matches!(why, Why::NotTaken(row) if row.guard.iter().any(|one| one == "EBS timer complete")),
        "{why}"
    );
}

#[test]
fn a_failure_names_the_row_and_its_guard() {
    let why = |mutation: &str| {
        let report = named(mutation);
        report.failures.first().and_then(|failure| failure.found.as_ref()).map(|found| found.why.to_string())
    };
    assert_eq!(
        why("3.6: dropped").as_deref(),
        Some("not taken: AS_READY -> AS_OFF (section 3.6: AS master switch OFF)")
    );
    let early = why("3.1 term 0: ebs-armed dropped").expect("it fails");
    assert!(
        early.starts_with("taken, though EBS_state != ARMED: AS_OFF -> AS_READY (section 3.1: "),
        "{early}"
    );
    let cause = why("3.7 term 1: fault dropped").expect("it fails");
    assert!(
        cause.starts_with("taken, and not shown as it should be: AS_DRIVING -> EMERGENCY_BRAKE"),
        "{cause}"
    );
}

#[test]
fn through_the_pipe_it_is_the_same() {
    let here = machine(
        &mutated(
            &Mutation::all(Edition::DEFAULT).find(|one| one.to_string() == "3.4: dropped").expect("3.4"),
        ),
        &suite_only(),
    );
    let there =
        example("mutant", &["--mutation", "3.4: dropped"], &suite_only(), TIMEOUT).expect("it answers");
    assert_eq!(found(&here), found(&there));
    assert_eq!(here.requirements, there.requirements);
    assert_eq!(here.failures[0].scenario, there.failures[0].scenario);
    let adapter = example("adapter", &[], &ConformOptions::default(), TIMEOUT).expect("it answers");
    assert!(adapter.conforms() && adapter.notes.is_empty(), "{:?}", adapter.notes);
    assert!(adapter.follows.iter().all(|follows| follows.possible.len() == 1));
    let edge = example("mutant", &["--reading", "go-edge=edge"], &suite_only(), TIMEOUT).expect("it answers");
    assert!(edge.conforms() && edge.readings.is(Choice::GoEdgeEnough));
}
