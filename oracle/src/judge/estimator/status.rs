//! What 520h tells of the VCU: its state, what it must remember in it, and what it shows of the conditions.

use adsdv_spec::messages::{ShutdownCause, Vcu2AiStatus};
use adsdv_spec::{AsState, Atom, Atoms, Choice, Faults, Knowledge, Observation, Reading, Truth};

use super::base::{Estimator, Left, ObservedVcu, is_active};
use super::watch::Suspect;
use crate::judge::sampler::Came;
use crate::judge::sampler::content::FrameContent;
use crate::judge::sampler::places::{AI_STATUS, STATUS};
use crate::judge::time::{MS, SILENCE_NS};

/// The changes that only count in `AS_DRIVING`.
const IN_DRIVING: [Atom; 2] = [Atom::MissionFinishedEdge, Atom::DirectionNeutralEdge];

/// A 520h that came with something new.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StatusChange {
    pub(crate) status: Vcu2AiStatus,
    /// The one before, unless a silence lies between; and whether a frame may be missing in between.
    pub(crate) previous: Option<Vcu2AiStatus>,
    pub(crate) gap: bool,
    /// For how long the VCU was silent, if that was long.
    pub(crate) silence: Option<i64>,
    /// Whether the edge before was answered, and the new one if it seems not to have been.
    pub(crate) answered: bool,
    pub(crate) suspect: Option<Suspect>,
    /// Where the handshake began with 1, whether the AI Computer can answer that with a rising edge, as far as that is clear.
    pub(crate) begins: Option<bool>,
    /// What was known before.
    pub(crate) before: PriorKnowledge,
    /// The state before, and the one now if that is another or known anew.
    pub(crate) old: Option<AsState>,
    pub(crate) entered: Option<AsState>,
    pub(crate) change: Option<SeenChange>,
}

/// What was known before a 520h came: for certain, and by all that was recorded.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PriorKnowledge {
    pub(crate) known: Knowledge,
    pub(crate) shown: Knowledge,
    /// When the last 520h came, if one may be missing since.
    pub(crate) missing_since: Option<i64>,
}

/// A change of state that was seen.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SeenChange {
    pub(crate) from: AsState,
    pub(crate) to: AsState,
    /// When the VCU last showed the old state.
    pub(crate) before: i64,
    /// Whether a frame of the VCU may be missing in between.
    pub(crate) gap: bool,
    /// What was known in the step that led there, and what was shown last when it was seen.
    pub(crate) at_step: Knowledge,
    pub(crate) shown: Knowledge,
    /// Since when `GO_SIGNAL` was 1 in all frames of the old state, from the first on: there is no edge without a 0.
    pub(crate) go_never_low_since: Option<i64>,
}

impl Estimator {
    /// 520h came with something new.
    pub(crate) fn shows(
        &mut self,
        came: &Came,
        content: &FrameContent,
        mut status: Vcu2AiStatus,
    ) -> StatusChange {
        let t = came.t;
        if content.is_bad("shutdown_cause") {
            // A cause that cannot be read says nothing about the one before.
            status.shutdown_cause = self.vcu.status.map_or(status.shutdown_cause, |s| s.shutdown_cause);
        }
        let readable = self.sampler.scope(STATUS);
        let readable =
            if content.is_bad("ami_state") { readable.without(Atom::AmiSelected) } else { readable };
        let silence = came.before.map(|before| t - before).filter(|&silence| silence >= SILENCE_NS);
        if silence.is_some() {
            self.vcu_was_silent(t);
        }
        let gap = self.vcu.gap_since.take().is_some();
        let previous = self.vcu.status.replace(status);
        let (old, answered) = (self.vcu.state, self.handshake.is_answered());
        let new = Some(status.as_state).filter(|_| !content.is_bad("as_state"));
        if previous.is_some_and(|previous| previous.ts_switch_status != status.ts_switch_status) {
            self.handshake.begins_anew();
        }
        let suspect = self.handshake.vcu(t, status.handshake).filter(|_| status.ts_switch_status);
        let idle = previous.is_some_and(|previous| !previous.ts_switch_status && !previous.handshake);
        let rises = idle && status.ts_switch_status && status.handshake;
        let begins = if rises { self.handshake.rises_at_once(t, self.cycle()) } else { None };
        let missing_since = came.before.filter(|_| gap);
        let before = self.before(t, came.before.zip(previous), missing_since);
        self.learn_status(t, status, readable, previous, new, gap);
        let last = came.before.unwrap_or(t);
        let mut shown = StatusChange {
            status,
            previous,
            gap,
            silence,
            answered,
            suspect,
            begins,
            before,
            old,
            entered: None,
            change: None,
        };
        match (old, new) {
            (Some(from), Some(to)) if from != to => {
                shown.change = Some(self.changes(t, from, to, last, gap));
                self.enter(t, to, Some(last));
            }
            (None, Some(to)) => self.enter(t, to, None),
            (_, None) => {
                (self.vcu.state, self.changed) = (None, true);
                self.explain(t);
            }
            _ => {}
        }
        shown.entered = new.filter(|_| new != old);
        let high = status.go_signal && new == Some(AsState::Ready);
        let since = if old == new { self.vcu.go_never_low_since } else { old.map(|_| t) };
        self.vcu.go_never_low_since = since.filter(|_| high);
        let pressed = status.go_signal && previous.is_some_and(|previous| !previous.go_signal);
        if pressed && !gap && self.remote.shown.is_none() {
            self.why.go_pressed(t);
            self.go_rises(t, old, new);
        }
        self.update_comms(t);
        shown
    }

