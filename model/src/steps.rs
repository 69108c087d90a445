//! Steps of the VCU, as properties look at them: many at once, which lead from one control state to another.
//!
//! What such steps have in common is known once. What their inputs show is a word, with a bit for each of up to 64 of
//! them; a single step is a word of one.

use std::cell::Cell;

use adsdv_network::Planes;
use adsdv_spec::messages::{
    AsState, AxleTorqueRequest, BrakePressure, DirectionRequest, MotorSpeedMax, SteerAngle,
};
use adsdv_spec::{Actuation, Atom, Atoms, Choice, Control, Inputs, Machine, Outputs, Reaction, Timing};

use crate::document::Document;

/// Up to 64 steps of a machine from one control state to another.
#[derive(Clone, Debug)]
pub struct Steps<'a> {
    /// The document: what the machine should follow.
    pub document: &'static Document,
    /// The times that the document gives, or those of a model with other timers.
    pub timing: &'a Timing,
    /// The control state before the steps.
    pub before: &'a Control,
    /// What the VCU did in one of them.
    reaction: &'a Reaction,
    /// What it saw in each.
    seen: Sight<'a>,
    lanes: u64,
    /// Whether anybody has looked at what was seen.
    looked: Cell<bool>,
}

#[derive(Clone, Copy, Debug)]
enum Sight<'a> {
    One(Atoms),
    Word(&'a Planes),
}

/// Every step, or none: what does not depend on the inputs.
pub const fn every_one(condition: bool) -> u64 {
    if condition { u64::MAX } else { 0 }
}

impl<'a> Steps<'a> {
    /// One step.
    pub(crate) fn one(
        document: &'static Document,
        timing: &'a Timing,
        before: &'a Control,
        seen: Atoms,
        reaction: &'a Reaction,
    ) -> Self {
        let seen = Sight::One(seen);
        Self { document, timing, before, reaction, seen, lanes: 1, looked: Cell::new(false) }
    }

    /// The steps that see what these lanes show. `reaction` is what the VCU did in one of them, and all of them lead to the same
    /// control state.
    pub(crate) fn of_word(
        document: &'static Document,
        timing: &'a Timing,
        before: &'a Control,
        seen: &'a Planes,
        lanes: u64,
        reaction: &'a Reaction,
    ) -> Self {
        let seen = Sight::Word(seen);
        Self { document, timing, before, reaction, seen, lanes, looked: Cell::new(false) }
    }

    /// The steps that there are, a bit each. What others of a word show means nothing.
    pub const fn lanes(&self) -> u64 {
        self.lanes
    }

    /// Whether every step that there is is among these.
    pub const fn all_among(&self, these: u64) -> bool {
        self.lanes & !these == 0
    }

    /// Whether anybody has looked at the inputs since this was asked last. What was found out without that holds of all steps from
    /// the one control state to the other.
    pub(crate) fn were_looked_at(&self) -> bool {
        self.looked.replace(false)
    }

    /// The control state after the steps.
    pub const fn after(&self) -> &Control {
        &self.reaction.control
    }

    /// The steps whose inputs show this condition.
    pub fn see(&self, atom: Atom) -> u64 {
        self.looked.set(true);
        match self.seen {
            Sight::One(atoms) => every_one(atoms.has(atom)),
            Sight::Word(planes) => planes.atom(atom),
        }
    }

    /// The steps whose inputs show all of these conditions, and none of those.
    pub fn show(&self, on: Atoms, off: Atoms) -> u64 {
        self.looked.set(true);
        match self.seen {
            Sight::One(atoms) => every_one(on.is_subset(atoms) && off.intersection(atoms).is_empty()),
            Sight::Word(planes) => planes.show(on, off),
        }
    }

    /// How long the state before the steps has lasted when they are made, in milliseconds, as far as it was counted.
    pub fn lasted_ms(&self) -> u32 {
        u32::from(self.before.in_state_ms) + u32::from(self.timing.cycle_ms)
    }

    /// Whether the state before the steps has lasted for the time that the document gives it.
    pub fn have_lasted(&self) -> bool {
        self.lasted_ms() >= u32::from(self.timing.in_state_limit(self.before.state))
    }

    /// Whether the state after the steps will have lasted for its time at the next step.
    pub fn next_have_lasted(&self) -> bool {
        let next_ms = u32::from(self.after().in_state_ms) + u32::from(self.timing.cycle_ms);
        next_ms >= u32::from(self.timing.in_state_limit(self.after().state))
    }

