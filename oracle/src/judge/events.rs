//! Time: what is to be done when it passes.

use adsdv_spec::{Atom, Atoms, Fault, Knowledge, Observation, Truth};

use super::evidence::Frames;
use super::finding::{Finding, Party, Rule};
use super::handshake::Suspect;
use super::history::Moment;
use super::transitions::SeenChange;
use super::{Judge, REMOTE, SILENCE_NS, STATUS};

/// Something that can only be judged once the window behind it has passed.
#[derive(Clone, Debug)]
pub(super) struct Pending {
    /// When it happened.
    pub(super) t: i64,
    /// When it can be judged.
    pub(super) at: i64,
    /// What was known just before.
    pub(super) before: Knowledge,
    /// The last frames when it happened.
    pub(super) frames: Frames,
    pub(super) what: PendingKind,
}

#[derive(Clone, Debug)]
pub(super) enum PendingKind {
    /// A transition was seen.
    SeenChange(SeenChange),
    /// A fault flag was raised.
    Flag(Fault),
    /// The VCU's handshake bit changed without an answer.
    Edge(Suspect),
    /// The AI Computer did what section 3.7 forbids while moving.
    AtSpeed(Fault),
    /// The AI Computer asks for torque and for brakes at once.
    Both,
    /// Something changed, and this is the condition that the change counts.
    Change(Atom),
}

/// Times further away than this (73 years) are taken for this, so that no sum of times overflows.
const FAR_NS: i64 = 1 << 61;

/// A bound on what waits to be judged, for logs in which everything happens at once.
const MAX_PENDING: usize = 256;

impl Judge {
    /// Time goes on to that of a frame. Returns the time that the judge gives it.
    #[inline]
    pub(super) fn tick(&mut self, t_ns: i64) -> i64 {
        let t = t_ns.clamp(-FAR_NS, FAR_NS) + self.offset;
        // Neither a silence nor a step back, which is a very long silence as an unsigned number.
        if t < self.next_event && (t - self.now).cast_unsigned() <= self.pause.cast_unsigned() {
            self.now = t;
            return t;
        }
        self.tick_with_events(t)
    }

    #[cold]
    fn tick_with_events(&mut self, t: i64) -> i64 {
        let last = self.quiet_since.take().unwrap_or(self.now);
        let heard = t.max(last);
        let t = if !self.started || t < last {
            self.set_back(t, last)
        } else {
            let silent = t > self.silence_begins(last);
            if !silent {
                self.lose(last, t);
            }
            self.go_on(t.max(self.now), silent);
            self.now
        };
        if self.started && (t - heard).is_positive() {
            // A frame that was on its way while time was told to pass comes late, but in order; so may the next.
            self.quiet_since = Some(heard);
            self.next_event = i64::MIN;
        }
        self.lose(last, t);
        t
    }

    /// No frame has come up to this time.
    pub(super) fn quiet_until(&mut self, t_ns: i64) {
        let t = t_ns.clamp(-FAR_NS, FAR_NS) + self.offset;
        let last = self.quiet_since.unwrap_or(self.now);
        // Before that it is not known yet whether this will be a silence: the next frame tells.
        if !self.started || t <= self.now || t <= self.silence_begins(last) {
            return;
        }
        self.go_on(t, true);
        self.quiet_since = Some(last);
        self.next_event = i64::MIN;
    }

    /// When it becomes a silence that no frame has come since `last`: longer than usual, also where only 520h was recorded, and
    /// that rarely.
    fn silence_begins(&self, last: i64) -> i64 {
        let status = self.slots.get(STATUS).filter(|slot| slot.last.is_some());
        (last + self.pause).max(status.map_or(i64::MIN, super::Slot::stale_at))
    }

    /// Time goes on to `t`; `silent`: all of it, since the last frame, is a silence.
    fn go_on(&mut self, t: i64, silent: bool) {
        self.events(t, silent);
        self.pass(t, silent);
    }

    fn pass(&mut self, t: i64, silent: bool) {
        if silent {
            self.postpone(t - self.now);
            self.margins.silent_until(t);
        }
        self.now = t;
    }

