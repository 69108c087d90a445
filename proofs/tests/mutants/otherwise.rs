//! Subjects that do one thing otherwise, as several theorems need them.

use adsdv_proofs::subject::Subject;
use adsdv_spec::{Choice, Control, Edition, Inputs, Machine, Outputs, Readings};

/// A step that comes to something else: the change gets what was before, what was seen, and what came out.
#[derive(Clone)]
pub(crate) struct Otherwise(pub(crate) fn(&Control, &Inputs, &mut Control, &mut Outputs));

impl Subject for Otherwise {
    fn step_of(
        &self,
        machine: &Machine,
        before: &Control,
        inputs: &Inputs,
        dt_ms: u32,
    ) -> (Control, Outputs) {
        let (mut after, mut outputs) = machine.step(before, inputs, dt_ms);
        (self.0)(before, inputs, &mut after, &mut outputs);
        (after, outputs)
    }
}

/// The document as it is read with another choice.
#[derive(Clone)]
pub(crate) struct ReadAs(Machine);

impl ReadAs {
    pub(crate) const fn new(choice: Choice) -> Self {
        Self(Machine::new(*Edition::DEFAULT, Readings::DEFAULT.with(choice)))
    }
}

impl Subject for ReadAs {
    fn machine(&self) -> &Machine {
        &self.0
    }
}