    /// What was known before this frame; `previous` is the one before it, and when it came.
    fn before(
        &self,
        t: i64,
        previous: Option<(i64, Vcu2AiStatus)>,
        missing_since: Option<i64>,
    ) -> PriorKnowledge {
        let answered = self.seems_answered(t, previous);
        let comes = answered && self.silences.seem_present(t);
        let lost = if comes { Truth::False } else { Truth::Unknown };
        PriorKnowledge {
            known: self.known,
            shown: self.why.shown().set(Atom::AiCommsLost, lost),
            missing_since,
        }
    }

    /// Whether by all that was recorded the AI Computer answers the handshake in time; `previous` is the last 520h, and when it came.
    pub(crate) fn seems_answered(&self, t: i64, previous: Option<(i64, Vcu2AiStatus)>) -> bool {
        let limit = self.handshake_limit();
        // What has been unanswered for the limit was there for as long: no frame a moment ago agrees with the answers, or shows the
        // switch off without which there is no handshake.
        let soon = |at: i64| t - at < limit - self.window;
        let previous = previous.filter(|(at, _)| soon(*at)).map(|(_, status)| status);
        let with_tsms = self.pinned(Reading::HandshakeActive).is_some_and(|it| it != Choice::HandshakeAlways);
        let idle = with_tsms && previous.is_some_and(|status| !status.ts_switch_status);
        let heard = self.sampler.last(AI_STATUS).is_some_and(soon);
        let agreed = previous
            .filter(|_| heard)
            .is_some_and(|status| self.handshake.seems_agreed(t, status.handshake, self.window));
        idle || agreed || self.handshake.seems_answered(t, limit, self.window)
    }

    /// The VCU was silent: what it is, and what it remembers, is unknown.
    fn vcu_was_silent(&mut self, t: i64) {
        self.vcu = ObservedVcu::default();
        self.timers.clear();
        self.handshake.vcu_gone();
        self.handshake.begins_anew();
        self.learn(t, self.known.forget(Atoms::ALL.difference(Observation::SCOPE)));
    }

    fn changes(&mut self, t: i64, from: AsState, to: AsState, before: i64, gap: bool) -> SeenChange {
        let usual = self.sampler.slot(STATUS).map_or(0, |slot| slot.period);
        let gap = gap || !self.options.complete && t - before > usual + usual / 5;
        self.vcu.left = Some(Left { before, at: t, gap });
        let go_never_low_since = self.vcu.go_never_low_since.filter(|_| self.remote.shown.is_none());
        SeenChange { from, to, before, gap, at_step: self.known, shown: self.why.shown(), go_never_low_since }
    }

