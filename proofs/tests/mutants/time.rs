//! What the theorems of `time.rs` catch: clocks that count wrongly.

use adsdv_proofs::subject::Subject;
use adsdv_spec::{AsState, Control, Inputs, Machine, Outputs};

use crate::Mutant;

pub(crate) fn mutants() -> Vec<Mutant> {
    vec![
        Mutant::new("two_steps_in_off_are_one", "each step counts one millisecond more", OneMore),
        Mutant::new("two_steps_in_ready_are_one", "each step counts one millisecond more", OneMore),
        Mutant::new("two_steps_in_driving_are_one", "each step counts one millisecond more", OneMore),
        Mutant::new("two_steps_in_finished_are_one", "each step counts one millisecond more", OneMore),
        Mutant::new("two_steps_in_emergency_brake_are_one", "each step counts one millisecond more", OneMore),
        Mutant::new(
            "two_steps_are_one_where_an_edge_is_enough",
            "each step counts one millisecond more",
            OneMore,
        ),
        Mutant::new("saturated_timers_change_nothing", "after a minute the timer begins anew", Wraps),
        Mutant::new("timers_are_the_time_that_has_passed", "each step counts one millisecond more", OneMore),
        Mutant::new("timers_are_the_time_that_has_passed", "the timer goes on in the next state", GoesOn),
        Mutant::new(
            "a_faster_cycle_in_off_takes_nothing_that_a_slower_one_forbids",
            "a long step forgets the time before it",
            LongStepForgets,
        ),
        Mutant::new(
            "a_faster_cycle_in_ready_takes_nothing_that_a_slower_one_forbids",
            "a long step forgets the time before it",
            LongStepForgets,
        ),
        Mutant::new(
            "a_faster_cycle_in_driving_takes_nothing_that_a_slower_one_forbids",
            "a long step forgets the time before it",
            LongStepForgets,
        ),
        Mutant::new(
            "a_faster_cycle_in_finished_takes_nothing_that_a_slower_one_forbids",
            "a long step forgets the time before it",
            LongStepForgets,
        ),
        Mutant::new(
            "a_faster_cycle_in_emergency_brake_takes_nothing_that_a_slower_one_forbids",
            "a long step forgets the time before it",
            LongStepForgets,
        ),
    ]
}

/// Each step counts one millisecond more than have passed.
#[derive(Clone)]
struct OneMore;

impl Subject for OneMore {
    fn step_of(
        &self,
        machine: &Machine,
        before: &Control,
        inputs: &Inputs,
        dt_ms: u32,
    ) -> (Control, Outputs) {
        machine.step(before, inputs, dt_ms.saturating_add(1))
    }
}

/// A step of more than a minute begins a timer anew.
#[derive(Clone)]
struct Wraps;

impl Subject for Wraps {
    fn step(&self, before: &Control, inputs: &Inputs, dt_ms: u32) -> (Control, Outputs) {
        let in_state_ms = if dt_ms > 60_000 { 0 } else { before.in_state_ms };
        Machine::REFERENCE.step(&Control { in_state_ms, ..*before }, inputs, dt_ms % 60_000)
    }
}

/// The time in AS_READY counts in EMERGENCY_BRAKE as well.
#[derive(Clone)]
struct GoesOn;

impl Subject for GoesOn {
    fn step(&self, before: &Control, inputs: &Inputs, dt_ms: u32) -> (Control, Outputs) {
        let (mut after, outputs) = Machine::REFERENCE.step(before, inputs, dt_ms);
        if after.state == AsState::EmergencyBrake && before.state == AsState::Ready {
            after.in_state_ms = before.in_state_ms;
        }
        (after, outputs)
    }
}

/// A step of more than a second counts from zero, and no time.
#[derive(Clone)]
struct LongStepForgets;

impl Subject for LongStepForgets {
    fn step(&self, before: &Control, inputs: &Inputs, dt_ms: u32) -> (Control, Outputs) {
        if !(1001..5000).contains(&dt_ms) {
            return Machine::REFERENCE.step(before, inputs, dt_ms);
        }
        let mut before = Control { in_state_ms: 0, ..*before };
        before.handshake.unanswered_ms = 0;
        Machine::REFERENCE.step(&before, inputs, 0)
    }
}
