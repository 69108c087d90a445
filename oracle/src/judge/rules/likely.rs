//! What only an unseen frame could excuse: a transition that every recorded frame says was due, or says had no reason.
//!
//! A violation is what is one whatever the unknown is, and a frame that may be missing makes a condition unknown. But where all that
//! was shown says that a guard held, and the VCU stayed, only such a frame can have shown it otherwise. That is a warning, and it
//! names the time of which nothing was recorded.

use adsdv_spec::{AsState, Atom, Atoms, Knowledge, Term, Truth};

use super::texts::{Mismatch, not_left, unjustified};
use crate::judge::estimator::base::Estimator;
use crate::judge::estimator::readings::{WayOut, guard, of_terms};
use crate::judge::estimator::status::MEMORY;
use crate::judge::finding::{Finding, Severity};
use crate::judge::sampler::slot::Slot;
use crate::judge::time::milliseconds;
use crate::why::EDGES;

/// A way out that is open as far as was shown.
#[derive(Clone, Copy, Debug)]
struct LikelyDue {
    since: i64,
    way: WayOut,
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

/// What was shown last has changed: is a transition due by that?
pub(super) fn reconsider_shown(likely: &mut Likely, est: &Estimator, t: i64) {
    let shown = est.why.shown();
    let Some(state) = est.vcu.state else {
        *likely = Likely::default();
        return;
    };
    let now = est.readings.due(state, shown);
    likely.due = likely.due.filter(|due| match now {
        // What comes within a window of "Go" may have been there before it.
        _ if due.by_go => t > due.since + est.window || due.way.term.truth(with_go(shown)) != Truth::False,
        Some(way) => due.way.to == way.to,
        None => false,
    });
    if let (Some(way), None) = (now, likely.due) {
        likely.due = Some(LikelyDue { since: t, way, by_go: false });
    }
}

/// The remote control shows "Go" switched on, after it was off for a while: is a transition due by that?
pub(super) fn go_shown_on(likely: &mut Likely, est: &Estimator, t: i64) {
    let Some(state) = est.vcu.state.filter(|_| likely.due.is_none()) else { return };
    let way = est.readings.due(state, with_go(est.why.shown()));
    let by_go = way.filter(|way| way.term.on.has(Atom::GoEdge));
    likely.due = by_go.map(|way| LikelyDue { since: t, way, by_go: true });
}

/// Whether a transition that was seen, and may be justified, could be so by an unseen frame only: then what is to be said of
/// it, and what would excuse it. `before` is what was shown when it was seen, and `go_never_low_since` since when `GO_SIGNAL` was never 0
/// in the old state.
pub(super) fn likely_unjustified(
    est: &Estimator,
    t: i64,
    (from, to): (AsState, AsState),
    before: Knowledge,
    go_never_low_since: Option<i64>,
) -> Option<(Mismatch, String)> {
    // Before what has only just been seen there may have been anything.
    if est.options.complete || !est.is_seen_since(t - 3 * est.window) {
        return None;
    }
    // Memory is that of the state before; what else counts is what was shown before it and is shown behind it. A change may be
    // recorded late.
    let both = est.shown_throughout(t - est.window, t + est.window, before).forget(MEMORY);
    let remembered = MEMORY.difference(EDGES).intersection(before.on().union(before.off()));
    let shown = both.learn(remembered, before.on());
    let no_edge = go_never_low_since.is_some_and(|since| t - since > est.long_patience());
    let shown = if no_edge { shown.set(Atom::GoEdge, Truth::False) } else { shown };
    if est.readings.terms(from, to).any(|term| term.truth(shown) != Truth::False) {
        return None;
    }
    let guard = est.readings.of(from).iter().map(|machine| guard(machine, from, to));
    let guard: Vec<Term> = { guard }.find(|guard| !guard.is_empty())?.iter().map(|way| way.term).collect();
    let wrong = unjustified(&est.edition.rules, (from, to), &guard, shown, None);
    let excuse = excuse(est, of_terms(guard.iter()), t - est.window, est.now);
    Some((Mismatch { seen: format!("by all that was recorded {}", wrong.seen), ..wrong }, excuse))
}

/// What could excuse the VCU: the frames of these conditions that may have been lost between these times.
pub(super) fn excuse(est: &Estimator, atoms: Atoms, start: i64, end: i64) -> String {
    let gap = |(index, slot): (usize, &Slot)| {
        let (since, until) = slot.longest_gap(end).filter(|(_, until)| *until >= start)?;
        Some(no_frame(est.sampler.id(index)?, since, until))
    };
    let gaps: Vec<String> = est.sampler.deciding_slots(atoms).filter_map(gap).collect();
    if gaps.is_empty() {
        "frames were lost that nobody misses".to_owned()
    } else {
        format!("a frame was lost ({})", gaps.join(", "))
    }
}

/// 520h shows this state still, or has just left it: should that have been left before, by all that was recorded?
pub(super) fn likely_due(likely: &mut Likely, est: &Estimator, t: i64, state: AsState) -> Option<Finding> {
    let due = likely.due.filter(|_| !likely.reported)?;
    let atoms = due.way.term.on.union(due.way.term.off);
    // No frame that is late hides what lasts. "Go" is there for one step, and what else was so in that one may show late.
    let patience = if due.by_go { est.long_patience() + est.window } else { est.patience() + est.cycle() };
    // What comes rarely tells first.
    let patience = patience + est.sampler.wait_for_slow(atoms);
    if t <= due.since + patience || !est.is_confirmed(atoms, due.since) {
        return None;
    }
    let excuse = excuse(est, atoms, due.since - est.window, t);
    likely.reported = true;
    let so_long = format!(" for {:.0} ms by all that was recorded", milliseconds(t - due.since));
    let finding = not_left(est, Severity::Warning, state, &due.way, due.since, &so_long);
    Some(finding.unless(excuse).shown_by(est.sampler.deciding_frames(&est.sampler.frames(), atoms)))
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
