//! The safety properties: every one that the model checks, proven of each single step.
//!
//! The model explores what can be reached in steps of 10 ms, over conditions. Here the step is any: from every control
//! state that keeps the invariant, with all raw inputs, and after every time. As every step keeps the
//! [`invariant`](crate::invariant), what holds of each such step holds of every run, however long it is and however the
//! VCU's cycle varies. A theorem has the name of its property, with `_` for `-`.
//!
//! The theorems stand in the file of the AS state that their steps start from:
//!
//! - [`off`]: when AS_READY is entered;
//! - [`ready`]: when the vehicle sets off, and what stops it before;
//! - [`driving`]: what stops the vehicle, and when it has finished;
//! - [`finished`]: what ends AS_FINISHED;
//! - [`emergency_brake`]: how long it lasts, and what it leaves behind;
//! - [`every_state`]: what holds of every step;
//! - [`v4_0`]: what version 4.0 has otherwise, from all states.
//!
//! Most of them are one of two sentences, `must_lead` and `only_if`, about conditions on raw inputs. Conditions that
//! several need are in [`words`], or below.

use adsdv_spec::messages::AsState::{self, Driving, EmergencyBrake, Finished, Off, Ready};
use adsdv_spec::{Inputs, Readings};

use crate::prelude::*;
use crate::words;

pub mod driving;
pub mod emergency_brake;
pub mod every_state;
pub mod finished;
pub mod off;
pub mod ready;
pub mod v4_0;

/// A step in which the condition holds leads to this state.
fn must_lead(step: &Step, condition: bool, to: AsState) {
    kani::cover!(condition, "the condition holds");
    kani::cover!(!condition && step.after.state != to, "without it, the step leads elsewhere");
    assert!(!condition || step.after.state == to, "the condition leads there");
}

/// A step leads to this state only if the condition holds.
fn only_if(step: &Step, to: AsState, condition: bool) {
    let taken = step.after.state == to;
    kani::cover!(taken, "the arrow is taken");
    kani::cover!(!taken && !condition, "the arrow is not taken, and the condition does not hold");
    assert!(!taken || condition, "the arrow is taken only if the condition holds");
}

impl Step {
    /// The step as the document's words see it.
    fn words(&self) -> words::StepInWords<'_> {
        words::StepInWords::of(&self.before, &self.inputs, self.dt_ms, Readings::DEFAULT)
    }

    /// How long the state before the step has lasted when the step is made, in milliseconds, as far as it was counted.
    fn lasted_ms(&self) -> u64 {
        u64::from(self.before.in_state_ms) + u64::from(self.dt_ms)
    }

    /// 2.4: for how long the VCU's bit has been unanswered, in milliseconds, as far as it was counted; `None` if it is
    /// answered at this step, or nothing is waited for.
    fn unanswered_ms(&self) -> Option<u64> {
        let handshake = &self.before.handshake;
        let waits = handshake.active && self.inputs.tsms && self.inputs.ai.status.handshake != handshake.bit;
        if waits { Some(u64::from(handshake.unanswered_ms) + u64::from(self.dt_ms)) } else { None }
    }

    /// 2.4: the VCU's bit has been unanswered for 50 ms.
    fn comms_lost(&self) -> bool {
        match self.unanswered_ms() {
            Some(waited_ms) => waited_ms >= 50,
            None => false,
        }
    }

    /// The 50 ms are full at this very step, to the millisecond.
    fn comms_just_lost(&self) -> bool {
        matches!(self.unanswered_ms(), Some(50))
    }

    /// Whether the document names a reason for EMERGENCY_BRAKE in this step: 3.5, 3.7 or 3.8, by its state.
    fn has_reason_to_brake(&self) -> bool {
        match self.before.state {
            Ready => self.words().section_3_5(),
            Driving => self.words().section_3_7(),
            Finished => self.words().section_3_8(),
            Off | EmergencyBrake => false,
        }
    }
}

/// The speed of the fastest wheel, in rpm.
fn fastest_rpm(inputs: &Inputs) -> i32 {
    let speeds = &inputs.vehicle.wheel_speeds;
    let front = speeds.fl_wheel_speed.raw().max(speeds.fr_wheel_speed.raw());
    let rear = speeds.rl_wheel_speed.raw().max(speeds.rr_wheel_speed.raw());
    front.max(rear)
}
