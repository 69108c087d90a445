//! Programs whose outputs are late, and programs that step at a fixed cycle.

use adsdv_conform::{ConformOptions, ConformReport};
use adsdv_spec::Machine;

use crate::programs::{TIMEOUT, example, machine};

fn late(args: &[&str], latency: usize) -> ConformReport {
    let options = ConformOptions { latency, runs: 100, strict: true, ..ConformOptions::default() };
    example("mutant", args, &options, TIMEOUT).expect("it answers")
}

#[test]
fn a_constant_delay_is_found() {
    for (delay, latency) in [("0", 3), ("1", 1), ("2", 3), ("3", 3)] {
        let report = late(&["--latency", delay], latency);
        assert!(report.conforms(), "{delay}");
        assert_eq!(report.late.to_string(), delay);
    }
}

#[test]
fn more_delay_than_is_allowed_fails() {
    let report = late(&["--latency", "2"], 1);
    assert!(!report.conforms() && report.failed_tests > 100, "{}", report.failed_tests);
    let note = "with outputs 2 steps late 0 tests would fail: --latency 2 allows for that";
    assert!(report.notes.iter().any(|reported| reported == note), "{:?}", report.notes);
}

#[test]
fn a_late_mutant_fails_in_its_row() {
    let report = late(&["--latency", "2", "--mutation", "3.6: dropped"], 2);
    assert_eq!(report.late, 2);
    let [failure] = report.failures.as_slice() else { panic!("{:?}", report.failures) };
    let found = failure.found.as_ref().expect("it fails");
    assert_eq!(found.why.row().map(|row| row.section), Some("3.6"));
    // Steps 1 and 2, and the answer to 2 comes with step 4.
    assert_eq!((failure.scenario.steps.len(), found.about, found.step), (2, 1, 3));
    let moments = failure.timeline();
    assert!(moments[0].expected.is_none() && moments.last().is_some_and(|last| last.wrong), "{moments:?}");
}

#[test]
fn at_a_fixed_cycle_every_step_takes_it() {
    struct OneCycle(adsdv_conform::InProcess, u32);
    impl adsdv_conform::Vcu for OneCycle {
        fn hello(
            &mut self,
            edition: &adsdv_spec::Edition,
        ) -> Result<adsdv_conform::protocol::About, adsdv_conform::ProgramError> {
            self.0.hello(edition)
        }

        fn ask(
            &mut self,
            scenarios: &[(&str, &adsdv_conform::suite::Scenario)],
            answered: &mut dyn FnMut(usize, &[adsdv_conform::Reply]),
        ) -> Result<(), adsdv_conform::ProgramError> {
            let times = scenarios.iter().flat_map(|(_, scenario)| &scenario.steps).map(|step| step.dt_ms);
            assert!(times.into_iter().all(|dt_ms| dt_ms == self.1));
            self.0.ask(scenarios, answered)
        }
    }
    let tests = crate::programs::tests();
    for (cycle_ms, at_most) in [(10, 0), (50, 20)] {
        let options =
            ConformOptions { cycle_ms: Some(cycle_ms), runs: 20, strict: true, ..ConformOptions::default() };
        let mut vcu = OneCycle(adsdv_conform::InProcess(Machine::REFERENCE), cycle_ms);
        let report = adsdv_conform::conform(&mut vcu, tests, &options, &mut |_| {}).expect("it answers");
        assert!(report.conforms(), "{cycle_ms} ms");
        assert!(report.not_run.len() <= at_most, "{cycle_ms} ms: {:?}", report.not_run);
        assert_eq!(report.tests + report.not_run.len(), tests.len());
        let reported = report.follows.iter().filter(|follows| follows.possible.len() == 1).count();
        assert!(reported >= 10, "{cycle_ms} ms: {:?}", report.follows);
    }
}

#[test]
fn a_mutant_at_a_fixed_cycle_fails_in_its_row() {
    let mutation = adsdv_spec::Mutation::all(adsdv_spec::Edition::DEFAULT)
        .find(|one| one.to_string() == "3.7 term 1: dropped");
    let mutant = mutation.expect("a mutation").apply(adsdv_spec::Edition::DEFAULT);
    let options = ConformOptions { cycle_ms: Some(100), runs: 0, strict: true, ..ConformOptions::default() };
    let report = machine(&Machine::new(mutant, adsdv_spec::Readings::DEFAULT), &options);
    let rows: Vec<_> = report.failures.iter().filter_map(|one| one.found.as_ref()?.why.row()).collect();
    assert!(!rows.is_empty() && rows.iter().all(|row| row.section == "3.7"), "{rows:?}");
    // What goes on and on takes a few lines.
    let steps = report.failures[0].scenario.steps.len();
    assert!(steps > 50 && report.failures[0].timeline().len() < 12, "{:?}", report.failures[0].timeline());
}
