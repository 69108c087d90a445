//! Subjects that do one thing otherwise, as several theorems need them.

use adsdv_proofs::subject::Subject;
use adsdv_spec::messages::Frame;
use adsdv_spec::{Choice, Control, Edition, Inputs, Machine, Outputs, Readings, VcuMessages};

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

/// What the VCU sends, changed.
#[derive(Clone)]
pub(crate) struct Sending<F>(pub(crate) F);

impl<F: Fn(&mut VcuMessages, &Outputs, &Inputs)> Subject for Sending<F> {
    fn messages(&self, outputs: &Outputs, inputs: &Inputs) -> VcuMessages {
        let mut messages = outputs.messages(inputs);
        (self.0)(&mut messages, outputs, inputs);
        messages
    }
}

/// Frames that go out otherwise than they were encoded.
#[derive(Clone)]
pub(crate) struct Sent<F>(F);

impl<F: Fn(Frame) -> Frame> Sent<F> {
    pub(crate) const fn new(change: F) -> Self {
        Self(change)
    }
}

impl<F: Fn(Frame) -> Frame> Subject for Sent<F> {
    fn sent(&self, frame: Frame) -> Frame {
        (self.0)(frame)
    }
}

/// Data that reaches the decoder otherwise than it came.
#[derive(Clone)]
pub(crate) struct Received<F>(F);

impl<F: Fn(u16, [u8; 9]) -> [u8; 9]> Received<F> {
    pub(crate) const fn new(change: F) -> Self {
        Self(change)
    }
}

impl<F: Fn(u16, [u8; 9]) -> [u8; 9]> Subject for Received<F> {
    fn received(&self, id: u16, data: [u8; 9]) -> [u8; 9] {
        (self.0)(id, data)
    }
}
