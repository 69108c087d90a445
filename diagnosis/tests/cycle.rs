//! A diagnosis of a program that steps at a fixed cycle: it is never asked for another time, and named as exactly as that can tell.

use std::collections::HashSet;
use std::time::Duration;

use adsdv_conform::ProgramError;
use adsdv_conform::protocol::Answer;
use adsdv_diagnosis::{Deviation, Diagnosis, Interface, Model, Running, Subject, diagnose_within, examples};
use adsdv_spec::{Edition, Inputs};

const TIME: Duration = Duration::from_mins(10);

/// A program at a cycle: another time is a failure of the test.
struct AtCycle {
    program: Running,
    cycle_ms: u32,
    steps: u64,
}

impl Subject for AtCycle {
    fn reset(&mut self) -> Result<(), ProgramError> {
        self.program.reset()
    }

    fn step(&mut self, dt_ms: u32, inputs: &Inputs) -> Result<Answer, ProgramError> {
        assert_eq!(dt_ms, self.cycle_ms);
        self.steps += 1;
        self.program.step(dt_ms, inputs)
    }
}

/// What is found of a program with these deviations, and after how many steps.
fn found(edition: &Edition, cycle_ms: u32, deviations: &[Deviation]) -> (Diagnosis, u64) {
    let interface = Interface::default().at_cycle(Some(cycle_ms));
    let program = Model::new(edition, deviations).running();
    let mut program = AtCycle { program, cycle_ms, steps: 0 };
    let found = diagnose_within(&mut program, edition, &interface, TIME).expect("a model answers everything");
    let shown = examples(edition, &interface, &found.deviations).expect("a model answers everything");
    for (deviation, example) in found.deviations.iter().zip(shown) {
        let example = example.unwrap_or_else(|| panic!("{} shows", deviation.id(edition)));
        assert!(!example.differences.is_empty());
        assert!(example.scenario.steps.iter().all(|step| step.dt_ms == cycle_ms));
    }
    (found, program.steps)
}

#[track_caller]
fn names(edition: &Edition, cycle_ms: u32, ids: &[&str]) {
    let find = |id: &&str| Deviation::find(edition, id).expect("there is such a deviation");
    let (found, _) = found(edition, cycle_ms, &ids.iter().map(find).collect::<Vec<_>>());
    let own: HashSet<String> = found.deviations.iter().map(|one| one.id(edition)).collect();
    assert_eq!(own, ids.iter().map(|id| (*id).to_owned()).collect(), "at {cycle_ms} ms");
    assert!(found.unexplained.is_empty() && found.readings.is_empty() && !found.cut);
}

#[test]
fn a_program_that_conforms_has_no_deviation_at_any_cycle_and_is_asked_for_a_bounded_number_of_steps() {
    for cycle_ms in [10, 20, 50, 100] {
        let (found, steps) = found(&Edition::V3_0, cycle_ms, &[]);
        assert!(found.deviations.is_empty() && found.unexplained.is_empty(), "at {cycle_ms} ms");
        assert!((100_000..1_500_000).contains(&steps), "at {cycle_ms} ms: {steps}");
    }
}

#[test]
fn deviations_are_named_one_by_one_at_a_slow_cycle() {
    names(&Edition::V3_0, 50, &["handshake:+450ms", "ready-off:missing", "straight:-39"]);
    names(&Edition::V4_0, 20, &["off-ready:needs:ami=3", "go:needs-handshake", "remembers:latest-cause"]);
    names(&Edition::V2026, 100, &["ready-dwell:+300ms", "driving:shows:go_signal=0", "moving:wheel-2"]);
}

#[test]
fn an_arrow_that_is_missing_and_one_that_is_late_are_two_things_at_a_fixed_cycle() {
    for cycle_ms in [10, 50] {
        names(&Edition::V3_0, cycle_ms, &["driving-finished:missing"]);
        names(&Edition::V3_0, cycle_ms, &["driving-finished:late:3"]);
    }
}

#[test]
fn a_time_is_named_by_the_end_of_the_cycle_in_which_it_is_over() {
    let edition = &Edition::V3_0;
    let late = Deviation::find(edition, "ready-dwell:+130ms").expect("there is one");
    let ids: Vec<String> =
        found(edition, 50, &[late]).0.deviations.iter().map(|one| one.id(edition)).collect();
    assert_eq!(ids, ["ready-dwell:+150ms"]);
}

/// The model is elsewhere long before such a program.
#[test]
fn a_timer_that_takes_longer_is_found_at_a_fixed_cycle() {
    names(&Edition::V3_0, 50, &["ebs-timer:+5000ms"]);
    names(&Edition::V4_0, 100, &["ebs-timer:+12200ms"]);
}