    /// Learns what 520h shows of the conditions.
    fn learn_status(
        &mut self,
        t: i64,
        status: Vcu2AiStatus,
        readable: Atoms,
        previous: Option<Vcu2AiStatus>,
        new: Option<AsState>,
        gap: bool,
    ) {
        let raw = self.pinned(Reading::GoSignal) == Some(Choice::GoRaw);
        let go_on = match (status.go_signal, raw || new == Some(AsState::Driving)) {
            (true, _) => Truth::True,
            (false, true) => Truth::False,
            // In other states GO_SIGNAL may be the accepted edge, which says nothing about the switch.
            (false, false) => Truth::Unknown,
        };
        let (shown, shown_before) =
            (Faults::shown_by(&status), previous.as_ref().map_or(Faults::ALL, Faults::shown_by));
        let opening = self.vcu.opening.union(shown.difference(shown_before)).intersection(Faults::OPENING);
        let active = is_active(self.vcu.state);
        self.vcu.opening = if active { opening.intersection(shown) } else { Faults::NONE };
        self.vcu.braked |=
            status.shutdown_cause != ShutdownCause::NoShutdown || new == Some(AsState::EmergencyBrake);
        let power_cycle = match (self.vcu.braked, self.pinned(Reading::PowerCycle)) {
            (false, _) | (true, Some(Choice::PowerCycleNotLatched)) => Truth::False,
            (true, Some(_)) => Truth::True,
            (true, None) => Truth::Unknown,
        };
        let known = self
            .known
            .learn(readable.intersection(Vcu2AiStatus::SCOPE), status.atoms())
            .set(Atom::SdcOpen, self.sdc_open())
            .set(Atom::BmsFault, self.battery())
            .set(Atom::PowerCycleNeeded, power_cycle);
        if self.remote.shown.is_some() {
            // It shows the switch itself.
            return self.learn(t, known);
        }
        let known = known.set(Atom::GoOn, go_on);
        let go_before = previous.filter(|_| !gap).map(|p| p.go_signal);
        let edge = self.go_edge(t, known, go_before, status.go_signal, raw, new);
        if go_before == Some(false) && status.go_signal {
            self.change_seen(t, Atom::GoEdge, edge);
        }
        self.learn(t, known.set(Atom::GoEdge, edge));
    }

    /// `GO_SIGNAL` rises between two frames, none of which is missing.
    ///
    /// Where it is the switch, that went on then. Where it is the accepted edge, it shows in a step from AS_READY that the VCU has
    /// accepted one: the switch was off in the step before.
    //= DRV-14, D-7
    fn go_rises(&mut self, t: i64, old: Option<AsState>, new: Option<AsState>) {
        if old == Some(AsState::Ready) && matches!(new, Some(AsState::Ready | AsState::Driving)) {
            self.go_rose_at = Some(t);
        }
    }

    /// Whether nothing shows "Go" while AS_DRIVING does not last: no remote control came, and `GO_SIGNAL` need not be the switch.
    pub(crate) fn go_is_hidden(&self) -> bool {
        let remote = self.sampler.last(crate::judge::sampler::places::REMOTE).is_some();
        !remote && self.pinned(Reading::GoSignal) != Some(Choice::GoRaw)
    }

    /// Whether a "Go" edge was accepted, as far as `GO_SIGNAL` tells (section 3.2, item 3).
    ///
    /// Whether `GO_SIGNAL` is the accepted edge or the switch: when it rises in AS_READY the other conditions must
    /// hold already, and when it is 1 without having risen there was no edge.
    fn go_edge(
        &self,
        t: i64,
        known: Knowledge,
        before: Option<bool>,
        go: bool,
        raw: bool,
        new: Option<AsState>,
    ) -> Truth {
        let was_ready = self.vcu.state == Some(AsState::Ready);
        match (before, go) {
            (_, false) if raw => Truth::False,
            (_, false) | (None, true) => Truth::Unknown,
            (Some(false), true) if was_ready => self.go_conditions(t, known),
            (Some(_), true) if new == Some(AsState::Ready) && !was_ready && self.vcu.state.is_some() => {
                Truth::False
            }
            (Some(_), true) => self.known.of(Atom::GoEdge),
        }
    }

    /// Whether the conditions of section 3.2, items 1 and 2, held throughout the window before.
    pub(super) fn go_conditions(&self, t: i64, known: Knowledge) -> Truth {
        let window = self.history.throughout(t - self.window, t).meet(known).set(Atom::GoEdge, Truth::True);
        let terms = self.readings.terms(AsState::Ready, AsState::Driving);
        { terms }.map(|term| term.truth(window)).reduce(Truth::agree).unwrap_or(Truth::Unknown)
    }

