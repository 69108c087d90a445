//! The state of all together.

use std::hash::{Hash, Hasher};

use adsdv_ai::FromVcu;
use adsdv_spec::messages::{AsState, EbsState, Vcu2AiWheelSpeeds, WheelSpeed};
use adsdv_spec::{AiMessages, Control, Inputs, ShutdownCircuit, Vehicle};

use super::{AiComputer, Bus, Closed, ClosedAction, Operator, Switches};
use crate::document::Document;

/// The state of the VCU, the AI Computer, the bus, the operator and the vehicle.
///
/// It debugs in words, for the Explorer. Two states are the same where those that wait for frames will make the same of
/// them, whatever else these say.
#[derive(Clone, Default)]
pub struct ClosedState {
    /// The document that the AI Computer follows: the same in every state of a model, and no part of what is compared.
    pub document: &'static Document,
    /// What the VCU remembers.
    pub control: Control,
    /// What the VCU has received last.
    pub received: AiMessages,
    /// The AI Computer.
    pub ai: AiComputer,
    /// The frames on their way.
    pub bus: Bus,
    /// The switches.
    pub switches: Switches,
    /// The vehicle.
    pub motion: Motion,
    /// The fault of this model: the remote E-stop button opens the shutdown circuit.
    pub remote_estop: bool,
    /// For how many steps of the VCU an answer has been missing.
    pub late_cycles: u8,
    /// With any operator: a switch was moved, or the fault came or went, since the VCU's last step.
    pub acted: bool,
    /// With a well-behaved operator: how far the mission is.
    pub mission: Mission,
    /// With a well-behaved operator: how many acts are done.
    pub acts: u8,
    /// With a well-behaved operator: the VCU has seen the last act.
    pub rested: bool,
    /// With a well-behaved operator: for how many steps of the VCU nothing has happened that [`Rank`] counts.
    pub patience: u16,
}

impl ClosedState {
    /// What the VCU sees.
    pub(super) fn inputs(&self) -> Inputs {
        let switches = self.switches;
        let speed = self.motion.wheels.speed(self.document.edition.rules.thresholds.wheel_speed);
        Inputs {
            asms: switches.asms,
            tsms: switches.tsms,
            ami: switches.ami,
            ebs: if switches.ebs_armed { EbsState::Armed } else { EbsState::Unavailable },
            go: switches.go,
            sdc: ShutdownCircuit { remote_estop: self.remote_estop, ..ShutdownCircuit::default() },
            ai: self.received,
            vehicle: Vehicle {
                wheel_speeds: Vcu2AiWheelSpeeds {
                    fl_wheel_speed: speed,
                    fr_wheel_speed: speed,
                    rl_wheel_speed: speed,
                    rr_wheel_speed: speed,
                },
                ..Vehicle::default()
            },
            ..Inputs::default()
        }
    }

    /// All that the future depends on.
    fn key(&self) -> impl PartialEq + Hash {
        let Self { control, received, ai, ref bus, switches, motion, remote_estop, .. } = *self;
        let Self { late_cycles, acted, mission, acts, rested, patience, .. } = *self;
        let edition = self.document.edition;
        // Of frames to the AI Computer only what it keeps matters; those to the VCU say nothing else.
        let heard = bus
            .to_ai
            .each()
            .map(|frame| frame.map(|frame| (frame.id, FromVcu::default().with(&frame, edition))));
        let old = bus.to_ai.is_overdue();
        let parties = (control, received, ai, switches, motion, remote_estop);
        (parties, heard, old, bus.to_vcu, (late_cycles, acted, mission, acts, rested, patience))
    }
}

impl PartialEq for ClosedState {
    fn eq(&self, other: &Self) -> bool {
        self.key() == other.key()
    }
}

impl Eq for ClosedState {}

impl Hash for ClosedState {
    fn hash<H: Hasher>(&self, hasher: &mut H) {
        let mut packed = Packed { into: hasher, bytes: [0; PACKED], filled: 0 };
        self.key().hash(&mut packed);
        packed.flush();
    }
}

/// Many more bytes than a state has.
const PACKED: usize = 256;

/// What is to be hashed, gathered: a hasher takes many bytes at once faster than each by itself.
struct Packed<'a, H> {
    into: &'a mut H,
    bytes: [u8; PACKED],
    filled: usize,
}

impl<H: Hasher> Packed<'_, H> {
    fn flush(&mut self) {
        self.into.write(self.bytes.get(..self.filled).unwrap_or_default());
        self.filled = 0;
    }
}

impl<H: Hasher> Hasher for Packed<'_, H> {
    #[inline]
    fn write(&mut self, bytes: &[u8]) {
        if self.filled + bytes.len() > PACKED {
            self.flush();
        }
        match self.bytes.get_mut(self.filled..self.filled + bytes.len()) {
            Some(room) => {
                room.copy_from_slice(bytes);
                self.filled += bytes.len();
            }
            None => self.into.write(bytes),
        }
    }

    /// Nobody asks: the hash is made of what is flushed.
    fn finish(&self) -> u64 {
        self.into.finish()
    }
}

