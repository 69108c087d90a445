//! What is asked, step by step.

use adsdv_conform::protocol::Answer;
use adsdv_conform::suite::Step;
use adsdv_conform::{Program, ProgramError};
use adsdv_spec::Inputs;

/// A state machine that can be reset, and asked for one step after the other: what it sees next may depend on its last answer.
pub trait Subject {
    /// Power on: everything is forgotten.
    ///
    /// # Errors
    ///
    /// Fails if the program does not answer, or answers what is no answer to a reset.
    fn reset(&mut self) -> Result<(), ProgramError>;

    /// One step, so many milliseconds after the last.
    ///
    /// # Errors
    ///
    /// Fails if the program does not answer, or answers what shows nothing.
    fn step(&mut self, dt_ms: u32, inputs: &Inputs) -> Result<Answer, ProgramError>;

    /// The answers to steps from power-on, none of which depends on the answer before it.
    ///
    /// # Errors
    ///
    /// As [`reset`](Self::reset) and [`step`](Self::step).
    fn steps(&mut self, steps: &[Step]) -> Result<Vec<Answer>, ProgramError> {
        self.reset()?;
        steps.iter().map(|step| self.step(step.dt_ms, &step.inputs)).collect()
    }

    /// Whether many steps at once take much less than one after the other, as where each answer has to be waited for.
    fn is_waited_for(&self) -> bool {
        false
    }
}

/// A program that has said the hello of an edition, and answers each line at once.
impl Subject for Program {
    fn reset(&mut self) -> Result<(), ProgramError> {
        Self::reset(self)
    }

    fn step(&mut self, dt_ms: u32, inputs: &Inputs) -> Result<Answer, ProgramError> {
        Self::step(self, dt_ms, inputs)
    }

    fn steps(&mut self, steps: &[Step]) -> Result<Vec<Answer>, ProgramError> {
        Self::steps(self, steps)
    }

    fn is_waited_for(&self) -> bool {
        true
    }
}