    /// The bus shows a change from now on; `truth` is whether it counts. The VCU sees it within a window, and never again.
    pub(super) fn change_seen(&mut self, t: i64, edge: Atom, truth: Truth) {
        if self.vcu.state.is_some() && truth != Truth::False {
            self.change_passes(t, edge);
            self.edges.push((edge, truth));
        }
    }

    /// If there was a change by `t`, the VCU has seen it after a window.
    fn change_passes(&mut self, t: i64, edge: Atom) {
        // Where `GO_SIGNAL` is the accepted edge, what it shows is not over with the step.
        let becomes = if edge == Atom::GoEdge { Truth::Unknown } else { Truth::False };
        self.timers.retain(|timer| timer.atom != edge);
        self.becomes(t + self.window, edge, becomes);
    }

    /// The VCU shows a state that it did not show before. `before` is when it showed another one; `None` if the
    /// state may be old.
    fn enter(&mut self, t: i64, state: AsState, before: Option<i64>) {
        self.vcu.state = Some(state);
        self.timers.clear();
        let limit = i64::from(self.edition.rules.timing.in_state_limit(state)) * MS;
        for (timed, atom) in
            AsState::ALL.into_iter().filter_map(|state| Some((state, Atom::of_timer(state)?)))
        {
            let entered = state == timed;
            // The timer began between the two frames, give or take the window.
            let old = entered && before.is_none();
            self.known = self.known.set(atom, if old { Truth::Unknown } else { Truth::False });
            if let Some(before) = before.filter(|_| entered) {
                self.becomes(before + limit - self.window, atom, Truth::Unknown);
            }
            if entered {
                self.becomes(t + limit, atom, Truth::True);
            }
        }
        self.remote.lasts_since = None;
        if state != AsState::Ready && self.remote.shown.is_none() {
            self.known = self.known.set(Atom::GoEdge, Truth::Unknown);
        }
        for edge in IN_DRIVING {
            let old = if before.is_some() { Truth::False } else { Truth::Unknown };
            self.known = self.known.set(edge, old);
            self.change_passes(t, edge);
        }
        self.takes_down(t);
    }

    /// What the VCU's memory decides as it was in the step that led to a change of state, and what it saw in the window of that
    /// step: what is known throughout.
    pub(crate) fn at_step(&self, t: i64, start: i64, at_step: Knowledge) -> Knowledge {
        let inputs = self.throughout(start, t + self.window);
        let memory = self.history.throughout(start, t - 1).meet(at_step);
        // Where the remote control shows the switch, an edge shows when it comes, and may be recorded late.
        let remote = self.sampler.last(crate::judge::sampler::places::REMOTE).is_some();
        let remembered = if remote { MEMORY.without(Atom::GoEdge) } else { MEMORY };
        let known = remembered.intersection(memory.on().union(memory.off()));
        inputs.forget(remembered).learn(known, memory.on())
    }

    /// The window behind a change has passed: what is known of the step that saw it, whichever that was, if the change counts.
    ///
    /// The bus does not show which step it was, so such a condition is true, or possible, for a window only. But where all the rest
    /// of a guard was so on either side of the change for a window, any step saw it hold.
    pub(crate) fn step_of_change(&self, t: i64, edge: Atom, truth: Truth) -> Option<(AsState, Knowledge)> {
        let (start, end) = (t - self.window, t + self.window);
        let state = self.vcu.state?;
        if self.moments(start, self.now).any(|moment| moment.state != Some(state)) {
            return None;
        }
        // The frame that is missing may be the one of the step that saw the change.
        let filled = self.moments(start, end).fold(Atoms::NONE, |all, moment| all.union(moment.filled));
        let (before, after) = (self.throughout(start, t - 1), self.throughout(t, end));
        let counts = match edge {
            Atom::MissionFinishedEdge => before.of(Atom::MissionRunning) == Truth::True,
            Atom::DirectionNeutralEdge => before.of(Atom::DirectionNeutral) == Truth::False,
            _ => truth == Truth::True,
        };
        let input = edge.input().filter(|&input| counts && after.of(input) == Truth::True)?;
        let known = before.meet(after).forget(filled).set(input, Truth::True).set(edge, Truth::True);
        Some((state, known))
    }
}

/// The atoms that the VCU's memory decides, or that it shows itself in the frame that shows the state: they count up to
/// the step that is judged, not behind it.
pub(crate) const MEMORY: Atoms = Atoms::ALL.difference(Observation::SCOPE).with(Atom::SdcOpen);
