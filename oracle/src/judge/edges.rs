//! Changes that count: conditions of the one step in which the VCU first sees another value.
//!
//! The bus does not show which step that was, so such a condition is true, or possible, for a window only. No guard that
//! needs it can hold for longer than a deadline. That a transition is due is certain once all the rest of its guard was so
//! on either side of the change for a window: whichever step it was, it saw the guard hold.

use adsdv_spec::{AsState, Atom, Atoms, Truth};

use super::Judge;
use super::events::{Pending, PendingKind};
use super::status::Timer;

/// The changes that only count in `AS_DRIVING`.
pub(super) const IN_DRIVING: [Atom; 2] = [Atom::MissionFinishedEdge, Atom::DirectionNeutralEdge];

impl Judge {
    /// The bus shows a change from now on; `truth` is whether it counts. The VCU sees it within a window, and never again.
    pub(super) fn change_seen(&mut self, t: i64, edge: Atom, truth: Truth) {
        let Some(state) = self.vcu.state.filter(|_| truth != Truth::False) else { return };
        self.change_passes(t, edge);
        let wait = self.wait_for(self.deciding(state));
        self.suspend(t, wait, self.known.set(edge, truth), PendingKind::Change(edge));
    }

    /// If there was a change by `t`, the VCU has seen it after a window.
    pub(super) fn change_passes(&mut self, t: i64, edge: Atom) {
        // Where `GO_SIGNAL` is the accepted edge, what it shows is not over with the step.
        let becomes = if edge == Atom::GoEdge { Truth::Unknown } else { Truth::False };
        let at = t + self.window;
        self.vcu.timers.retain(|timer| timer.atom != edge);
        self.vcu.timers.push(Timer { at, atom: edge, becomes });
        self.wake_at(at);
    }

    /// The window behind a change has passed: did the VCU see a guard hold, whenever it saw the change?
    pub(super) fn judge_change(&mut self, pending: &Pending, edge: Atom, now: i64) {
        let t = pending.t;
        let (start, end) = (t - self.window, t + self.window);
        let Some(state) = self.vcu.state else { return };
        if self.moments(start, now).iter().any(|moment| moment.state != Some(state)) {
            return;
        }
        // The frame that is missing may be the one of the step that saw the change.
        let filled =
            self.moments(start, end).iter().fold(Atoms::NONE, |all, moment| all.union(moment.filled));
        let (before, after) = (self.throughout(start, t - 1, now), self.throughout(t, end, now));
        let counts = match edge {
            Atom::MissionFinishedEdge => before.of(Atom::MissionRunning) == Truth::True,
            Atom::DirectionNeutralEdge => before.of(Atom::DirectionNeutral) == Truth::False,
            _ => pending.before.of(edge) == Truth::True,
        };
        let Some(input) = edge.input().filter(|&input| counts && after.of(input) == Truth::True) else {
            return;
        };
        let known = before.meet(after).forget(filled).set(input, Truth::True).set(edge, Truth::True);
        self.guard_held(t, state, known);
    }

    /// The atoms that decide which way a state is left.
    pub(super) fn deciding(&self, state: AsState) -> Atoms {
        self.variants.terms(state).iter().fold(Atoms::NONE, |all, term| all.union(term.on).union(term.off))
    }
}
