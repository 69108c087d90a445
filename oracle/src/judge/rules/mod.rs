//! The rules: what the estimator has is held against the document, and findings come of it.
//!
//! Each file has the rules of one kind, and sees the estimator only. `pending.rs` is what they have in common: most that happens can be
//! judged only once the window behind it has passed, and much must only not last.

mod alike;
mod changes;
mod comms;
mod conduct;
mod flags;
mod go_signal;
mod likely;
mod missed;
mod pending;
mod rise;
mod silence;
mod texts;
mod unfounded;
pub(super) mod values;
mod vcu_status;

use adsdv_spec::messages::{Ai2VcuStatus, AnyMessage};
use adsdv_spec::{AsState, Fault};

use alike::{Assi, Ebs};
use changes::Due;
use comms::Comms;
use conduct::Conduct;
use flags::Flags;
use go_signal::GoSignal;
use likely::Likely;
use pending::{Awaited, Pending, Queue};
use vcu_status::StatusWatch;

use super::book::Book;
use super::estimator::base::Estimator;
use super::estimator::status::StatusChange;
use super::finding::{Finding, Party, Rule};
use super::sampler::content::FrameContent;
use super::sampler::{Came, Says};
use super::time::milliseconds;

/// What the rules keep.
#[derive(Debug, Default)]
pub(super) struct Rules {
    queue: Queue,
    due: Option<Due>,
    likely: Likely,
    flags: Flags,
    comms: Comms,
    conduct: Conduct,
    assi: Assi,
    ebs: Ebs,
    go: GoSignal,
    vcu_status: StatusWatch,
}

impl Rules {
    /// A frame came that says something else than the one before, and nothing of it has been looked at yet.
    pub(super) fn came(&mut self, est: &Estimator, book: &mut Book, came: &Came, says: &Says) {
        values::judge(&est.sampler, book, came, says);
        if let Says::This { content, .. } = says {
            match content.message {
                AnyMessage::Vcu2AiStatus(message) => {
                    let readable = est.sampler.stage && !content.is_bad("ebs_state");
                    self.ebs.stage = Some(message.ebs_state).filter(|_| readable);
                }
                AnyMessage::Vcu2AiBrake(message) => {
                    self.ebs.status = Some(message.status_ebs).filter(|_| !content.is_bad("status_ebs"));
                }
                _ => {}
            }
        }
        book.margins.due = self.due.map(|due| (due.since, due.way, due.reported));
    }

    /// 520h shows something else.
    pub(super) fn shown(&mut self, est: &mut Estimator, book: &mut Book, t: i64, shown: &StatusChange) {
        if let Some(silence) = shown.silence {
            let seconds = milliseconds(silence) / 1e3;
            let seen = format!("no frame of the VCU for {seconds:.3} s; what it did meanwhile is unknown");
            book.found(Finding::note(Party::Log, "2.2", Rule::Gap, t).seen(seen));
            (self.due, self.flags, self.assi) = (None, Flags::default(), Assi::default());
            self.vcu_status = StatusWatch::default();
            self.comms.vcu_was_silent();
        }
        let (bit, before) = (shown.status.handshake, shown.previous.map(|previous| previous.handshake));
        book.tally.handshake(before, bit, shown.answered);
        self.comms.meter.vcu(t, bit);
        if let Some(suspect) = shown.suspect {
            self.wait(est, book, t, est.window, Awaited::Edge(suspect));
        }
        match shown.begins {
            Some(true) => book.tally.begins(),
            Some(false) => self.wait(est, book, t, est.handshake_limit() + est.window, Awaited::Beginning),
            None => {}
        }
        if let Some(change) = shown.change {
            book.notice_change(est, t, &change);
            // When it was left within a longer silence nobody knows.
            if t - change.before <= est.window {
                book.found(likely::likely_due(&mut self.likely, est, t, change.from));
            }
            let wait = est.sampler.wait_for(est.readings.deciding(change.from));
            self.wait(est, book, t, wait, Awaited::Change(change));
        }
        book.found(go_signal::entered(est, t, shown));
        if let Some(state) = shown.entered {
            self.enters(book, state, shown.change.is_none());
        } else if est.vcu.state.is_none() {
            self.due = None;
        }
        for fault in flags::risen(shown) {
            self.wait(est, book, t, unfounded::wait_for(est, fault), Awaited::Flag(fault, shown.before));
            if fault == Fault::AiCommsFault && !shown.gap {
                self.comms.may_be_lost(est, book, t);
                book.exercise_lost(est, t, self.comms.missed.is_any());
            }
        }
        self.flags.shown(est, book, t, shown);
    }

