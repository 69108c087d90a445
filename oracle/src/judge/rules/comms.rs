//! The handshake (section 2.4): answers of the AI Computer that are late, edges of the VCU's bit that come too early or too late, and what
//! `AI_COMMS_LOST` has to say of it.

use adsdv_spec::{AsState, Atom, Atoms, Truth};

use super::likely::excuse;
use super::missed::{Missed, and_raised, by_state};
use super::pending::Pending;
use super::silence::Silence;
use crate::judge::book::Book;
use crate::judge::estimator::base::Estimator;
use crate::judge::estimator::watch::Suspect;
use crate::judge::exercised::{ANSWERS, BEGINS, HOLDS, UNANSWERED};
use crate::judge::finding::{Finding, Party, Rule, Severity};
use crate::judge::response::Meter;
use crate::judge::sampler::places::{AI_STATUS, STATUS};
use crate::judge::time::{MS, milliseconds};

/// What is kept of it.
#[derive(Debug, Default)]
pub(super) struct Comms {
    pub(super) meter: Meter,
    pub(super) missed: Missed,
    silence: Silence,
}

impl Comms {
    /// The AI Computer's handshake bit was seen; `changes`: that tells more of the handshake.
    pub(super) fn answered(
        &mut self,
        est: &mut Estimator,
        book: &mut Book,
        (t, bit): (i64, bool),
        changes: bool,
    ) {
        let limit = est.handshake_limit();
        if let Some(response) = self.meter.ai(t, bit) {
            book.answered(t, response, limit);
        }
        if let Some(late) = est.handshake.response().filter(|&response| changes && response > limit) {
            // Too late on the bus. If the VCU saw it in time all the same, it is no more than worth a look.
            let shown = est.shows_comms_lost();
            ai_is_late(est, book, t, if shown { Severity::Violation } else { Severity::Warning });
            book.margins.answered(t, late);
        }
    }

    /// The VCU says that communication is lost, and it is; or time has passed. Before it is up, nobody can tell.
    pub(super) fn may_be_lost(&mut self, est: &mut Estimator, book: &mut Book, t: i64) {
        let limit = est.handshake_limit();
        let waited = est.handshake.unanswered(t).unwrap_or_default();
        let wrong = est.handshake.ai_is_wrong() && est.known.of(Atom::Tsms) == Truth::True;
        if waited >= limit + est.window && wrong {
            ai_is_late(est, book, t, Severity::Violation);
        }
        let shown = est.shows_comms_lost() && est.sampler.last(AI_STATUS).is_some();
        if waited >= limit && shown {
            ai_is_late(est, book, t, by_state(est));
        }
        self.missed.judge(est, book, t);
    }

    /// The VCU was silent for long.
    pub(super) fn vcu_was_silent(&mut self) {
        self.meter.restart();
        self.missed.vcu_was_silent();
    }

    /// 520h shows this: has it been so for too long?
    pub(super) fn due(&mut self, est: &mut Estimator, book: &mut Book, t: i64) {
        book.found(edge_due(est, t));
        book.found(edge_likely_due(est, t));
        self.missed.due(est, book, t);
        self.silence.judge(est, book, t);
    }
}

/// Has the same handshake bit been shown for too long?
fn edge_due(est: &mut Estimator, t: i64) -> Option<Finding> {
    let (limit, status) = (est.handshake_limit(), est.vcu.status?);
    let edge = est.handshake.edge_at().filter(|edge| t - edge > limit + est.deadline)?;
    // In AS_OFF nothing drives yet, and where the AI Computer is still to start every VCU waits for it.
    let waits = est.sampler.last(AI_STATUS).is_none() && est.vcu.state == Some(AsState::Off);
    let tells = status.ai_comms_lost || !status.ts_switch_status || !est.vcu_is_seen();
    if waits || tells || est.handshake.reported_vcu {
        return None;
    }
    est.handshake.still_reported();
    let at = edge + limit + est.deadline;
    let finding = if est.handshake.is_answered() {
        Finding::violation(Party::Vcu, "2.4", Rule::HandshakeEdge, at)
            .against(&[HOLDS[usize::from(status.handshake)]])
            .seen("HANDSHAKE did not change though the AI Computer answered it")
            .expected("it to change")
    } else {
        let waited = milliseconds(t - edge);
        Finding::violation(Party::Vcu, "2.4", Rule::CommsLostDue, at)
            .against(UNANSWERED)
            .seen(format!("AI_COMMS_LOST is 0, but HANDSHAKE has been unanswered for {waited:.0} ms"))
            .expected(format!("1 after {} ms", limit / MS))
    };
    Some(finding.shown_by(est.sampler.last_frames(&[STATUS, AI_STATUS])))
}

