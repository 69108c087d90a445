//! A program that does not answer alike each time: whatever it was asked, it is recognised.

use std::time::Duration;

use adsdv_conform::ProgramError;
use adsdv_conform::protocol::Answer;
use adsdv_diagnosis::{Deviation, Diagnosis, Interface, Model, Running, Subject, diagnose_within};
use adsdv_spec::{Edition, Inputs};

const EDITION: &Edition = &Edition::V3_0;

/// Two programs, of which the second answers now and then, or from some step on.
struct Changing {
    programs: Vec<Running>,
    steps: u64,
    /// Which of them answers a step, counted from the start.
    second: fn(u64) -> bool,
}

impl Subject for Changing {
    fn reset(&mut self) -> Result<(), ProgramError> {
        self.programs.iter_mut().try_for_each(Subject::reset)
    }

    fn step(&mut self, dt_ms: u32, inputs: &Inputs) -> Result<Answer, ProgramError> {
        self.steps += 1;
        let place = usize::from((self.second)(self.steps));
        let answers: Result<Vec<Answer>, _> =
            self.programs.iter_mut().map(|program| program.step(dt_ms, inputs)).collect();
        Ok(answers?[place])
    }
}

fn found(second: fn(u64) -> bool) -> Diagnosis {
    let running = |ids: &[&str]| {
        let deviations =
            ids.iter().map(|id| Deviation::find(EDITION, id).expect("there is such a deviation"));
        Model::new(EDITION, &deviations.collect::<Vec<_>>()).running()
    };
    let programs = vec![running(&["ready-off:missing"]), running(&["ready-off:missing", "handshake:+450ms"])];
    let mut program = Changing { programs, steps: 0, second };
    // One that does not answer alike is looked at for all of it, and recognised in the end.
    let time = Duration::from_secs(5);
    diagnose_within(&mut program, EDITION, &Interface::default(), time).expect("it answers everything")
}

#[test]
fn a_program_that_answers_alike_does_so_in_its_diagnosis() {
    assert!(found(|_| false).repeats);
}

#[test]
fn a_program_whose_answers_change_with_the_time_that_it_runs_is_recognised() {
    assert!(!found(|step| step > 20_000).repeats);
}

/// By the golden ratio: it looks random, and is the same in every run.
#[test]
fn a_program_that_answers_otherwise_now_and_then_is_recognised() {
    assert!(!found(|step| step.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 56 == 0).repeats);
}
