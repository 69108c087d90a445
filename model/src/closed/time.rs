//! Time passes: many cycles at once, for people.

use super::{Closed, ClosedAction, ClosedState};

impl Closed {
    /// The state after the cycles in which nothing but timers and the handshake changes, with prompt answers, and how many
    /// cycles those are.
    ///
    /// It ends with the first cycle that changes something else or in which a timer elapses; where no timer runs, after
    /// two answers' time.
    pub(super) fn time_passes(&self, state: &ClosedState) -> (ClosedState, u32) {
        let cycle = u32::from(self.timing.cycle_ms).max(1);
        let timing = &self.machine.edition().rules.timing;
        let longest = timing.in_state_limit(state.control.state).saturating_sub(state.control.in_state_ms);
        let most = u32::from(longest.max(2 * timing.handshake_ms)).div_ceil(cycle);
        let mut now = self.settled(state.clone());
        let before = self.gist(&now);
        for passed in 0..most {
            if self.gist(&now) != before || !self.may_step(&now) {
                return (now, passed);
            }
            let Some(next) = self.after(&now, ClosedAction::VcuCycle) else { return (now, passed) };
            now = self.settled(next);
        }
        (now, most)
    }

    /// The state when all that is on its way has arrived and is answered.
    fn settled(&self, mut state: ClosedState) -> ClosedState {
        let talk = [ClosedAction::FrameToAi, ClosedAction::AiCycle, ClosedAction::FrameToVcu];
        let enabled = |state: &ClosedState, action| match action {
            ClosedAction::FrameToAi => !state.bus.to_ai.is_empty(),
            ClosedAction::AiCycle => self.ai_has_news(state),
            _ => !state.bus.to_vcu.is_empty(),
        };
        while let Some(next) = talk
            .into_iter()
            .find(|&action| enabled(&state, action))
            .and_then(|action| self.after(&state, action))
        {
            state = next;
        }
        state
    }

    /// What is worth stopping for: all but the handshake and the time that a timer has left.
    fn gist(&self, state: &ClosedState) -> ClosedState {
        let timing = &self.machine.edition().rules.timing;
        let mut gist = state.clone();
        let limit = timing.in_state_limit(gist.control.state);
        gist.control.in_state_ms = u16::from(gist.control.in_state_ms >= limit);
        gist.control.handshake.bit = false;
        gist.control.handshake.unanswered_ms = 0;
        gist.received.status.handshake = false;
        gist.ai.handshake = false;
        gist.ai.heard.handshake = false;
        gist.bus = super::Bus::default();
        gist.late_cycles = 0;
        gist
    }
}
