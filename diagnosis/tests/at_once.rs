//! A program whose answers have to be waited for is asked for many steps at once where its model foresees them.

use std::thread;
use std::time::Duration;

use adsdv_conform::ProgramError;
use adsdv_conform::protocol::Answer;
use adsdv_conform::suite::Step;
use adsdv_diagnosis::{Deviation, Diagnosis, Interface, Model, Running, Subject, diagnose_within};
use adsdv_spec::{Edition, Inputs};

const EDITION: &Edition = &Edition::V4_0;

/// A program that counts what it is asked.
struct Counted {
    program: Running,
    is_waited_for: bool,
    /// Steps, each after the answer to the one before.
    in_turn: usize,
    at_once: usize,
}

impl Subject for Counted {
    fn reset(&mut self) -> Result<(), ProgramError> {
        self.program.reset()
    }

    fn step(&mut self, dt_ms: u32, inputs: &Inputs) -> Result<Answer, ProgramError> {
        self.in_turn += 1;
        self.program.step(dt_ms, inputs)
    }

    fn steps(&mut self, steps: &[Step]) -> Result<Vec<Answer>, ProgramError> {
        self.at_once += steps.len();
        self.program.steps(steps)
    }

    fn is_waited_for(&self) -> bool {
        self.is_waited_for
    }
}

/// What is found of a program with these deviations, and how it was asked.
fn found(ids: &[&str], interface: &Interface, is_waited_for: bool) -> (Diagnosis, Counted) {
    let deviations = ids.iter().map(|id| Deviation::find(EDITION, id).expect("there is such a deviation"));
    let program = Model::new(EDITION, &deviations.collect::<Vec<_>>()).running();
    let mut program = Counted { program, is_waited_for, in_turn: 0, at_once: 0 };
    let found = diagnose_within(&mut program, EDITION, interface, Duration::from_mins(10));
    (found.expect("a model answers everything"), program)
}

#[test]
fn a_program_that_conforms_is_never_asked_for_a_step_by_itself() {
    let (diagnosis, asked) = found(&[], &Interface::default(), true);
    assert_eq!((diagnosis.deviations, asked.in_turn), (Vec::new(), 0));
}

#[test]
fn what_is_found_is_the_same_as_step_by_step() {
    let at_any_time = Interface::default();
    let at_a_cycle = Interface::default().at_cycle(Some(20));
    let programs: [(&[&str], &Interface); 3] = [
        (&["handshake:+450ms"], &at_any_time),
        (&["ready-off:missing", "driving:shows:go_signal=0"], &at_any_time),
        (&["remembers:handshake"], &at_a_cycle),
    ];
    thread::scope(|scope| {
        for (ids, interface) in programs {
            scope.spawn(move || {
                let (in_turn, _) = found(ids, interface, false);
                let (at_once, asked) = found(ids, interface, true);
                assert_eq!(format!("{at_once:?}"), format!("{in_turn:?}"), "{ids:?}");
                assert!(asked.in_turn < asked.at_once, "{ids:?}: {} steps by themselves", asked.in_turn);
            });
        }
    });
}
