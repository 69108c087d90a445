//! One step of the VCU, as properties look at it.

use adsdv_spec::messages::{
    AsState, AxleTorqueRequest, BrakePressure, DirectionRequest, MotorSpeedMax, SteerAngle,
};
use adsdv_spec::{
    Actuation, Atom, Atoms, Choice, Control, Edition, Faults, Inputs, Machine, Observation, Outputs,
    Reaction, Taken, Timing,
};

use crate::document::{DEFAULT, Document};

/// The VCU's cycle, which is the model's, and the same in every edition. That steps of any length are right is for the proofs.
pub(crate) const CYCLE_MS: u32 = {
    let cycle_ms = DEFAULT.rules.timing.cycle_ms;
    let mut place = 0;
    while place < Edition::ALL.len() {
        assert!(Edition::ALL[place].rules.timing.cycle_ms == cycle_ms, "the model steps every edition alike");
        place += 1;
    }
    cycle_ms as u32
};

/// A step: what was, what was seen, and what the VCU made of it.
///
/// Of the faults it has the conditions that they decide, and the cause that is remembered: steps that differ in the faults alone
/// are the same to whoever looks at them so.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Step {
    /// The document: what the machine should follow.
    pub document: &'static Document,
    /// The times that the document gives, or those of a model with other timers.
    pub timing: Timing,
    /// The control state before the step.
    pub before: Control,
    /// What the VCU saw.
    seen: Atoms,
    /// What it did, but for the faults that it shows.
    reaction: Reaction,
}

impl Step {
    /// The step of a machine, one cycle after its last.
    pub fn of(machine: &Machine, timing: &Timing, before: Control, seen: Observation) -> Self {
        let reaction = machine.react(&before, seen, CYCLE_MS);
        Self::taken_by(Document::of_machine(machine), timing, before, seen, reaction)
    }

    /// The same where it is known what the machine does.
    pub(crate) fn taken_by(
        document: &'static Document,
        timing: &Timing,
        before: Control,
        seen: Observation,
        reaction: Reaction,
    ) -> Self {
        let reaction = Reaction { faults: Faults::NONE, ..reaction };
        Self { document, timing: *timing, before, seen: seen.atoms(), reaction }
    }

    /// Whether the same machine, out of the same state, would take the same step where it sees this and does that.
    pub(crate) fn is(&self, seen: Observation, reaction: &Reaction) -> bool {
        let Reaction { control, taken, atoms, faults: _ } = reaction;
        let own = &self.reaction;
        (self.seen, &own.control, &own.taken, &own.atoms) == (seen.atoms(), control, taken, atoms)
    }

    /// The same step, had it led to another control state.
    #[must_use]
    pub fn leading_to(self, control: Control) -> Self {
        Self { reaction: Reaction { control, ..self.reaction }, ..self }
    }

    /// The row that was taken; `None` if the state stays.
    pub const fn taken(&self) -> Option<Taken> {
        self.reaction.taken
    }

    /// All conditions as the guards saw them.
    pub const fn guarded(&self) -> Atoms {
        self.reaction.atoms
    }

    /// The control state after the step.
    pub fn after(&self) -> &Control {
        &self.reaction.control
    }

    /// Whether the inputs show this condition.
    pub fn sees(&self, atom: Atom) -> bool {
        self.seen.has(atom)
    }

    /// Whether the inputs show all of these conditions, and none of those.
    pub fn shows(&self, on: Atoms, off: Atoms) -> bool {
        on.is_subset(self.seen) && off.intersection(self.seen).is_empty()
    }

    /// How long the state before the step has lasted when the step is made, in milliseconds, as far as it was counted.
    pub fn lasted_ms(&self) -> u32 {
        u32::from(self.before.in_state_ms) + CYCLE_MS
    }

    /// Whether the state before the step has lasted for the time that the document gives it.
    pub fn has_lasted(&self) -> bool {
        self.lasted_ms() >= u32::from(self.timing.in_state_limit(self.before.state))
    }

    /// Whether the state after the step will have lasted for its time at the next step.
    pub fn next_has_lasted(&self) -> bool {
        let next_ms = u32::from(self.after().in_state_ms) + CYCLE_MS;
        next_ms >= u32::from(self.timing.in_state_limit(self.after().state))
    }

    /// Whether the handshake has been unanswered for as long as the document allows, or, while it is performed, a message
    /// has been missing for as long (section 2.4).
    pub fn comms_lost(&self) -> bool {
        let handshake = self.after().handshake;
        handshake.is_lost(self.timing.handshake_ms)
            || handshake.active && self.has(Atom::AiMessagesMissed) && self.sees(Atom::AiMessagesMissed)
    }

    /// Whether the document knows a condition at all.
    fn has(&self, atom: Atom) -> bool {
        self.document.scope.has(atom)
    }