    /// The VCU shows a state that it did not show before; `anew` tells whether none was known.
    fn enters(&mut self, book: &mut Book, state: AsState, anew: bool) {
        book.tally.shows(state);
        if anew {
            book.notice_unknown_state();
            // In which state the AI Computer did something before that, nobody has seen.
            self.queue.forget_conduct(conduct::BOTH);
        }
        (self.due, self.likely, self.conduct) = (None, Likely::default(), Conduct::default());
    }

    /// 520h shows this, maybe again: what should have come by now?
    pub(super) fn status(&mut self, est: &mut Estimator, book: &mut Book, t: i64) {
        book.found(changes::due_at_status(&mut self.due, &mut self.likely, est, t));
        if let Some(state) = est.vcu.state {
            book.found(likely::likely_due(&mut self.likely, est, t, state));
        }
        self.comms.due(est, book, t);
        self.flags.over_time(est, book, t);
        book.found(self.ebs.compare(est, t));
        book.found(self.go.compare(est, t));
    }

    /// 510h came with something new; `previous` is the one before, where that is known.
    pub(super) fn ai_says(
        &mut self,
        est: &Estimator,
        book: &mut Book,
        t: i64,
        status: Ai2VcuStatus,
        previous: Option<Ai2VcuStatus>,
    ) {
        self.flags.ai_asks(est, t, status.estop_request, previous.map(|previous| previous.estop_request));
        book.notice_declared(est, t, status, previous);
    }

    /// The AI Computer's handshake bit was seen.
    #[inline]
    pub(super) fn answered(&mut self, est: &mut Estimator, book: &mut Book, t: i64, bit: bool) {
        let changes = est.ai_answers(t, bit);
        self.comms.answered(est, book, (t, bit), changes);
    }

    /// A message of the AI Computer came that is watched.
    pub(super) fn heard(&mut self, place: usize) {
        self.comms.missed.heard(place);
    }

    /// Whether it was reported that this message is missing.
    pub(super) fn is_missed(&self, index: usize) -> bool {
        self.comms.missed.is(index)
    }

    /// 120h came, with something new if there is any.
    pub(super) fn vcu_status(
        &mut self,
        est: &mut Estimator,
        book: &mut Book,
        t: i64,
        new: Option<(&FrameContent, &Came)>,
    ) {
        if let Some((content, came)) = new
            && let AnyMessage::VcuStatus(shown) = content.message
        {
            est.silences.vcu_shows(t, Some(vcu_status::timeouts(&shown)));
            self.comms.missed.judge(est, book, t);
            for rise in self.vcu_status.shown(est, came, content, shown) {
                self.wait(est, book, t, vcu_status::wait_for(est, rise), Awaited::Raised(rise));
            }
        }
        self.vcu_status.over_time(est, book, t);
    }

    /// 502h came, with something new if that can be read.
    pub(super) fn assi(&mut self, est: &Estimator, book: &mut Book, t: i64, content: Option<&FrameContent>) {
        let shown = match content.map(|content| (content.message, content.is_bad("state_assi"))) {
            Some((AnyMessage::Vcu2LogStatus(message), false)) => Some(message.state_assi),
            Some(_) => return,
            None => None,
        };
        book.found(self.assi.shown(est, t, shown));
    }

    /// The remote control shows "Go" switched on, after it was off for a while.
    pub(super) fn go_shown_on(&mut self, est: &Estimator, t: i64) {
        likely::go_shown_on(&mut self.likely, est, t);
    }

