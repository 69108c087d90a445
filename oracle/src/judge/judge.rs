//! The walk of a frame: time goes on to it, the sampler takes it, the estimator learns from it, and the rules look at that.

use adsdv_spec::messages::{AnyMessage, MessageDef, Vcu2AiStatus};
use adsdv_spec::{AsState, Edition, Knowledge};

use super::book::Book;
use super::estimator::base::Estimator;
use super::finding::{Finding, Party, Rule};
use super::options::JudgeOptions;
use super::own::Own;
use super::report::{Report, Transition};
use super::response::ResponseTimes;
use super::rules::{Rules, values};
use super::sampler::loss::Loss;
use super::sampler::places::{AI_STATUS, COUNT, LOG_STATUS, REMOTE, STATUS, VCU_STATUS};
use super::sampler::slot::Slot;
use super::sampler::{Came, Says};
use super::senders::Senders;
use super::time::{FAR_NS, milliseconds};
use crate::rules::{RuleErrors, RuleFile};
use crate::why::Stay;

/// The judge of one log, or of one live bus.
#[derive(Debug)]
pub struct Judge {
    est: Estimator,
    rules: Rules,
    book: Book,
    loss: Loss,
    senders: Senders,
    /// No shorter time without a frame is a silence.
    pause: i64,
    /// When the last frame came, if time has passed without one since.
    quiet_since: Option<i64>,
    /// Whether messages of the edition that never come are noted.
    notes_absent: bool,
    started: bool,
    /// Whether it was said that frames do not come in the order of time.
    shuffled: bool,
    /// Added to the time of frames, so that time goes on after it was set back.
    offset: i64,
    /// Nothing is to be done before this time; the least of all when something is to be done at the next frame anyway.
    next_event: i64,
    frames: u64,
    own: Own,
}

impl Judge {
    /// A judge that has seen nothing yet.
    pub fn new(options: JudgeOptions) -> Self {
        let est = Estimator::new(options);
        Self {
            rules: Rules::default(),
            book: Book::new(&est.edition),
            loss: Loss::default(),
            senders: Senders::new(&est.edition.bus),
            // Most messages come once a cycle, all at once: one frame may be missing.
            pause: est.window.max(est.cycle() * 2),
            est,
            quiet_since: None,
            notes_absent: true,
            started: false,
            shuffled: false,
            offset: 0,
            next_event: i64::MIN,
            frames: 0,
            own: Own::default(),
        }
    }

    /// Judges a classic CAN data frame with an 11-bit identifier, at a time in nanoseconds since the first frame.
    ///
    /// Frames of no message of the document are left alone. Data of any length is fine, and time may jump.
    #[inline]
    pub fn frame(&mut self, t_ns: i64, id: u32, data: &[u8]) {
        self.takes(t_ns, id, data);
        self.own.judged(&self.est, &mut self.book);
    }

    #[inline]
    fn takes(&mut self, t_ns: i64, id: u32, data: &[u8]) {
        self.frames += 1;
        let t = self.tick(t_ns);
        let Some(index) = self.est.sampler.index(id) else {
            return values::other_id(&self.est.edition, &mut self.book, t, id);
        };
        let Some(came) = self.est.sampler.frame(index, t_ns, t, data) else { return };
        self.next_event = self.next_event.min(came.stale_at);
        if let Some(before) = came.before.filter(|&before| t - before > self.book.margins.longest_gap(index))
        {
            let missed = self.rules.is_missed(index);
            self.book.longer_gap(&self.est, missed, index, before, t);
        }
        if came.same {
            self.repeated(index, t);
        } else if let Some(says) = self.est.sampler.read(index) {
            self.changed(&came, &says);
        }
        if let Some(place) = self.est.ends_silence(index, t) {
            self.rules.heard(place);
        }
        self.next_event = self.next_event.min(self.est.comms_at);
        if !came.same || self.est.changed {
            self.rules.reconsider(&mut self.est, &mut self.book, t);
            self.next_event = self.next_event.min(self.est.next()).min(self.rules.next(&self.est));
        }
        if index == STATUS && self.est.vcu_is_seen() && !self.senders.several() {
            self.book.found(self.senders.came(t));
            self.rules.status(&mut self.est, &mut self.book, t);
        }
    }

    /// A frame came with the same content as the one before.
    fn repeated(&mut self, index: usize, t: i64) {
        match index {
            AI_STATUS => {
                if let Some(status) = self.est.ai {
                    self.rules.answered(&mut self.est, &mut self.book, t, status.handshake);
                }
            }
            LOG_STATUS => {
                self.est.sampled(t);
                self.rules.assi(&self.est, &mut self.book, t, None);
            }
            REMOTE => self.est.remote_lasts(t),
            VCU_STATUS if !self.senders.several() => {
                self.rules.vcu_status(&mut self.est, &mut self.book, t, None);
            }
            _ => {}
        }
    }

