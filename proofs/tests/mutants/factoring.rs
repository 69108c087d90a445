//! What the theorems of `factoring.rs` and `independence.rs` catch: steps that look at more than they may.

use adsdv_proofs::subject::Subject;
use adsdv_spec::messages::{AsState, SteerAngle};
use adsdv_spec::{AiMessages, Atom, Control, Fault, Inputs, Machine, Observation, Outputs, Reaction, Reads};

use crate::Mutant;

pub(crate) fn mutants() -> Vec<Mutant> {
    vec![
        Mutant::new(
            "inputs_matter_in_off_through_their_observation",
            "a wheel of exactly 77 rpm is remembered",
            LooksAtWheel(77),
        ),
        Mutant::new(
            "inputs_matter_in_ready_through_their_observation",
            "a wheel of exactly 77 rpm is remembered",
            LooksAtWheel(77),
        ),
        Mutant::new(
            "inputs_matter_in_driving_through_their_observation",
            "a wheel of exactly 77 rpm is remembered",
            LooksAtWheel(77),
        ),
        Mutant::new(
            "inputs_matter_in_finished_through_their_observation",
            "a wheel of exactly 77 rpm is remembered",
            LooksAtWheel(77),
        ),
        Mutant::new(
            "inputs_matter_in_emergency_brake_through_their_observation",
            "a wheel of exactly 77 rpm is remembered",
            LooksAtWheel(77),
        ),
        Mutant::new("a_step_is_the_reaction_to_its_observation", "react knows no E-stop", NoEstop),
        Mutant::new("the_next_state_depends_on_the_atoms_alone", "a fault of the BMS is overlooked", NoBms),
        Mutant::new(
            "what_is_not_read_in_off_does_not_matter",
            "reads forgets EbsArmed",
            ReadsLess(Atom::EbsArmed),
        ),
        Mutant::new("what_is_not_read_in_ready_does_not_matter", "reads forgets Asms", ReadsLess(Atom::Asms)),
        Mutant::new(
            "what_is_not_read_in_driving_does_not_matter",
            "reads forgets GoOn",
            ReadsLess(Atom::GoOn),
        ),
        Mutant::new(
            "what_is_not_read_in_finished_does_not_matter",
            "reads forgets Asms",
            ReadsLess(Atom::Asms),
        ),
        Mutant::new(
            "what_is_not_read_in_emergency_brake_does_not_matter",
            "reads forgets Asms",
            ReadsLess(Atom::Asms),
        ),
        Mutant::new(
            "a_running_timer_matters_only_when_it_is_full",
            "\"Go\" counts after half the time",
            Half,
        ),
        Mutant::new("the_go_signal_changes_no_control_state", "the raw switch sets off by itself", RawSwitch),
        Mutant::new(
            "what_is_only_logged_decides_nothing_in_off",
            "a sixteenth lap is remembered",
            CountsLaps,
        ),
        Mutant::new(
            "what_is_only_logged_decides_nothing_in_ready",
            "a sixteenth lap is remembered",
            CountsLaps,
        ),
        Mutant::new(
            "what_is_only_logged_decides_nothing_in_driving",
            "a sixteenth lap is remembered",
            CountsLaps,
        ),
        Mutant::new(
            "what_is_only_logged_decides_nothing_in_finished",
            "a sixteenth lap is remembered",
            CountsLaps,
        ),
        Mutant::new(
            "what_is_only_logged_decides_nothing_in_emergency_brake",
            "a sixteenth lap is remembered",
            CountsLaps,
        ),
        Mutant::new("messages_for_the_logger_reach_nobody", "501h steers", LoggerSteers),
    ]
}

/// A step changed by what it looks at.
#[derive(Clone)]
struct LooksAtWheel(i32);

impl Subject for LooksAtWheel {
    fn step(&self, before: &Control, inputs: &Inputs, dt_ms: u32) -> (Control, Outputs) {
        let (mut after, outputs) = Machine::REFERENCE.step(before, inputs, dt_ms);
        after.go_seen_low ^= inputs.vehicle.wheel_speeds.fl_wheel_speed.raw() == self.0;
        (after, outputs)
    }
}

#[derive(Clone)]
struct NoEstop;

impl Subject for NoEstop {
    fn react(&self, before: &Control, seen: Observation, dt_ms: u32) -> Reaction {
        let faults = seen.faults().without(Fault::AiComputerRequest);
        Machine::REFERENCE.react(before, Observation::new(seen.atoms(), faults), dt_ms)
    }
}

#[derive(Clone)]
struct NoBms;

impl Subject for NoBms {
    fn react(&self, before: &Control, seen: Observation, dt_ms: u32) -> Reaction {
        let faults = seen.faults().without(Fault::BmsFault);
        Machine::REFERENCE.react(before, Observation::new(seen.atoms(), faults), dt_ms)
    }
}

#[derive(Clone)]
struct ReadsLess(Atom);

impl Subject for ReadsLess {
    fn reads(&self, before: &Control, dt_ms: u32) -> Reads {
        let Reads { atoms, faults } = Machine::REFERENCE.reads(before, dt_ms);
        Reads { atoms: atoms.without(self.0), faults }
    }
}

#[derive(Clone)]
struct Half;

impl Subject for Half {
    fn react(&self, before: &Control, seen: Observation, dt_ms: u32) -> Reaction {
        let mut reaction = Machine::REFERENCE.react(before, seen, dt_ms);
        let ready = reaction.control.state == AsState::Ready;
        reaction.control.go_seen_low |= ready && before.in_state_ms >= 2500 && !seen.atoms().has(Atom::GoOn);
        reaction
    }
}

#[derive(Clone)]
struct RawSwitch;

impl Subject for RawSwitch {
    fn step_of(
        &self,
        machine: &Machine,
        before: &Control,
        inputs: &Inputs,
        dt_ms: u32,
    ) -> (Control, Outputs) {
        let (mut after, outputs) = machine.step(before, inputs, dt_ms);
        if outputs.go_signal && after.state == AsState::Ready {
            after.state = AsState::Driving;
        }
        (after, outputs)
    }
}

#[derive(Clone)]
struct CountsLaps;

impl Subject for CountsLaps {
    fn step(&self, before: &Control, inputs: &Inputs, dt_ms: u32) -> (Control, Outputs) {
        let (mut after, outputs) = Machine::REFERENCE.step(before, inputs, dt_ms);
        after.go_seen_low ^= inputs.ai.status.lap_counter.raw() == 15;
        (after, outputs)
    }
}

#[derive(Clone)]
struct LoggerSteers;

impl Subject for LoggerSteers {
    fn receive(&self, ai: &mut AiMessages, id: u16, data: &[u8]) -> bool {
        if id == 0x501 {
            ai.steer.steer_request = SteerAngle::clamped(data.first().copied().unwrap_or(0).into());
        }
        matches!(ai.receive(&self.machine().edition().bus, id, data), Ok(true))
    }
}
