//! What is known, now and in the recent past.

use adsdv_spec::messages::{Ai2VcuStatus, Node, Vcu2AiStatus};
use adsdv_spec::{AsState, Atom, Atoms, Choice, Edition, Faults, Knowledge, Reading, Truth};

use super::history::{History, Moment};
use super::readings::Readings;
use super::remote::RemoteSide;
use super::silences::Silences;
use super::watch::Watch;
use crate::judge::options::JudgeOptions;
use crate::judge::sampler::Sampler;
use crate::judge::sampler::places::STATUS;
use crate::judge::time::MS;
use crate::why::StayRecorder;

/// What is known of both sides, and the samples that tell it: what every rule sees.
#[derive(Debug)]
pub(crate) struct Estimator {
    pub(crate) options: JudgeOptions,
    pub(crate) edition: Edition,
    pub(crate) readings: Readings,
    pub(crate) window: i64,
    pub(crate) deadline: i64,
    pub(crate) sampler: Sampler,
    pub(crate) now: i64,
    pub(crate) known: Knowledge,
    /// Whether that, or the state, has changed since the rules looked at it last.
    pub(crate) changed: bool,
    pub(crate) history: History,
    pub(crate) vcu: ObservedVcu,
    /// When conditions change because time passes.
    pub(super) timers: Vec<Timer>,
    pub(crate) handshake: Watch,
    pub(crate) silences: Silences,
    /// When an unanswered edge, or a message that is silent, may change what is known.
    pub(crate) comms_at: i64,
    /// The AI Computer's last status.
    pub(crate) ai: Option<Ai2VcuStatus>,
    pub(crate) remote: RemoteSide,
    /// When `GO_SIGNAL` last rose in such a way that "Go" went on by either answer to what that signal is.
    pub(crate) go_rose_at: Option<i64>,
    /// Changes that count, which the rules have not looked at: the condition, and whether it does count.
    pub(crate) edges: Vec<(Atom, Truth)>,
    pub(crate) why: StayRecorder,
}

/// The VCU as the bus shows it.
#[derive(Debug, Default)]
pub(crate) struct ObservedVcu {
    /// The last AS state; `None` if it is not known.
    pub(crate) state: Option<AsState>,
    /// The last 520h.
    pub(crate) status: Option<Vcu2AiStatus>,
    /// Since when 520h is missing.
    pub(super) gap_since: Option<i64>,
    /// Whether `EMERGENCY_BRAKE`, or the cause of one, was seen.
    pub(super) braked: bool,
    /// The faults that open the shutdown circuit and were first shown while the Autonomous System was active.
    pub(super) opening: Faults,
    /// The last change of state.
    pub(super) left: Option<Left>,
    /// Since when `GO_SIGNAL` has been 1 in `AS_READY`, if it was from the first frame of it on.
    pub(super) go_never_low_since: Option<i64>,
}

/// A change of state: when the old one was last seen, when the new one first was, and whether a frame may be missing in
/// between.
#[derive(Clone, Copy, Debug)]
pub(super) struct Left {
    pub(super) before: i64,
    pub(super) at: i64,
    pub(super) gap: bool,
}

/// A condition that changes when time passes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Timer {
    pub(super) at: i64,
    pub(super) atom: Atom,
    pub(super) becomes: Truth,
}

/// Whether a state is one in which the Autonomous System is active.
pub(crate) const fn is_active(state: Option<AsState>) -> bool {
    matches!(state, Some(AsState::Ready | AsState::Driving | AsState::Finished))
}

/// What shows is certain; what does not may be so all the same.
const fn certain(shows: bool) -> Truth {
    if shows { Truth::True } else { Truth::Unknown }
}

