//! What is examined: something that receives the frames of a step, and answers with those that it sends.

use adsdv_can::ai::{Ai, Plan};
use adsdv_spec::Edition;
use adsdv_spec::messages::Frame;

use crate::program_error::StackError;

/// An AI Computer, be it a [program](crate::StdioStack) or something in this process.
///
/// It is asked at every cycle of 10 ms. What is behind it need not know that the time is not that of a clock.
pub trait Stack {
    /// All that follows is about this edition. It comes once, before all else.
    ///
    /// # Errors
    ///
    /// Fails if it is of another edition, or nothing can be learned of it.
    fn hello(&mut self, edition: &Edition) -> Result<(), StackError>;

    /// Begin anew, as if it had just been switched on.
    ///
    /// # Errors
    ///
    /// Fails if it does not do so, or nobody answers.
    fn reset(&mut self) -> Result<(), StackError>;

    /// The frames that have come since it was last asked, and the time since the reset in milliseconds: what it sends.
    ///
    /// # Errors
    ///
    /// Fails if it breaks down, or what it answers are no frames.
    fn step(&mut self, time_ms: u64, frames: &[Frame]) -> Result<Vec<Frame>, StackError>;

    /// The exam is over: what is worth a note of how it ended.
    ///
    /// # Errors
    ///
    /// Fails if it does not end as it should; the exam is judged all the same.
    fn end(&mut self) -> Result<Vec<String>, StackError> {
        Ok(Vec::new())
    }
}

/// The reference AI Computer, in this process.
#[derive(Clone, Debug, Default)]
pub struct Reference(Ai);

impl Stack for Reference {
    fn hello(&mut self, edition: &Edition) -> Result<(), StackError> {
        self.0 = Ai::new(edition, Plan::DEFAULT);
        Ok(())
    }

    fn reset(&mut self) -> Result<(), StackError> {
        self.0 = Ai::new(self.0.edition(), Plan::DEFAULT);
        Ok(())
    }

    fn step(&mut self, _: u64, frames: &[Frame]) -> Result<Vec<Frame>, StackError> {
        for frame in frames {
            // What does not decode changes nothing: it is as if it had not come.
            let _ = self.0.receive(frame);
        }
        Ok(self.0.cycle(self.0.edition().rules.timing.cycle_ms.into()))
    }
}
