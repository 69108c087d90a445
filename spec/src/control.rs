//! What the VCU remembers between two steps: the control state.
//!
//! It is small and finite: timers stop counting at their limits, and what a state or a reading does not use rests at
//! its initial value, so that equal behaviour is equal control state.

use crate::atoms::Atom;
use crate::derives::data;
use crate::handshake::Handshake;
use crate::limits::Timing;
use crate::messages::{AsState, ShutdownCause};
use crate::readings::{Choice, Readings};

data!(
    /// The control state. The default is the VCU after a power cycle.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
    pub struct Control {
        /// The state of Figure 2.
        pub state: AsState,
        /// How long that state has lasted, in milliseconds, up to the limit of [`Timing::in_state_limit`].
        pub in_state_ms: u16,
        /// `AS_READY` only: the "Go" switch was seen off, so that a rising edge now is accepted (section 3.2, item 3).
        pub go_seen_low: bool,
        /// `AS_DRIVING` only, where changes count ([`Choice::FaultEdge`]): `MISSION_STATUS` was RUNNING.
        pub was_running: bool,
        /// `AS_DRIVING` only, where changes count ([`Choice::FaultEdge`]): `DIRECTION_REQUEST` was FORWARD.
        pub was_forward: bool,
        /// The handshake (section 2.4).
        pub handshake: Handshake,
        /// The vehicle must be power-cycled before it can drive again (section 3.9).
        pub power_cycle_needed: bool,
        /// The fault that shut the vehicle down first (section 2.2).
        pub shutdown_cause: ShutdownCause,
    }
);

impl Control {
    /// The VCU after a power cycle: `AS_OFF`, nothing remembered.
    pub const INITIAL: Self = Self {
        state: AsState::Off, //= SM-3
        in_state_ms: 0,
        go_seen_low: false,
        was_running: false,
        was_forward: false,
        handshake: Handshake::IDLE,
        power_cycle_needed: false,
        shutdown_cause: ShutdownCause::NoShutdown,
    };

    /// The invariant: every step of a VCU with these times and readings keeps it, and the initial state has it.
    ///
    /// Every control state that can be reached is consistent; not every consistent one can be reached.
    pub const fn is_consistent(&self, timing: &Timing, readings: Readings) -> bool {
        let driving = matches!(self.state, AsState::Driving);
        let ready = matches!(self.state, AsState::Ready);
        let braking = matches!(self.state, AsState::EmergencyBrake);
        let shut_down = !matches!(self.shutdown_cause, ShutdownCause::NoShutdown);
        let edges = driving && readings.is(Choice::FaultEdge);
        self.in_state_ms <= timing.in_state_limit(self.state)
            && self.handshake.unanswered_ms <= timing.handshake_ms
            && (self.handshake.active || !self.handshake.bit && self.handshake.unanswered_ms == 0)
            && (ready || !self.go_seen_low)
            && (!self.go_seen_low
                || readings.is(Choice::GoEdgeEnough)
                || self.in_state_ms >= timing.ready_dwell_ms)
            && (edges || !(self.was_running || self.was_forward))
            && (shut_down || !braking)
            && self.power_cycle_needed == (shut_down && readings.is(Choice::PowerCycleLatched))
            && (!self.power_cycle_needed || braking || matches!(self.state, AsState::Off))
    }
}

impl Timing {
    /// Where the time in a state stops counting: 0 for states whose duration does not matter.
    pub const fn in_state_limit(&self, state: AsState) -> u16 {
        match state {
            AsState::Ready => self.ready_dwell_ms,
            AsState::EmergencyBrake => self.ebs_timer_ms,
            AsState::Off | AsState::Driving | AsState::Finished => 0,
        }
    }
}

impl Atom {
    /// The atom that tells whether a state has lasted for its time; `None` for states whose duration does not matter.
    pub const fn of_timer(state: AsState) -> Option<Self> {
        match state {
            AsState::Ready => Some(Self::DwellElapsed),
            AsState::EmergencyBrake => Some(Self::EbsTimerComplete),
            AsState::Off | AsState::Driving | AsState::Finished => None,
        }
    }
}