    /// `last` is when the last frame came.
    #[cold]
    fn set_back(&mut self, t: i64, last: i64) -> i64 {
        if !self.started {
            self.started = true;
            self.offset = -t;
            return self.now;
        }
        let back = last - t;
        // A recorder shuffles frames by no more than the window; beyond that, its clock was set back.
        if back <= self.window {
            if !std::mem::replace(&mut self.shuffled, true) {
                let back = milliseconds(back);
                let seen = format!("the log's time goes back by {back:.3} ms here, and maybe again");
                self.note_log(Rule::TimeBackwards, seen);
            }
            return self.now;
        }
        self.settle_all(self.now);
        self.now = last;
        let by = milliseconds(back);
        let seen = format!("the log's time goes back by {by:.3} ms; judged as a new recording from here on");
        self.note_log(Rule::TimeBackwards, seen);
        self.offset = (self.offset + back).min(FAR_NS);
        self.forget_everything();
        self.senders = super::senders::Senders::default();
        self.forget_values();
        self.now
    }

    /// No frame came for a while: the recorder paused, or its clock was set. What has lasted long enough by its clock
    /// may not have by the VCU's.
    fn postpone(&mut self, by: i64) {
        for timer in self.vcu.timers.iter_mut().filter(|timer| timer.becomes == Truth::True) {
            timer.at += by;
        }
    }

    /// Nothing is known any more.
    pub(super) fn forget_everything(&mut self) {
        self.exercise_forgotten();
        self.known = Knowledge::NOTHING;
        self.history.clear();
        self.why.forget(self.now);
        self.vcu = super::VcuSide::default();
        self.handshake = super::Watch::default();
        self.missed = super::missed::Missed::default();
        self.meter = super::Meter::default();
        self.remote = super::remote::RemoteSide::default();
        self.ebs = super::ebs::Stages::default();
        self.due = None;
        for slot in &mut self.slots {
            slot.fresh = false;
            slot.last = None;
            slot.newest = i64::MIN;
        }
        self.note_seen();
    }

    /// That values were bad is not known any more, either: if they still are, it is told again.
    pub(super) fn forget_values(&mut self) {
        for slot in &mut self.slots {
            slot.bad = 0;
        }
    }

    /// Does everything whose time has come by `t`, in order.
    fn events(&mut self, t: i64, silent: bool) {
        // Each event is settled when it comes up; the bound only guards against a mistake that would loop.
        for _ in 0..10_000 {
            let next = self.upcoming();
            self.next_event = next;
            if next > t {
                return;
            }
            self.pass(self.now.max(next), silent);
            self.event(next);
            self.note_seen();
        }
    }

    /// When the next thing is to be done.
    fn upcoming(&self) -> i64 {
        let stale = self.slots.iter().filter(|slot| slot.fresh).map(super::Slot::stale_at);
        let pending = self.pending.iter().map(|pending| pending.at);
        let timers = self.vcu.timers.iter().map(|timer| timer.at);
        stale
            .chain(pending)
            .chain(timers)
            .chain([self.comms_event(), self.held_event(), self.loss_event(), self.go_event()])
            .min()
            .unwrap_or(i64::MAX)
    }

    fn event(&mut self, t: i64) {
        if let Some(index) = self.slots.iter().position(|slot| slot.fresh && slot.stale_at() <= t) {
            return self.becomes_stale(index, t);
        }
        if let Some(index) = self.vcu.timers.iter().position(|timer| timer.at <= t) {
            let timer = self.vcu.timers.swap_remove(index);
            return self.learn(t, self.known.set(timer.atom, timer.becomes));
        }
        if let Some(index) = self.pending.iter().position(|pending| pending.at <= t) {
            let pending = self.pending.swap_remove(index);
            return self.settle(&pending, t);
        }
        if self.comms_event() <= t {
            return self.comms_time(t);
        }
        if self.held_event() <= t {
            return self.report_held();
        }
        if self.loss_event() <= t {
            return self.report_loss();
        }
        if self.go_event() <= t {
            self.go_settles(t);
        }
    }

    /// A message has not come for so long that one may be missing: what it said is not certain any more.
    fn becomes_stale(&mut self, index: usize, t: i64) {
        let Some(slot) = self.slots.get_mut(index) else { return };
        slot.fresh = false;
        if index == REMOTE {
            return self.remote_gone(t);
        }
        if index == STATUS {
            self.vcu.gap_since = Some(t);
            self.handshake.vcu_gone();
            self.missed.vcu_gone();
            self.update_comms(t);
        } else if index == super::AI_STATUS {
            self.handshake.ai_gone();
            self.update_comms(t);
        }
        self.learn(t, self.known.forget(self.scope(index)));
    }