impl Estimator {
    /// One that has seen nothing.
    pub(crate) fn new(options: JudgeOptions) -> Self {
        let edition = *options.edition;
        let options = JudgeOptions { readings: edition.choices.intersection(options.readings), ..options };
        let window = i64::from(options.window_ms) * MS;
        let pinned = |choice: Choice| pinned(&options, choice.reading()) == Some(choice);
        let always =
            pinned(Choice::WatchAlways) || pinned(Choice::WatchHandshake) && pinned(Choice::HandshakeAlways);
        let missed = edition.rules.thresholds.missed_ms.map(|ms| i64::from(ms) * MS);
        Self {
            options,
            edition,
            readings: Readings::new(&edition, options.readings),
            window,
            deadline: i64::from(options.deadline_ms) * MS,
            sampler: Sampler::new(&edition, options.complete, window),
            now: 0,
            known: Knowledge::NOTHING,
            changed: false,
            history: History::new(),
            vcu: ObservedVcu::default(),
            timers: Vec::new(),
            handshake: Watch::default(),
            silences: Silences::new(missed, window, always),
            comms_at: i64::MAX,
            ai: None,
            remote: RemoteSide::default(),
            go_rose_at: None,
            edges: Vec::new(),
            why: StayRecorder::new(options.edition, options.readings),
        }
    }

    /// Nothing is known any more.
    pub(crate) fn forget(&mut self) {
        self.known = Knowledge::NOTHING;
        self.history.clear();
        self.why.forget(self.now);
        self.vcu = ObservedVcu::default();
        self.timers.clear();
        (self.handshake, self.comms_at) = (Watch::default(), i64::MAX);
        self.silences.forget();
        (self.remote, self.go_rose_at) = (RemoteSide::default(), None);
        self.sampler.forget();
    }

    /// From `t` on, what is known is `known`.
    pub(super) fn learn(&mut self, t: i64, known: Knowledge) {
        if known != self.known {
            self.known = known;
            self.takes_down(t);
        }
    }

    /// The state, or what is known, is another: what blocks the arrows may be, too.
    pub(super) fn takes_down(&mut self, t: i64) {
        self.changed = true;
        self.history.push(t, self.known, self.vcu.state);
        self.explain(t);
    }

    pub(super) fn explain(&mut self, t: i64) {
        let sampler = &self.sampler;
        let stale = sampler.slots.iter().enumerate().filter(|(_, slot)| !slot.fresh);
        let stale = stale.fold(Atoms::NONE, |all, (index, _)| all.union(sampler.scope(index)));
        let last = |id: u16| {
            let slot = sampler.slot(sampler.index(id.into())?).filter(|slot| slot.last.is_some())?;
            Some(slot.word.to_le_bytes())
        };
        self.why.sees(t, self.vcu.state, (self.known, stale), &last);
    }

    /// At `t` a condition becomes something else, if nothing does before.
    pub(super) fn becomes(&mut self, at: i64, atom: Atom, becomes: Truth) {
        self.timers.push(Timer { at, atom, becomes });
    }

    /// No frame came for a while: the recorder paused, or its clock was set. What has lasted long enough by its clock
    /// may not have by the VCU's.
    pub(crate) fn postpone(&mut self, by: i64) {
        for timer in self.timers.iter_mut().filter(|timer| timer.becomes == Truth::True) {
            timer.at += by;
        }
    }

    /// Takes the first condition that has become something else by `t`. Tells whether there was one.
    pub(crate) fn time_comes(&mut self, t: i64) -> bool {
        let Some(index) = self.timers.iter().position(|timer| timer.at <= t) else { return false };
        let timer = self.timers.swap_remove(index);
        self.learn(t, self.known.set(timer.atom, timer.becomes));
        true
    }

    /// When something becomes known, or unknown, though no frame comes.
    pub(crate) fn next(&self) -> i64 {
        let timers = self.timers.iter().map(|timer| timer.at).min().unwrap_or(i64::MAX);
        timers.min(self.comms_at).min(self.remote.go_settles.unwrap_or(i64::MAX))
    }

    /// What is known of all of the time from `start` to `end`, as far as the judge has seen by now.
    ///
    /// What the log ends too early to tell is unknown. Messages that come rarely are looked at for longer: they
    /// show late what was so before.
    pub(crate) fn throughout(&self, start: i64, end: i64) -> Knowledge {
        let seen =
            |end| if self.now < end { Knowledge::NOTHING } else { self.history.throughout(start, end) };
        let mut known = seen(end);
        for (slot, scope) in self.sampler.slow(Atoms::ALL) {
            let both = known.meet(seen(end + slot.usual() * 2));
            let certain = scope.intersection(both.on().union(both.off()));
            known = known.forget(scope).learn(certain, both.on());
        }
        known
    }

