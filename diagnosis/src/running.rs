//! A model that runs in this process, as a program under test would.

use adsdv_conform::ProgramError;
use adsdv_conform::protocol::{Answer, Shown};
use adsdv_spec::Inputs;

use crate::model::{Memory, Model};
use crate::subject::Subject;

impl Model {
    /// A program that runs it, from power-on.
    pub const fn running(self) -> Running {
        Running { model: self, memory: Memory::INITIAL }
    }
}

/// A model that runs in this process, as a program under test would.
#[derive(Clone, Debug)]
pub struct Running {
    model: Model,
    memory: Memory,
}

impl Running {
    /// One step, and what it shows.
    pub fn shown(&mut self, dt_ms: u32, inputs: &Inputs) -> Shown {
        let (memory, outputs) = self.model.step(&self.memory, inputs, dt_ms);
        self.memory = memory;
        self.model.shown(&outputs, inputs)
    }
}

impl Subject for Running {
    fn reset(&mut self) -> Result<(), ProgramError> {
        self.memory = Memory::INITIAL;
        Ok(())
    }

    fn step(&mut self, dt_ms: u32, inputs: &Inputs) -> Result<Answer, ProgramError> {
        Ok(self.shown(dt_ms, inputs).into())
    }
}
