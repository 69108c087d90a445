//! Communication (section 2.4): answers of the AI Computer that are late, messages of it that are missed, edges of the VCU's bit that
//! come too early, and `AI_COMMS_LOST`.

use adsdv_spec::{AsState, Atom, Atoms, Truth};

use super::likely::excuse;
use super::pending::Pending;
use super::silence::Silence;
use super::vcu_status::{TIMEOUTS, name_of};
use crate::judge::book::Book;
use crate::judge::estimator::base::Estimator;
use crate::judge::estimator::silences::{Silences, WATCHED, place_of};
use crate::judge::estimator::watch::Suspect;
use crate::judge::exercised::{ANSWERS, BEGINS, HOLDS, MISSED, UNANSWERED};
use crate::judge::finding::{Finding, Party, Rule, Severity};
use crate::judge::response::Meter;
use crate::judge::sampler::places::{AI_STATUS, STATUS, VCU_STATUS};
use crate::judge::time::{MS, milliseconds};

/// What is kept of it.
#[derive(Debug, Default)]
pub(super) struct Comms {
    pub(super) meter: Meter,
    /// Whether the silence of each message that is watched was reported.
    reported: [bool; WATCHED.len()],
    /// Whether it was reported that the VCU does not show it, and when the VCU last showed it.
    reported_vcu: bool,
    shown_at: Option<i64>,
    silence: Silence,
}

impl Comms {
    /// Nothing is known any more.
    pub(super) fn forget(&mut self) {
        *self = Self::default();
    }

    /// A message that is watched came.
    pub(super) fn heard(&mut self, place: usize) {
        if let Some(reported) = self.reported.get_mut(place) {
            *reported = false;
        }
    }

    /// Whether it was reported that this message is missing.
    pub(super) fn is_missed(&self, index: usize) -> bool {
        place_of(index).and_then(|place| self.reported.get(place)).is_some_and(|reported| *reported)
    }

    /// Whether it was reported of any.
    pub(super) fn any_missed(&self) -> bool {
        self.reported.contains(&true)
    }

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
        self.judge_missed(est, book, t);
    }

    /// Is the AI Computer at fault, because a message of it has been silent?
    pub(super) fn judge_missed(&mut self, est: &Estimator, book: &mut Book, t: i64) {
        let Some(limit) = est.silences.limit else { return };
        let watching = est.silences.is_watching(t, est.known.of(Atom::Tsms));
        // Whether a VCU that says so watches rightly, or for itself, no document says.
        if est.silences.silent == Truth::False || watching != Truth::True {
            return;
        }
        for (place, reported) in self.reported.iter_mut().enumerate() {
            let Some(last) = Silences::heard_at(place, &est.sampler) else { continue };
            let flagged = est.silences.vcu_tells(place, &est.sampler);
            let shown =
                (est.shows_comms_lost() || flagged) && est.silences.others_come(place, t, &est.sampler);
            let silent =
                t - last >= limit && shown || est.silences.is_silent(place, t, &est.sampler) == Truth::True;
            if silent && !std::mem::replace(reported, true) {
                report_missed(est, book, place, (t, last, limit));
            }
        }
    }

    /// 520h shows this: has it been so for too long?
    pub(super) fn due(&mut self, est: &mut Estimator, book: &mut Book, t: i64) {
        book.found(edge_due(est, t));
        book.found(edge_likely_due(est, t));
        book.found(self.missed_due(est, t));
        self.silence.judge(est, book, t);
    }

    /// 520h still says that communication is present: has a message been silent for too long?
    fn missed_due(&mut self, est: &Estimator, t: i64) -> Option<Finding> {
        let limit = est.silences.limit?;
        let shown = est.shows_comms_lost();
        if shown {
            self.shown_at = Some(t);
        }
        if est.silences.silent == Truth::False || shown || !est.vcu_is_seen() {
            self.reported_vcu = false;
            return None;
        }
        // It showed it a moment ago: the frame that ended the silence may be recorded behind the 520h that says so.
        let late = t - est.deadline;
        let just_shown = self.shown_at.is_some_and(|shown_at| t - shown_at <= est.window);
        let watching = est.silences.is_watching(late, est.known.of(Atom::Tsms));
        if just_shown || self.reported_vcu || watching != Truth::True || !est.sampler.is_fresh(AI_STATUS) {
            return None;
        }
        // Where 510h is silent itself, the handshake tells.
        let others = (0..WATCHED.len()).filter(|&place| WATCHED.get(place) != Some(&AI_STATUS));
        let place =
            { others }.find(|&place| est.silences.is_silent(place, late, &est.sampler) == Truth::True)?;
        let (index, last) = (*WATCHED.get(place)?, Silences::heard_at(place, &est.sampler)?);
        let def = est.sampler.def(index)?;
        self.reported_vcu = true;
        let silent = milliseconds(t - last);
        let seen =
            format!("AI_COMMS_LOST is 0, but {} ({:03X}h) has not come for {silent:.0} ms", def.name, def.id);
        let finding = Finding::violation(Party::Vcu, "2.4", Rule::CommsLostDue, last + limit + est.deadline)
            .against(&[MISSED])
            .seen(seen)
            .expected(format!("1 after {} ms", limit / MS));
        Some(finding.shown_by(est.sampler.last_frames(&[index, STATUS])))
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

/// In AS_OFF nothing drives yet.
fn by_state(est: &Estimator) -> Severity {
    if matches!(est.vcu.state, Some(AsState::Off) | None) { Severity::Warning } else { Severity::Violation }
}

fn and_raised(est: &Estimator) -> &'static str {
    if est.shows_comms_lost() { ", and the VCU has raised AI_COMMS_LOST" } else { "" }
}

/// The same of one message: 120h may tell of it as well, and is evidence then.
fn and_raised_of(est: &Estimator, place: usize, index: usize) -> (String, Vec<usize>) {
    let flag = TIMEOUTS.get(place).filter(|_| est.silences.vcu_tells(place, &est.sampler));
    match (flag, est.shows_comms_lost()) {
        (Some(field), false) => {
            (format!(", and the VCU has raised {}", name_of(est, field)), vec![index, VCU_STATUS])
        }
        (Some(_), true) => (and_raised(est).to_owned(), vec![index, VCU_STATUS]),
        (None, _) => (and_raised(est).to_owned(), vec![index]),
    }
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

fn report_missed(est: &Estimator, book: &mut Book, place: usize, (t, last, limit): (i64, i64, i64)) {
    let index = WATCHED.get(place).copied().unwrap_or_default();
    let Some(def) = est.sampler.def(index) else { return };
    book.margins.gap(index, t - last, t);
    let (silent, (raised, shows)) = (milliseconds(t - last), and_raised_of(est, place, index));
    let what = format!("{} ({:03X}h)", def.name, def.id);
    let cycle = est.edition.bus.cycle_requirements(def.id);
    let finding = Finding::new(by_state(est), Party::Ai, "2.4", Rule::MessageMissed, t.min(last + limit))
        .against(&[&[MISSED], cycle].concat())
        .seen(format!("{what} has not come for {silent:.0} ms while others have{raised}"))
        .expected(format!("it every {} ms, and no gap of {} ms", def.cycle_ms, limit / MS))
        .shown_by(est.sampler.last_frames(&shows));
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