    /// A frame came with another content than the one before, or after a silence.
    fn changed(&mut self, came: &Came, says: &Says) {
        let Self { est, book, rules, .. } = self;
        let t = came.t;
        rules.came(est, book, came, says);
        match says {
            Says::TooShort { .. } | Says::Remote(None) => est.says_nothing(came.index, t),
            Says::Remote(Some(shown)) => {
                if est.remote_shows(t, *shown) {
                    rules.go_shown_on(est, t);
                }
            }
            Says::This { content, .. } => match content.message {
                AnyMessage::Vcu2AiStatus(status) => {
                    let last =
                        est.vcu.status.filter(|_| est.vcu.state.is_some() && !content.is_bad("as_state"));
                    if self.senders.several() || last.is_some_and(|last| self.is_of_another(t, last, status))
                    {
                        return;
                    }
                    let Self { est, book, rules, .. } = self;
                    let shown = est.shows(came, content, status);
                    rules.shown(est, book, t, &shown);
                }
                AnyMessage::Ai2VcuStatus(status) if content.bad == 0 => {
                    let previous = est.ai_says(came, status);
                    rules.ai_says(est, book, t, status, previous);
                    rules.answered(est, book, t, status.handshake);
                }
                _ => {
                    est.learns(came, content);
                    if came.index == LOG_STATUS {
                        est.sampled(t);
                        rules.assi(est, book, t, Some(content));
                    }
                    if came.index == VCU_STATUS && !self.senders.several() {
                        rules.vcu_status(est, book, t, Some((content, came)));
                    }
                }
            },
        }
    }

    /// 520h shows something else than before. Tells whether that is of another VCU.
    fn is_of_another(&mut self, t: i64, last: Vcu2AiStatus, now: Vcu2AiStatus) -> bool {
        let Some(finding) = self.senders.changed(t, [last, now], &self.est.edition.bus) else {
            return false;
        };
        // What waited to be judged is of both.
        self.rules.forget_pending();
        self.forget_everything();
        self.book.found(finding.shown_by(self.est.sampler.last_frames(&[STATUS])));
        true
    }

    /// The edition of the interface that is judged by.
    pub const fn edition(&self) -> &Edition {
        &self.est.edition
    }