/// Whether the mission was finished, and ended in AS_OFF: latched.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Mission {
    /// It is not finished.
    #[default]
    Ahead,
    /// AS_FINISHED was reached.
    Finished,
    /// After that, AS_OFF was reached.
    Over,
}

impl Mission {
    pub(super) const fn after(self, state: AsState) -> Self {
        match (self, state) {
            (Self::Ahead, AsState::Finished) => Self::Finished,
            (Self::Finished, AsState::Off) => Self::Over,
            _ => self,
        }
    }
}

/// How the vehicle moves.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Motion {
    /// The wheels.
    pub wheels: Wheels,
    /// Torque reached the motors at the VCU's last step.
    pub driven: bool,
    /// The brakes were applied at the VCU's last step.
    pub braked: bool,
}

impl Motion {
    /// Whether the vehicle turns slower now: it moves only when driven, and stops when braked.
    pub fn must_slow_down(self) -> bool {
        self.braked && self.wheels != Wheels::AtRest
    }
}

/// How fast the wheels turn, as far as the document tells speeds apart.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Wheels {
    /// All stand still.
    #[default]
    AtRest,
    /// They turn exactly at the threshold: neither at rest nor moving (D-24).
    AtThreshold,
    /// They turn faster than that.
    Moving,
}

impl Wheels {
    pub(super) const fn faster(self) -> Option<Self> {
        match self {
            Self::AtRest => Some(Self::AtThreshold),
            Self::AtThreshold => Some(Self::Moving),
            Self::Moving => None,
        }
    }

    pub(super) const fn slower(self) -> Option<Self> {
        match self {
            Self::AtRest => None,
            Self::AtThreshold => Some(Self::AtRest),
            Self::Moving => Some(Self::AtThreshold),
        }
    }

    pub(super) const fn speed(self, limit: WheelSpeed) -> WheelSpeed {
        match self {
            Self::AtRest => WheelSpeed::MIN,
            Self::AtThreshold => limit,
            Self::Moving => WheelSpeed::clamped(limit.raw() + 1),
        }
    }
}

/// How far the run is. Every action raises it with a well-behaved operator, so that no path comes back to where it was.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Rank {
    /// How far operator, VCU, AI Computer and vehicle have come with the mission.
    progress: u16,
    /// For how many steps of the VCU that has not changed.
    patience: u16,
    /// Within a cycle of the VCU, how much of it has been said, thought and heard.
    talk: i16,
}

impl Closed {
    /// The rank of a state.
    pub fn rank(&self, state: &ClosedState) -> Rank {
        Rank { progress: self.progress(state), patience: state.patience, talk: -self.talk_ahead(state) }
    }

    fn progress(&self, state: &ClosedState) -> u16 {
        let wheels = state.motion.wheels as u16;
        let (figure, vehicle) = match (state.mission, state.control.state) {
            (Mission::Over, _) => (5, 4),
            (_, AsState::Off) => (0, 0),
            (_, AsState::Ready) => (1 + u16::from(self.dwell_is_over(state)), 0),
            (_, AsState::Driving) => (3, if state.motion.braked { 4 - wheels } else { wheels }),
            (_, AsState::Finished | AsState::EmergencyBrake) => (4, 4),
        };
        figure + vehicle + u16::from(state.acts) + state.ai.stage as u16
    }

    /// How many frames can still arrive, and cycles of the AI Computer follow, until the VCU steps. A frame that arrives
    /// costs more than the cycle that it can set off, and that more than all the frames that it can send.
    fn talk_ahead(&self, state: &ClosedState) -> i16 {
        let sum = |line: &super::WaitingFrames, each: i16| line.frames().map(|_| each).sum::<i16>();
        sum(&state.bus.to_ai, 7) + if self.ai_has_news(state) { 6 } else { 0 } + sum(&state.bus.to_vcu, 1)
    }

    pub(super) fn count_patience(&self, before: &ClosedState, action: ClosedAction, state: &mut ClosedState) {
        if self.operator == Operator::Any {
            return;
        }
        if self.progress(before) != self.progress(state) {
            state.patience = 0;
        } else if action == ClosedAction::VcuCycle {
            state.patience = state.patience.saturating_add(1);
        }
    }
}

#[cfg(test)]
mod tests {
    use adsdv_spec::Atom;

    use super::*;

    #[test]
    fn the_vcu_sees_whether_the_wheels_turn() {
        for (wheels, at_rest, moving) in [
            (Wheels::AtRest, true, false),
            (Wheels::AtThreshold, false, false),
            (Wheels::Moving, false, true),
        ] {
            let motion = Motion { wheels, ..Motion::default() };
            let state = ClosedState { motion, ..ClosedState::default() };
            let atoms = state.inputs().observe(&state.document.edition.rules.thresholds).atoms();
            assert_eq!((atoms.has(Atom::AtRest), atoms.has(Atom::Moving)), (at_rest, moving), "{wheels:?}");
        }
    }
}