    /// Whether the handshake went on as section 2.4 has it: an answer turns the bit round, and without one it stays, and
    /// the time is counted from the first active step on.
    pub fn handshake_is_counted(&self, timing: &Timing) -> bool {
        let (before, after) = (self.before.handshake, self.after().handshake);
        if !after.active {
            !self.sees(Atom::Tsms)
        } else if self.sees(Atom::AiHandshake) == before.bit {
            after.bit != before.bit && after.unanswered_ms == 0
        } else {
            let counted = if before.active { u32::from(before.unanswered_ms) + CYCLE_MS } else { 0 };
            after.bit == before.bit
                && u32::from(after.unanswered_ms) == counted.min(timing.handshake_ms.into())
        }
    }

    /// Whether the document names a reason for `EMERGENCY_BRAKE` in what is seen (sections 2.1, 2.4, 3.5, 3.7, 3.8, 4).
    pub fn has_reason_to_brake(&self) -> bool {
        let driving = self.before.state == AsState::Driving;
        let estop = driving || self.document.edition.readings.is(Choice::EstopEveryState);
        self.sees(Atom::SdcOpen)
            || estop && self.sees(Atom::AiEstop)
            || self.comms_lost()
            || driving && self.has_reason_to_stop_driving()
    }

    /// Whether the document names a reason of `AS_DRIVING` alone (sections 3.7, 4).
    fn has_reason_to_stop_driving(&self) -> bool {
        let fast = self.sees(Atom::MissionFinished) || self.sees(Atom::DirectionNeutral);
        let torque = !self.sees(Atom::FrontTorqueZero) || !self.sees(Atom::RearTorqueZero);
        !self.sees(Atom::Asms)
            || !self.sees(Atom::GoOn)
            || fast && self.sees(Atom::Moving)
            || self.has(Atom::BrakeRequestZero) && torque && !self.sees(Atom::BrakeRequestZero)
            || self.has(Atom::EbsUnavailable) && self.sees(Atom::EbsUnavailable)
            || self.has(Atom::BmsFault) && self.sees(Atom::BmsFault)
    }

    /// Whether drive or steering requests reach the actuators, were the AI Computer to request all it can.
    pub fn drives(&self, machine: &Machine) -> bool {
        self.requests_reach(machine).contains(&true)
    }

    /// Whether what the AI Computer could request of torque, speed, direction and steering reaches the actuators.
    fn requests_reach(&self, machine: &Machine) -> [bool; 4] {
        let Actuation {
            front_axle_trq,
            front_motor_speed_max,
            rear_axle_trq,
            rear_motor_speed_max,
            direction,
            steer,
            hyd_press_f: BrakePressure { .. },
            hyd_press_r: BrakePressure { .. },
            ebs_triggered: _,
        } = self.outputs(machine).actuation(&full_requests());
        [
            [front_axle_trq, rear_axle_trq] != [AxleTorqueRequest::default(); 2],
            [front_motor_speed_max, rear_motor_speed_max] != [MotorSpeedMax::default(); 2],
            direction != DirectionRequest::Neutral,
            steer.is_some(),
        ]
    }

    /// Whether 520h carries `GO_SIGNAL` 1.
    pub fn go_signal(&self, machine: &Machine) -> bool {
        self.outputs(machine).go_signal
    }

    fn outputs(&self, machine: &Machine) -> Outputs {
        machine.outputs(self.before.state, &self.reaction, self.sees(Atom::GoOn))
    }
}

/// An AI Computer that requests all it can.
fn full_requests() -> Inputs {
    let mut inputs = Inputs::default();
    let ai = &mut inputs.ai;
    ai.status.direction_request = DirectionRequest::Forward;
    ai.drive_f.front_axle_trq_request = AxleTorqueRequest::MAX;
    ai.drive_f.front_motor_speed_max = MotorSpeedMax::MAX;
    ai.drive_r.rear_axle_trq_request = AxleTorqueRequest::MAX;
    ai.drive_r.rear_motor_speed_max = MotorSpeedMax::MAX;
    ai.steer.steer_request = SteerAngle::MAX;
    inputs
}

#[cfg(test)]
mod tests {
    use adsdv_spec::Faults;

    use super::*;

    #[test]
    fn requests_reach_all_of_the_actuators_or_none() {
        let machine = Machine::REFERENCE;
        let seen = Observation::new(Atoms::of(&[Atom::Asms, Atom::Tsms, Atom::GoOn]), Faults::NONE);
        for state in AsState::ALL {
            let control = Control { state, ..Control::INITIAL };
            let step = Step::of(&machine, &machine.edition().rules.timing, control, seen);
            assert_eq!(step.requests_reach(&machine), [state == AsState::Driving; 4], "{state}");
        }
    }
}