    /// The end of the log, or of a recording in it: judges what is open with what there is.
    pub(super) fn settle_all(&mut self, t: i64) {
        self.pending.sort_by_key(|pending| pending.t);
        for pending in std::mem::take(&mut self.pending) {
            self.settle(&pending, t);
        }
    }

    fn settle(&mut self, pending: &Pending, now: i64) {
        match &pending.what {
            PendingKind::SeenChange(seen) => self.judge_seen(pending, seen, now),
            PendingKind::Flag(fault) => self.judge_flag(pending, *fault, now),
            PendingKind::Edge(suspect) => self.judge_edge(pending.t, *suspect),
            PendingKind::AtSpeed(fault) => self.judge_at_speed(pending, *fault, now),
            PendingKind::Both => self.judge_both(pending, now),
            PendingKind::Change(edge) => self.judge_change(pending, *edge, now),
        }
    }

    pub(super) fn suspend(&mut self, t: i64, wait: i64, before: Knowledge, what: PendingKind) {
        if self.pending.len() >= MAX_PENDING {
            // Far more than any bus does in a window: what comes too early to be judged is left open.
            let oldest = self.pending.swap_remove(0);
            if let PendingKind::SeenChange(seen) = &oldest.what {
                self.judge_seen(&oldest, seen, oldest.t);
            }
        }
        let at = t + wait;
        self.pending.push(Pending { t, at, before, frames: self.frames(), what });
        self.wake_at(at);
    }

    /// What is known of all of the time from `start` to `end`, where the judge has seen up to `now`.
    ///
    /// What the log ends too early to tell is unknown. Messages that come rarely are looked at for longer: they
    /// show late what was so before.
    pub(super) fn throughout(&self, start: i64, end: i64, now: i64) -> Knowledge {
        let seen = |end| if now < end { Knowledge::NOTHING } else { self.history.throughout(start, end) };
        let mut known = seen(end);
        for (index, slot) in self.slots.iter().enumerate() {
            if self.is_slow(slot) && !self.scope(index).is_empty() {
                let both = known.meet(seen(end + slot.usual() * 2));
                let certain = self.scope(index).intersection(both.on().union(both.off()));
                known = known.forget(self.scope(index)).learn(certain, both.on());
            }
        }
        known
    }

    /// Whether a message comes so rarely that a window may pass between two of its frames.
    fn is_slow(&self, slot: &super::Slot) -> bool {
        slot.usual() > self.window
    }

    /// How long to wait until all that decides these atoms in a window has been seen.
    pub(super) fn wait_for(&self, atoms: Atoms) -> i64 {
        let slow =
            self.slots.iter().enumerate().filter(|&(index, slot)| {
                self.is_slow(slot) && !self.scope(index).intersection(atoms).is_empty()
            });
        // Half a period more than is looked at: what is known of the period may change meanwhile.
        self.window + slow.map(|(_, slot)| slot.usual() * 5 / 2).max().unwrap_or(0)
    }

    /// The moments between `start` and `end`, with what was known at each.
    pub(super) fn moments(&self, start: i64, end: i64) -> Vec<Moment> {
        self.history.between(start, end).copied().collect()
    }

    /// Silence of the VCU: what it is, is unknown.
    pub(super) fn after_silence(&mut self, t: i64, silent: i64) {
        if silent < SILENCE_NS {
            return;
        }
        let seconds = milliseconds(silent) / 1e3;
        let seen = format!("no frame of the VCU for {seconds:.3} s; what it did meanwhile is unknown");
        self.found(Finding::note(Party::Log, "2.2", Rule::Gap, self.now).seen(seen));
        self.vcu = super::VcuSide::default();
        self.handshake.vcu_gone();
        self.meter.restart();
        self.due = None;
        // What the VCU remembers is gone with it.
        let known = self.known.forget(Atoms::ALL.difference(Observation::SCOPE));
        self.learn(t, known);
    }
}

#[allow(clippy::cast_precision_loss, reason = "a duration for display")]
pub(super) fn milliseconds(ns: i64) -> f64 {
    ns as f64 / 1e6
}
