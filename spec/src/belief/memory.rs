//! What a VCU may remember.

use crate::belief::{Causes, Handshakes, Span};
use crate::control::Control;
use crate::limits::Timing;
use crate::messages::AsState;
use crate::truth::Truth;

/// All that a VCU may remember beside its AS state: a [`Control`] with a range for each of its fields.
///
/// The fields are taken one by one: a memory allows every combination of what they allow.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Memory {
    /// How long the state has lasted.
    pub in_state: Span,
    /// Whether the "Go" switch was seen off, so that a rising edge is accepted.
    pub go_seen_low: Truth,
    /// Whether `MISSION_STATUS` was RUNNING.
    pub was_running: Truth,
    /// Whether `DIRECTION_REQUEST` was FORWARD.
    pub was_forward: Truth,
    /// The handshake.
    pub handshake: Handshakes,
    /// Whether the vehicle must be power-cycled.
    pub power_cycle_needed: Truth,
    /// `SHUTDOWN_CAUSE`.
    pub shutdown_cause: Causes,
}

impl Memory {
    /// What this control state remembers, and nothing else.
    pub fn exact(control: &Control) -> Self {
        Self {
            in_state: Span::exact(control.in_state_ms),
            go_seen_low: control.go_seen_low.into(),
            was_running: control.was_running.into(),
            was_forward: control.was_forward.into(),
            handshake: Handshakes::exact(control.handshake),
            power_cycle_needed: control.power_cycle_needed.into(),
            shutdown_cause: Causes::exact(control.shutdown_cause),
        }
    }

    /// Anything that a VCU with these times can remember in a state.
    pub const fn anything(state: AsState, timing: &Timing) -> Self {
        Self {
            in_state: Span::between(0, timing.in_state_limit(state)),
            go_seen_low: Truth::Unknown,
            was_running: Truth::Unknown,
            was_forward: Truth::Unknown,
            handshake: Handshakes::any(timing.handshake_ms),
            power_cycle_needed: Truth::Unknown,
            shutdown_cause: Causes::ANY,
        }
    }

    /// Whether this may be what is remembered, whatever the state.
    pub const fn allows(&self, control: &Control) -> bool {
        self.in_state.allows(control.in_state_ms)
            && self.go_seen_low.allows(control.go_seen_low)
            && self.was_running.allows(control.was_running)
            && self.was_forward.allows(control.was_forward)
            && self.handshake.allows(control.handshake)
            && self.power_cycle_needed.allows(control.power_cycle_needed)
            && self.shutdown_cause.allows(control.shutdown_cause)
    }

    /// Whether this allows all that the other does.
    pub const fn covers(&self, other: &Self) -> bool {
        self.in_state.covers(other.in_state)
            && self.go_seen_low.covers(other.go_seen_low)
            && self.was_running.covers(other.was_running)
            && self.was_forward.covers(other.was_forward)
            && self.handshake.covers(&other.handshake)
            && self.power_cycle_needed.covers(other.power_cycle_needed)
            && self.shutdown_cause.covers(other.shutdown_cause)
    }

    /// What may be remembered when either may be what was so.
    #[must_use]
    pub const fn or(self, other: Self) -> Self {
        Self {
            in_state: self.in_state.or(other.in_state),
            go_seen_low: self.go_seen_low.agree(other.go_seen_low),
            was_running: self.was_running.agree(other.was_running),
            was_forward: self.was_forward.agree(other.was_forward),
            handshake: self.handshake.or(other.handshake),
            power_cycle_needed: self.power_cycle_needed.agree(other.power_cycle_needed),
            shutdown_cause: self.shutdown_cause.or(other.shutdown_cause),
        }
    }
}

/// What is so of each AS state; `None` where the VCU cannot be in it.
pub(crate) type EachState<T> = [Option<T>; AsState::ALL.len()];

/// The place of a state in [`EachState`]; states count from 1.
pub(crate) const fn place(state: AsState) -> usize {
    state as usize - 1
}

/// What the [`Control`] of a VCU may be: for each AS state that it may be in, what it may remember there.
///
/// ```
/// use adsdv_spec::{AsState, Control, Edition, belief::Belief};
///
/// let anything = Belief::anything(&Edition::V3_0.rules.timing);
/// assert!(anything.allows(&Control::INITIAL));
/// let ready = anything.given(AsState::Ready);
/// assert!(!ready.allows(&Control::INITIAL));
/// assert_eq!(ready.states().collect::<Vec<_>>(), [AsState::Ready]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Belief {
    of: EachState<Memory>,
}

impl Belief {
    /// Nothing may be: what was seen is not what the specification does.
    pub const NONE: Self = Self { of: [None; AsState::ALL.len()] };

    /// This control state and no other.
    pub fn exact(control: &Control) -> Self {
        Self::NONE.with(control.state, Memory::exact(control))
    }

    /// Anything that a VCU with these times can be in.
    pub const fn anything(timing: &Timing) -> Self {
        let mut belief = Self::NONE;
        let mut i = 0;
        while i < AsState::ALL.len() {
            belief.of[i] = Some(Memory::anything(AsState::ALL[i], timing));
            i += 1;
        }
        belief
    }

    /// What may be remembered in a state; `None` if the VCU cannot be in it.
    pub const fn memory(&self, state: AsState) -> Option<&Memory> {
        self.of[place(state)].as_ref()
    }

    /// The same, but for what may be remembered in this state.
    #[must_use]
    pub const fn with(mut self, state: AsState, memory: Memory) -> Self {
        self.of[place(state)] = Some(memory);
        self
    }

    /// What is left of it when this is the state.
    #[must_use]
    pub const fn given(&self, state: AsState) -> Self {
        let mut belief = Self::NONE;
        belief.of[place(state)] = self.of[place(state)];
        belief
    }

    /// The states that the VCU may be in.
    pub fn states(&self) -> impl Iterator<Item = AsState> {
        AsState::ALL.into_iter().filter(|&state| self.memory(state).is_some())
    }

    /// Whether nothing may be.
    pub fn is_empty(&self) -> bool {
        self.of.iter().all(Option::is_none)
    }

    /// Whether this may be the control state.
    pub const fn allows(&self, control: &Control) -> bool {
        match self.memory(control.state) {
            Some(memory) => memory.allows(control),
            None => false,
        }
    }

    /// Whether this allows all that the other does.
    pub fn covers(&self, other: &Self) -> bool {
        self.of.iter().zip(&other.of).all(|pair| match pair {
            (_, None) => true,
            (None, Some(_)) => false,
            (Some(one), Some(other)) => one.covers(other),
        })
    }

    /// What may be when either may be what was so.
    #[must_use]
    pub fn or(self, other: &Self) -> Self {
        let mut both = self;
        for (one, other) in both.of.iter_mut().zip(&other.of) {
            *one = match (*one, *other) {
                (Some(one), Some(other)) => Some(one.or(other)),
                (one, other) => one.or(other),
            };
        }
        both
    }
}
