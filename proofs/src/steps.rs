//! Steps as theorems draw them: any control state that keeps the invariant, any inputs, any time.

use adsdv_spec::messages::AsState;
use adsdv_spec::{Control, Edition, Inputs, Outputs, Readings, Taken};

use crate::prelude::*;

/// A step of the subject.
#[derive(Clone, Copy, Debug)]
pub struct Step {
    /// The control state before it.
    pub before: Control,
    /// What the VCU sees.
    pub inputs: Inputs,
    /// The time since the last step, in milliseconds.
    pub dt_ms: u32,
    /// The control state after it.
    pub after: Control,
    /// What the step shows.
    pub outputs: Outputs,
}

impl Step {
    /// The step of the subject from here.
    pub fn of(before: Control, inputs: Inputs, dt_ms: u32) -> Self {
        let (after, outputs) = subject().step(&before, &inputs, dt_ms);
        Self { before, inputs, dt_ms, after, outputs }
    }

    /// Whether the step is from the one state to the other.
    pub fn leads(&self, from: AsState, to: AsState) -> bool {
        self.before.state == from && self.after.state == to
    }
}

/// Whether a control state keeps the invariant of the reference.
pub const fn keeps_invariant(control: &Control) -> bool {
    control.is_consistent(&Edition::DEFAULT.rules.timing, Readings::DEFAULT)
}

/// Any control state that keeps the invariant.
pub fn any_control() -> Control {
    kani::any_where(keeps_invariant)
}

/// Any control state of an AS state that keeps the invariant.
pub fn any_control_in(state: AsState) -> Control {
    let keeps = |control: &Control| control.state == state && keeps_invariant(control);
    // Written down, so that the proof knows it as a constant.
    Control { state, ..kani::any_where(keeps) }
}

/// Any step from a control state that keeps the invariant.
pub fn any_step() -> Step {
    Step::of(any_control(), kani::any(), kani::any())
}

/// Any step from an AS state.
pub fn any_step_from(state: AsState) -> Step {
    Step::of(any_control_in(state), kani::any(), kani::any())
}

/// Any outputs, also those that no step has.
pub fn any_outputs() -> Outputs {
    let taken = Taken { row: kani::any(), term: kani::any() };
    Outputs {
        from: kani::any(),
        state: kani::any(),
        taken: if kani::any() { Some(taken) } else { None },
        atoms: kani::any(),
        faults: kani::any(),
        shutdown_cause: kani::any(),
        handshake: kani::any(),
        go_signal: kani::any(),
    }
}

/// Any end of a step, also one that no step has: for what depends only on where a step has led and on the inputs.
pub fn any_end() -> Step {
    let outputs = any_outputs();
    Step {
        before: Control { state: outputs.from, ..Control::INITIAL },
        inputs: kani::any(),
        dt_ms: kani::any(),
        after: Control { state: outputs.state, ..Control::INITIAL },
        outputs,
    }
}
