//! Random scenarios find what the suite does not, and are the same for the same seed.

use adsdv_conform::{ConformOptions, ConformProgress, ConformReport, InProcess, Outcome, Phase, conform};
use adsdv_spec::Machine;

use crate::programs::{TIMEOUT, example, tests};

fn once(seed: u64, runs: u32) -> ConformReport {
    // It enters AS_READY only once after each reset, which no test of the suite asks for twice.
    let options = ConformOptions { seed, runs, strict: true, ..ConformOptions::default() };
    example("mutant", &["--once"], &options, TIMEOUT).expect("it answers")
}

#[test]
fn what_the_suite_does_not_find_is_found_and_shortened() {
    let report = once(1, 300);
    assert_eq!((report.failed_tests, report.conforms()), (0, false));
    assert!(report.failed_runs > 20, "{}", report.failed_runs);
    let [failure] = report.failures.as_slice() else { panic!("{:?}", report.failures) };
    assert!(failure.name.contains("of seed 1"), "{}", failure.name);
    // Into AS_READY, out of it, and into it again.
    assert_eq!(failure.scenario.steps.len(), 3);
    assert_eq!(failure.found.as_ref().and_then(|found| found.why.row()).map(|row| row.section), Some("3.1"));
    let failed: Vec<&str> = report
        .requirements
        .iter()
        .filter(|requirement| requirement.outcome == Outcome::Fail)
        .map(|requirement| requirement.id.as_str())
        .collect();
    assert!(failed.contains(&"RDY-5"), "{failed:?}");
}

#[test]
fn the_same_seed_is_the_same_run() {
    let scenarios =
        |report: &ConformReport| report.failures.iter().map(|one| one.scenario.clone()).collect::<Vec<_>>();
    let (first, second, other) = (once(5, 100), once(5, 100), once(6, 100));
    assert_eq!((first.failed_runs, first.steps), (second.failed_runs, second.steps));
    assert_eq!(scenarios(&first), scenarios(&second));
    assert_ne!(first.steps, other.steps);
    assert!(once(5, 0).conforms());
}

#[test]
fn a_failure_that_does_not_repeat_is_reported_as_that() {
    // A program that lies is found out even if it does not repeat the lie. The first line is a reset.
    let options = ConformOptions { runs: 0, strict: true, ..ConformOptions::default() };
    let report = example("mutant", &["--lie-at", "2"], &options, TIMEOUT).expect("it answers");
    let [failure] = report.failures.as_slice() else { panic!("{:?}", report.failures) };
    assert!(failure.found.is_none() && !report.conforms() && !report.repeats);
    assert!(report.notes.iter().any(|note| note.contains("does not answer the same questions alike")));
    assert_eq!(report.failed_tests, 1);
}

#[test]
fn as_many_scenarios_are_tried_as_were_asked_for() {
    for runs in [0, 1, 63, 64, 65, 200] {
        let options = ConformOptions { runs, strict: true, ..ConformOptions::default() };
        let mut answered = 0;
        let mut progress = |at: ConformProgress| answered += u32::from(at.phase == Phase::Random);
        let report = conform(&mut InProcess(Machine::REFERENCE), tests(), &options, &mut progress);
        assert!(report.expect("it answers").conforms());
        assert_eq!(answered, runs);
    }
}