    /// What the edition says of the message with this identifier, if it is one that is judged.
    pub(crate) fn message(&self, id: u32) -> Option<&'static MessageDef> {
        self.est.sampler.def(self.est.sampler.index(id)?)
    }

    /// From now on follows rules of the user's own beside the document: what breaks one is a violation of [`Party::Own`], and the
    /// report says what became of each.
    ///
    /// ```
    /// use adsdv_oracle::judge::{Judge, JudgeOptions, Party};
    ///
    /// let mut judge = Judge::new(JudgeOptions::default());
    /// judge.follow(&"calm: never AS_STATE is AS_READY".parse()?)?;
    /// judge.frame(0, 0x520, &[0, 0, 2, 0, 0, 0, 0, 0]);
    /// let report = judge.finish();
    /// assert_eq!(report.findings[0].message(), "calm: AS_STATE is AS_READY; expected never AS_STATE is AS_READY");
    /// assert_eq!((report.findings[0].party, report.rules[0].broken), (Party::Own, 1));
    /// # Ok::<(), adsdv_oracle::rules::RuleErrors>(())
    /// ```
    ///
    /// # Errors
    ///
    /// Fails, and changes nothing, if the edition has not all that the rules name.
    pub fn follow(&mut self, rules: &RuleFile) -> Result<(), RuleErrors> {
        self.own.follow(rules, &self.est)
    }

    /// Counts a frame that is not judged, and lets time pass. Returns the time that the judge gives it.
    pub fn other_frame(&mut self, t_ns: i64) -> i64 {
        self.frames += 1;
        let t = self.tick(t_ns);
        self.own.judged(&self.est, &mut self.book);
        t
    }

    /// The log says that the AI Computer itself sent a frame with this identifier, which is not for it to send. It says
    /// nothing about the VCU.
    pub fn sent_by_ai(&mut self, t_ns: i64, id: u32) {
        let t = self.other_frame(t_ns);
        values::sent_by_ai(&self.est.edition, &mut self.book, t, id);
    }

    /// No frame has come up to this time, in nanoseconds since the first frame: what waited for it is judged.
    ///
    /// A time before that of the last frame changes nothing.
    pub fn time_passes(&mut self, t_ns: i64) {
        let t = t_ns.clamp(-FAR_NS, FAR_NS) + self.offset;
        let last = self.quiet_since.unwrap_or(self.est.now);
        // Before that it is not known yet whether this will be a silence: the next frame tells.
        if !self.started || t <= self.est.now || t <= self.silence_begins(last) {
            return;
        }
        self.go_on(t, true);
        self.own.passes(&self.est, &mut self.book);
        self.quiet_since = Some(last);
        self.next_event = i64::MIN;
    }

    /// So many frames were lost before the next one: what they said is unknown, and nothing is known any more.
    ///
    /// Losses that follow one another within a window are reported as one.
    pub fn lost(&mut self, count: u64) {
        self.loss.comes(count);
        self.next_event = i64::MIN;
    }

    /// There is no further frame: settles what is still open. What is reported from now on has the time of the last one,
    /// whatever time has passed since.
    pub(crate) fn end(&mut self) {
        let end = self.quiet_since.take().unwrap_or(self.est.now);
        self.est.now = end;
        self.lose(end, end);
        self.rules.settle_all(&self.est, &mut self.book);
        self.own.end(&self.est, &mut self.book);
        self.book.found(self.loss.tell());
        let missed: [bool; COUNT] = std::array::from_fn(|index| self.rules.is_missed(index));
        self.book.notice_end(&self.est, &missed, end);
    }

    /// Adds what was found, by the judge itself, by the reader of the log, or by somebody who follows rules of his own. The
    /// requirements are those that the edition has for the ones that are named.
    pub fn found(&mut self, finding: Finding) {
        self.book.found(finding);
    }

    /// A note about the log itself, at this time.
    pub(crate) fn note_log(&mut self, rule: Rule, seen: String) {
        self.found(Finding::note(Party::Log, "2", rule, self.est.now).seen(seen));
    }

    /// Somebody else reports the messages of the edition that never come.
    pub(crate) const fn knows_what_is_absent(&mut self) {
        self.notes_absent = false;
    }

    /// The end of the log: settles what is still open.
    pub fn finish(self) -> Report {
        self.finish_with_news().0
    }

    /// The same, with the findings that are new since they were last asked for: see [`Judge::news`].
    pub fn finish_with_news(mut self) -> (Report, Vec<Finding>) {
        self.end();
        let now = self.est.now;
        let absent = values::absent(&self.est.sampler, &self.est.edition, now);
        for finding in absent.into_iter().filter(|_| self.notes_absent) {
            self.book.found(finding);
        }
        self.book.found(values::one_sided(&self.est.sampler, now));
        let (margins, exercised) = (self.book.margins(&self.est), self.book.exercised(&self.est));
        let (stays, go_presses) = self.est.why.end(now);
        let (rules, (_, news)) = (self.own.reports, self.book.out.news());
        let report = self.book.out.report(self.frames, now);
        (Report { stays, go_presses, margins, exercised, rules, ..report }, news)
    }

    /// What has been settled since this was last asked, by time; for a live bus. The report has it as well. What takes longer to
    /// settle may come after what happened later.
    ///
    /// Of the findings of one rule that the report only counts, because there are too many to be listed, one in a second is
    /// among it; the first of them comes behind a finding of [`Rule::Repeated`] that says so. These the report does not have.
    pub fn news(&mut self) -> (Vec<Transition>, Vec<Finding>) {
        self.book.out.news()
    }

    /// What has been found so far and not been taken yet, in order. The report does not have it any more.
    pub fn take_news(&mut self) -> (Vec<Transition>, Vec<Finding>) {
        self.book.out.take()
    }

    /// How fast the AI Computer has answered the handshake so far.
    pub fn responses(&self) -> &ResponseTimes {
        &self.book.out.responses
    }

    /// The AS state that the VCU showed last, while its frames are fresh.
    pub fn state(&self) -> Option<AsState> {
        self.est.state_seen()
    }

    /// When the last frame came, by the time that the judge gives it.
    pub(crate) fn now_ns(&self) -> i64 {
        self.est.now
    }

    /// How long after its cause an effect may be seen.
    pub(crate) const fn window_ns(&self) -> i64 {
        self.est.window
    }

    /// What is known now.
    pub fn known(&self) -> Knowledge {
        self.est.known
    }

    /// The state that lasts now, with what blocks its arrows, and the time up to which that is so; `None` while no state is known.
    pub fn waits(&self) -> Option<(i64, &Stay)> {
        Some((self.est.now, self.est.why.now()?))
    }

    /// Time goes on to that of a frame. Returns the time that the judge gives it.
    #[inline]
    fn tick(&mut self, t_ns: i64) -> i64 {
        let t = t_ns.clamp(-FAR_NS, FAR_NS) + self.offset;
        // Neither a silence nor a step back, which is a very long silence as an unsigned number.
        if t < self.next_event && (t - self.est.now).cast_unsigned() <= self.pause.cast_unsigned() {
            self.est.now = t;
            return t;
        }
        self.tick_with_events(t)
    }

    #[cold]
    fn tick_with_events(&mut self, t: i64) -> i64 {
        let last = self.quiet_since.take().unwrap_or(self.est.now);
        let heard = t.max(last);
        let t = if !self.started || t < last {
            self.set_back(t, last)
        } else {
            let silent = t > self.silence_begins(last);
            if !silent {
                self.lose(last, t);
            }
            self.go_on(t.max(self.est.now), silent);
            self.est.now
        };
        if self.started && (t - heard).is_positive() {
            // A frame that was on its way while `time_passes` was called comes late, but in order; so may the next.
            self.quiet_since = Some(heard);
            self.next_event = i64::MIN;
        }
        self.lose(last, t);
        t
    }

    /// When it becomes a silence that no frame has come since `last`: longer than usual, also where only 520h was recorded, and
    /// that rarely.
    fn silence_begins(&self, last: i64) -> i64 {
        let status = self.est.sampler.slot(STATUS).filter(|slot| slot.last.is_some());
        (last + self.pause).max(status.map_or(i64::MIN, Slot::stale_at))
    }

    /// Time goes on to `t`, and everything is done whose time has come, in order; `silent`: all of it, since the last frame, is a
    /// silence.
    fn go_on(&mut self, t: i64, silent: bool) {
        // Each event is settled when it comes up; the bound only guards against a mistake that would loop.
        for _ in 0..10_000 {
            let est = &self.est;
            let loss_due_at = self.loss.due_at(self.pause);
            self.next_event = est.sampler.next().min(est.next()).min(self.rules.next(est)).min(loss_due_at);
            if self.next_event > t {
                break;
            }
            let next = self.next_event;
            self.pass(self.est.now.max(next), silent);
            self.event(next);
            self.rules.reconsider(&mut self.est, &mut self.book, next);
            self.own.aged(&self.est);
        }
        self.pass(t, silent);
    }

    fn pass(&mut self, t: i64, silent: bool) {
        if silent {
            self.est.postpone(t - self.est.now);
            self.book.margins.silent_until(t);
        }
        self.est.now = t;
    }

    fn event(&mut self, t: i64) {
        let (est, book, rules) = (&mut self.est, &mut self.book, &mut self.rules);
        if let Some(index) = est.sampler.too_old(t) {
            return est.becomes_stale(index, t);
        }
        if est.time_comes(t) || rules.settle_next(est, book, t) {
            return;
        }
        if est.comms_at <= t {
            return rules.comms_time(est, book, t);
        }
        if rules.held(est, book, t) {
            return;
        }
        if self.loss.due_at(self.pause) <= t {
            return book.found(self.loss.tell());
        }
        // In a silence a timer may have been put off instead.
        if est.remote.go_settles.is_some_and(|at| at <= t) {
            est.go_settles(t);
        }
    }

    /// `last` is when the last frame came.
    #[cold]
    fn set_back(&mut self, t: i64, last: i64) -> i64 {
        if !std::mem::replace(&mut self.started, true) {
            self.offset = -t;
            return self.est.now;
        }
        let back = last - t;
        let by = milliseconds(back);
        // A recorder shuffles frames by no more than the window; beyond that, its clock was set back.
        if back <= self.est.window {
            if !std::mem::replace(&mut self.shuffled, true) {
                let seen = format!("the log's time goes back by {by:.3} ms here, and maybe again");
                self.note_log(Rule::TimeBackwards, seen);
            }
            return self.est.now;
        }
        self.rules.settle_all(&self.est, &mut self.book);
        self.est.now = last;
        let seen = format!("the log's time goes back by {by:.3} ms; judged as a new recording from here on");
        self.note_log(Rule::TimeBackwards, seen);
        self.offset = (self.offset + back).min(FAR_NS);
        self.forget_everything();
        self.senders = Senders::new(&self.est.edition.bus);
        self.est.sampler.forget_values();
        self.est.now
    }

    /// The next frame comes at `until`, the last one came at `since`: what was lost in between makes everything unknown.
    fn lose(&mut self, since: i64, until: i64) {
        if !self.loss.is_coming() {
            return;
        }
        self.rules.settle_all(&self.est, &mut self.book);
        self.forget_everything();
        if self.loss.ends(since, until) {
            self.est.sampler.forget_values();
        }
        self.next_event = self.next_event.min(self.loss.due_at(self.pause));
    }

    /// Nothing is known any more.
    fn forget_everything(&mut self) {
        self.book.exercise_forgotten(&self.est);
        self.est.forget();
        self.rules.forget();
        self.own.aged(&self.est);
    }
}