/// Has the same handshake bit been shown for too long by what was recorded, however much of it was answered?
///
/// Where frames are late the bit may have gone to and fro between any two of them, but not between all of many.
fn edge_likely_due(est: &mut Estimator, t: i64) -> Option<Finding> {
    let (limit, status) = (est.handshake_limit(), est.vcu.status?);
    let since = est.handshake.stands_still()?;
    let patience = limit + est.deadline + est.long_patience();
    let tells = status.ai_comms_lost || !status.ts_switch_status;
    let heard = est.sampler.last(AI_STATUS).is_some_and(|at| t - at <= est.window);
    // A recorder that keeps one frame of two may keep those of one bit.
    let thin = est.sampler.slot(STATUS).is_none_or(|slot| slot.period >= 2 * est.cycle());
    if t - since < patience || tells || thin || !heard || est.options.complete || est.handshake.reported_vcu {
        return None;
    }
    est.handshake.still_reported();
    let excuse = excuse(est, Atoms::of(&[Atom::Tsms, Atom::AiHandshake]), since, t);
    let stood = milliseconds(t - since);
    let finding = Finding::new(Severity::Warning, Party::Vcu, "2.4", Rule::HandshakeEdge, since + patience)
        .against(&[HOLDS[usize::from(status.handshake)]])
        .seen(format!(
            "by all that was recorded HANDSHAKE did not change for {stood:.0} ms though the AI Computer answered it"
        ))
        .expected("it to change");
    Some(finding.unless(excuse).shown_by(est.sampler.last_frames(&[STATUS, AI_STATUS])))
}

/// The AI Computer has not answered in time; the judge reports that once of an edge.
fn ai_is_late(est: &mut Estimator, book: &mut Book, t: i64, severity: Severity) {
    let Some(edge) = est.handshake.edge_at() else { return };
    if std::mem::replace(&mut est.handshake.reported_ai, true) {
        return;
    }
    let (limit, waited, raised) = (est.handshake_limit(), milliseconds(t - edge), and_raised(est));
    let finding = Finding::new(severity, Party::Ai, "2.4", Rule::HandshakeLate, t.min(edge + limit))
        .against(&[ANSWERS])
        .seen(format!("the AI Computer has not answered HANDSHAKE for {waited:.0} ms{raised}"))
        .expected(format!("an answer within {} ms", limit / MS))
        .shown_by(est.sampler.last_frames(&[STATUS, AI_STATUS]));
    book.found(finding);
}

/// The VCU changed its handshake bit, and the window has passed: was the one before answered?
pub(super) fn judge_edge(est: &Estimator, t: i64, suspect: Suspect) -> Option<Finding> {
    // Of a bit that was there for a moment, the only answer may be missing.
    let gap = est.sampler.slot(AI_STATUS).and_then(|slot| slot.gap_since(suspect.since));
    if est.handshake.clears(suspect) || gap.is_some() {
        return None;
    }
    let bit = u8::from(suspect.bit);
    let finding = Finding::violation(Party::Vcu, "2.4", Rule::HandshakeEdge, t)
        .against(&[HOLDS[usize::from(suspect.bit)]])
        .seen(format!(
            "HANDSHAKE changed from {bit} to {}, but the AI Computer never answered with {bit}",
            1 - bit
        ))
        .expected("the VCU to wait for the answer");
    Some(finding.shown_by(est.sampler.last_frames(&[STATUS, AI_STATUS])))
}

/// The handshake began with a 1 that the AI Computer had shown before: has the VCU taken it for the answer?
///
/// A 0 of the AI Computer in between would be a reason for the 1, and could be recorded behind what the VCU did next. So it is certain
/// only where nothing was lost, and frames come so regularly that none of two steps change places.
pub(super) fn judge_beginning(est: &Estimator, pending: &Pending) -> Option<Finding> {
    let t = pending.t;
    if !est.handshake.went_on_from(t) {
        return None;
    }
    let regular = |index| est.sampler.slot(index).is_some_and(|slot| 2 * slot.spread() <= est.cycle());
    let certain = est.options.complete && regular(STATUS) && regular(AI_STATUS);
    let severity = if certain { Severity::Violation } else { Severity::Warning };
    let finding = Finding::new(severity, Party::Vcu, "2.4", Rule::HandshakeEdge, t)
        .against(&[BEGINS])
        .seen("HANDSHAKE began with 1, which the AI Computer had sent before, and went on to 0")
        .expected("a 1 that the AI Computer answers with a rising edge");
    let excuse = excuse(est, Atoms::of(&[Atom::Tsms, Atom::AiHandshake]), t - est.window, t);
    let finding = if certain { finding } else { finding.unless(excuse) };
    Some(finding.shown_by(est.sampler.frames_of(&pending.frames, &[STATUS, AI_STATUS])))
}
