//! What only an unseen frame could excuse: a transition that every recorded frame says was due.
//!
//! A violation is what is one whatever the unknown is, and a frame that may be missing makes a condition unknown. But where all that
//! was shown says that a guard held, and the VCU stayed, only such a frame can have told it otherwise. That is a warning, and it
//! names the time of which nothing was recorded.

use adsdv_spec::{AsState, Atom, Atoms, Knowledge, Truth};

use super::Judge;
use super::events::milliseconds;
use super::finding::Severity;
use super::slots::Slot;
use super::transitions::{MEMORY, Wrong, unjustified};
use super::variants::Way;
use crate::why::EDGES;

/// A way out that is open as far as was shown.
#[derive(Clone, Copy, Debug)]
struct LikelyDue {
    since: i64,
    way: Way,
    /// Whether it is "Go" that was accepted, which is there for one step only.
    by_go: bool,
}

/// What is kept of a state that lasts.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Likely {
    due: Option<LikelyDue>,
    /// Whether it was reported of this state that it was not left, for certain or likely.
    reported: bool,
}

impl Likely {
    /// It was reported, for certain, that the state was not left.
    pub(super) fn is_certain(&mut self) {
        self.reported = true;
    }
}

impl Judge {
    /// What was shown last has changed: is a transition due by that?
    pub(super) fn reconsider_shown(&mut self, t: i64) {
        let shown = self.why.shown();
        let Some(state) = self.vcu.state else {
            self.likely = Likely::default();
            return;
        };
        let now = self.variants.due(state, shown);
        self.likely.due = self.likely.due.filter(|due| match now {
            _ if due.by_go => self.go_still_counts(t, due, shown),
            Some(way) => due.way.to == way.to,
            None => false,
        });
        if let (Some(way), None) = (now, self.likely.due) {
            self.likely.due = Some(LikelyDue { since: t, way, by_go: false });
        }
    }

    /// Whether "Go" was accepted as far as is shown. What comes within a window may have been there before it.
    fn go_still_counts(&self, t: i64, due: &LikelyDue, shown: Knowledge) -> bool {
        t > due.since + self.window || due.way.term.truth(with_go(shown)) != Truth::False
    }

    /// The remote control shows "Go" switched on, after it was off for a while: is a transition due by that?
    pub(super) fn go_shown_on(&mut self, t: i64) {
        let Some(state) = self.vcu.state.filter(|_| self.likely.due.is_none()) else { return };
        let Some(way) = self.variants.due(state, with_go(self.why.shown())) else { return };
        if way.term.on.has(Atom::GoEdge) {
            self.likely.due = Some(LikelyDue { since: t, way, by_go: true });
        }
    }

    /// Whether a transition that was seen, and may be justified, could be so by an unseen frame only: then what is to be said of
    /// it, and what would excuse it. `before` is what was shown when it was seen, and `lasted` for how long the state had lasted.
    pub(super) fn likely_unjustified(
        &self,
        t: i64,
        (from, to): (AsState, AsState),
        before: Knowledge,
        lasted: i64,
    ) -> Option<(Wrong, String)> {
        // Before a state that has only just been seen there may have been anything.
        if self.options.complete || lasted < 3 * self.window {
            return None;
        }
        // Memory is that of the state before; what else counts is what was shown before it and is shown behind it. A change may be
        // recorded late.
        let both = before.meet(self.why.shown()).forget(MEMORY);
        let remembered = MEMORY.difference(EDGES).intersection(before.on().union(before.off()));
        let shown = both.learn(remembered, before.on());
        let guards = || self.variants.of(from).iter().flatten().filter(|guard| guard.to == to);
        if guards().any(|guard| guard.truth(shown) != Truth::False) {
            return None;
        }
        let guard = guards().next()?;
        let wrong = unjustified(&self.edition.rules, (from, to), guard, shown, None);
        let excuse = self.excuse(guard.atoms(), t - self.window, self.now);
        Some((Wrong { seen: format!("by all that was recorded {}", wrong.seen), ..wrong }, excuse))
    }

    /// What could excuse the VCU: the frames of these conditions that may have been lost between these times.
    fn excuse(&self, atoms: Atoms, start: i64, end: i64) -> String {
        let gap = |(index, slot): (usize, &Slot)| {
            let (since, until) = slot.longest_gap(end).filter(|(_, until)| *until >= start)?;
            Some(no_frame(self.id_of(index)?, since, until))
        };
        let gaps: Vec<String> = self.deciding_slots(atoms).filter_map(gap).collect();
        if gaps.is_empty() {
            "frames were lost that nobody misses".to_owned()
        } else {
            format!("a frame was lost ({})", gaps.join(", "))
        }
    }

    /// 520h still shows the old state: should it have been left, by all that was recorded?
    pub(super) fn likely_due_at_status(&mut self, t: i64) {
        let Some(due) = self.likely.due else { return };
        let atoms = due.way.term.on.union(due.way.term.off);
        // A frame that comes late is no gap: as long again as a transition that is certain may take, and what comes rarely tells first.
        let patience = 2 * (self.deadline + self.window).max(5 * self.cycle()) + self.wait_for(atoms);
        let Some(state) = self.vcu.state.filter(|_| !self.likely.reported && t > due.since + patience) else {
            return;
        };
        if !self.is_confirmed(&due.way.term, due.since) {
            return;
        }
        let excuse = self.excuse(atoms, due.since - self.window, t);
        self.likely.reported = true;
        let so_long = format!(" for {:.0} ms by all that was recorded", milliseconds(t - due.since));
        let finding = self.not_left(Severity::Warning, state, &due.way, due.since, &so_long);
        self.found(finding.unless(excuse).shown_by(self.deciding_frames(&self.frames(), atoms)));
    }
}

/// The time of which no frame of a message was recorded.
pub(super) fn no_frame(id: u16, since: i64, until: i64) -> String {
    let seconds = |ns| milliseconds(ns) / 1e3;
    format!("{id:03X}h: no frame from {:.3} to {:.3} s", seconds(since), seconds(until))
}

/// What is known when "Go" is accepted.
fn with_go(shown: Knowledge) -> Knowledge {
    shown.set(Atom::GoEdge, Truth::True).set(Atom::GoOn, Truth::True)
}