    /// The steps in which the handshake has been unanswered for as long as the document allows, or, while it is performed, a
    /// message has been missing for as long (section 2.4).
    pub fn comms_lost(&self) -> u64 {
        let handshake = self.after().handshake;
        if handshake.is_lost(self.timing.handshake_ms) {
            every_one(true)
        } else if handshake.active && self.has(Atom::AiMessagesMissed) {
            self.see(Atom::AiMessagesMissed)
        } else {
            0
        }
    }

    /// Whether the document knows a condition at all.
    const fn has(&self, atom: Atom) -> bool {
        self.document.scope.has(atom)
    }

    /// The steps in which the handshake went on as section 2.4 has it: an answer turns the bit round, and without one it stays,
    /// and the time is counted from the first active step on.
    pub fn handshake_is_counted(&self, timing: &Timing) -> u64 {
        let (before, after) = (self.before.handshake, self.after().handshake);
        if !after.active {
            return !self.see(Atom::Tsms);
        }
        let one = self.see(Atom::AiHandshake);
        let answered = if before.bit { one } else { !one };
        let turns = after.bit != before.bit && after.unanswered_ms == 0;
        let counted =
            if before.active { u32::from(before.unanswered_ms) + u32::from(self.timing.cycle_ms) } else { 0 };
        let waits = after.bit == before.bit
            && u32::from(after.unanswered_ms) == counted.min(timing.handshake_ms.into());
        answered & every_one(turns) | !answered & every_one(waits)
    }

    /// The steps in which the document names a reason for `EMERGENCY_BRAKE` in what is seen (sections 2.1, 2.4, 3.5, 3.7,
    /// 3.8, 4).
    pub fn have_reason_to_brake(&self) -> u64 {
        let driving = self.before.state == AsState::Driving;
        let mut reason = self.see(Atom::SdcOpen) | self.comms_lost();
        if driving || self.document.edition.readings.is(Choice::EstopEveryState) {
            reason |= self.see(Atom::AiEstop);
        }
        if driving && !self.all_among(reason) {
            reason |= self.have_reason_to_stop_driving();
        }
        reason
    }

    /// Those in which it names a reason of `AS_DRIVING` alone (sections 3.7, 4).
    fn have_reason_to_stop_driving(&self) -> u64 {
        let fast =
            (self.see(Atom::MissionFinished) | self.see(Atom::DirectionNeutral)) & self.see(Atom::Moving);
        let mut reason = !self.see(Atom::Asms) | !self.see(Atom::GoOn) | fast;
        // Where the motors are taken never to be in torque control mode, it is no fault.
        let is_fault = !self.document.edition.readings.is(Choice::TorqueNever);
        if is_fault && self.has(Atom::BrakeRequestZero) {
            let torque = !self.see(Atom::FrontTorqueZero) | !self.see(Atom::RearTorqueZero);
            reason |= torque & !self.see(Atom::BrakeRequestZero);
        }
        for fault in [Atom::EbsUnavailable, Atom::BmsFault] {
            if self.has(fault) {
                reason |= self.see(fault);
            }
        }
        reason
    }

    /// The steps in which drive or steering requests reach the actuators, were the AI Computer to request all it can.
    pub fn drive(&self, machine: &Machine) -> u64 {
        self.by_go(|go| self.requests_reach(machine, go).contains(&true))
    }

    /// The steps in which 520h carries `GO_SIGNAL` 1.
    pub fn go_signal(&self, machine: &Machine) -> u64 {
        self.by_go(|go| self.outputs(machine, go).go_signal)
    }

    /// The steps of which something holds that follows from the "Go" switch.
    fn by_go(&self, holds: impl Fn(bool) -> bool) -> u64 {
        match (holds(false), holds(true)) {
            (false, true) => self.see(Atom::GoOn),
            (true, false) => !self.see(Atom::GoOn),
            (same, _) => every_one(same),
        }
    }

    /// Whether what the AI Computer could request of torque, speed, direction and steering reaches the actuators.
    pub(crate) fn requests_reach(&self, machine: &Machine, go: bool) -> [bool; 4] {
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
        } = self.outputs(machine, go).actuation(&full_requests());
        [
            [front_axle_trq, rear_axle_trq] != [AxleTorqueRequest::default(); 2],
            [front_motor_speed_max, rear_motor_speed_max] != [MotorSpeedMax::default(); 2],
            direction != DirectionRequest::Neutral,
            steer.is_some(),
        ]
    }

    fn outputs(&self, machine: &Machine, go: bool) -> Outputs {
        machine.outputs(self.before.state, self.reaction, go)
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