    /// What is known has changed.
    pub(super) fn reconsider(&mut self, est: &mut Estimator, book: &mut Book, t: i64) {
        for (edge, truth) in std::mem::take(&mut est.edges) {
            let wait = est.vcu.state.map_or(0, |state| est.sampler.wait_for(est.readings.deciding(state)));
            self.wait(est, book, t, wait, Awaited::Counts(edge, truth));
        }
        if std::mem::take(&mut est.changed) {
            likely::reconsider_shown(&mut self.likely, est, t);
            for (wait, what) in self.conduct.reconsider(est, book, t) {
                self.wait(est, book, t, wait, what);
            }
            changes::reconsider(&mut self.due, est, t);
        }
    }

    /// When something is to be judged, though no frame comes.
    pub(super) fn next(&self, est: &Estimator) -> i64 {
        self.queue.next().min(self.conduct.next(est))
    }

    /// Communication may have been lost by now.
    pub(super) fn comms_time(&mut self, est: &mut Estimator, book: &mut Book, t: i64) {
        est.update_comms(t);
        self.comms.may_be_lost(est, book, t);
    }

    /// Requests may have held the vehicle for too long. Tells whether it was time to look.
    pub(super) fn held(&mut self, est: &Estimator, book: &mut Book, t: i64) -> bool {
        let time = self.conduct.next(est) <= t;
        book.found(if time { self.conduct.held(est) } else { None });
        time
    }

    fn wait(&mut self, est: &Estimator, book: &mut Book, t: i64, wait: i64, what: Awaited) {
        if let Some(oldest) = self.queue.wait(t, wait, &est.sampler.frames(), what)
            && let Awaited::Change(_) = oldest.what
        {
            // What comes too early to be judged is left open.
            self.settle(est, book, &oldest);
        }
    }

    /// Judges the next of what waited, if its time has come. Tells whether there was any.
    pub(super) fn settle_next(&mut self, est: &Estimator, book: &mut Book, t: i64) -> bool {
        let pending = self.queue.ready(t);
        if let Some(pending) = &pending {
            self.settle(est, book, pending);
        }
        pending.is_some()
    }

    /// The end of the log, or of a recording in it: judges what is open with what there is.
    pub(super) fn settle_all(&mut self, est: &Estimator, book: &mut Book) {
        for pending in self.queue.take() {
            self.settle(est, book, &pending);
        }
    }

    fn settle(&mut self, est: &Estimator, book: &mut Book, pending: &Pending) {
        let t = pending.t;
        match pending.what {
            Awaited::Change(seen) => {
                let certain = changes::judge_seen(est, book, pending, &seen);
                self.flags.brake = self.flags.brake.map(|(since, was)| (since, was || certain && since == t));
            }
            Awaited::Flag(fault, before) => unfounded::judge_flag(est, book, pending, fault, before),
            Awaited::Edge(suspect) => {
                book.found(comms::judge_edge(est, t, suspect));
            }
            Awaited::Beginning => book.found(comms::judge_beginning(est, pending)),
            Awaited::Conduct(fault, before) => {
                if let Some(wait) = self.conduct.judge(est, book, pending, (fault, before)) {
                    self.wait(est, book, t, wait, Awaited::Conduct(fault, before));
                }
                for (wait, what) in self.conduct.reconsider(est, book, est.now) {
                    self.wait(est, book, est.now, wait, what);
                }
            }
            Awaited::Raised(rise) => book.found(vcu_status::judge_raised(est, pending, rise)),
            Awaited::Counts(edge, truth) => changes::guard_held(&mut self.due, est, t, edge, truth),
        }
    }

    /// Nothing is known any more. What waits is judged all the same, and the AI Computer's conduct goes on; what a rule keeps besides is
    /// forgotten, unless it is named here.
    pub(super) fn forget(&mut self) {
        let Self { queue, likely, conduct, .. } = std::mem::take(self);
        *self = Self { queue, likely, conduct, ..Self::default() };
    }

    /// What waits is of two vehicles, and is not judged.
    pub(super) fn forget_pending(&mut self) {
        self.queue = Queue::default();
    }
}