    /// What all that was recorded says of the time from `start` to `end`: what was shown `before`, is shown now, and nothing in between
    /// contradicts.
    pub(crate) fn shown_throughout(&self, start: i64, end: i64, before: Knowledge) -> Knowledge {
        let both = before.meet(self.why.shown());
        self.moments(start, end).fold(both, |both, Moment { known, .. }| {
            both.forget(both.on().intersection(known.off()).union(both.off().intersection(known.on())))
        })
    }

    /// Whether anything has been known since `t`.
    pub(crate) fn is_seen_since(&self, t: i64) -> bool {
        self.moments(t, t).next().is_some_and(|moment| moment.t <= t)
    }

    /// The moments from `start` on, up to `end`, with what was known at each.
    pub(crate) fn moments(&self, start: i64, end: i64) -> impl Iterator<Item = &Moment> {
        self.history.between(start, end)
    }

    /// Whether 520h is coming.
    pub(crate) fn vcu_is_seen(&self) -> bool {
        self.sampler.is_fresh(STATUS)
    }

    /// The state that the VCU shows, while its frames are fresh.
    pub(crate) fn state_seen(&self) -> Option<AsState> {
        self.vcu.state.filter(|_| self.vcu_is_seen())
    }

    /// Whether the VCU has shown these conditions again, a window after `since`: what it measures is only certain up to the last frame
    /// that shows it.
    pub(crate) fn is_confirmed(&self, atoms: Atoms, since: i64) -> bool {
        self.sampler.slots.iter().enumerate().all(|(index, slot)| {
            !slot.is_from(Node::Vcu)
                || self.sampler.scope(index).intersection(atoms).is_empty()
                || slot.last.is_some_and(|last| last >= since + self.window)
        })
    }

    /// Whether the VCU says that communication with the AI Computer is lost.
    pub(crate) fn shows_comms_lost(&self) -> bool {
        self.vcu.status.is_some_and(|status| status.ai_comms_lost)
    }

    /// Whether the VCU may have left its state before `t` in a frame that is missing from the log.
    pub(crate) fn left_unseen(&self, t: i64) -> bool {
        self.vcu.left.is_some_and(|left| left.gap && left.before <= t && t <= left.at)
    }

    /// Whether a fault of the battery may act by itself, so that it does not tell that the circuit is open.
    pub(super) fn battery(&self) -> Truth {
        certain(
            self.options.readings.has(Choice::BmsDriving)
                && self.vcu.opening.has(adsdv_spec::Fault::BmsFault),
        )
    }

    /// Whether the shutdown circuit is open, as far as faults and the remote control show it.
    pub(super) fn sdc_open(&self) -> Truth {
        let by_itself = self.options.readings.has(Choice::BmsDriving);
        let battery = Faults::when(adsdv_spec::Fault::BmsFault, by_itself);
        certain(!self.vcu.opening.difference(battery).is_empty() || self.remote.is_pressed())
    }

    /// How long an edge of the handshake may stay unanswered, in nanoseconds.
    pub(crate) fn handshake_limit(&self) -> i64 {
        i64::from(self.edition.rules.timing.handshake_ms) * MS
    }

    /// How long after its cause an effect may be recorded that comes in time, in nanoseconds: the deadline, and how late its frame may
    /// be.
    pub(crate) const fn patience(&self) -> i64 {
        self.deadline + self.window
    }

    /// The same of what only a frame that was lost could excuse: as long again, for a frame that comes late is no gap.
    pub(crate) fn long_patience(&self) -> i64 {
        2 * self.patience().max(5 * self.cycle())
    }

    /// The cycle of the reference VCU, in nanoseconds.
    pub(crate) fn cycle(&self) -> i64 {
        i64::from(self.edition.rules.timing.cycle_ms) * MS
    }

    /// The answer to a question, if only one is possible.
    pub(crate) fn pinned(&self, reading: Reading) -> Option<Choice> {
        pinned(&self.options, reading)
    }
}

fn pinned(options: &JudgeOptions, reading: Reading) -> Option<Choice> {
    let mut choices = options.readings.of_reading(reading);
    choices.next().filter(|_| choices.next().is_none())
}
