//! Messages of the AI Computer that are missed (section 2.4 of version 4.0), and what `AI_COMMS_LOST` has to say of them.

use adsdv_spec::{AsState, Atom, Truth};

use super::likely::no_frame;
use super::vcu_status::{TIMEOUTS, name_of};
use crate::judge::book::Book;
use crate::judge::estimator::base::Estimator;
use crate::judge::estimator::silences::{Silences, WATCHED, place_of};
use crate::judge::exercised::MISSED;
use crate::judge::finding::{Finding, Party, Rule, Severity};
use crate::judge::sampler::places::{AI_STATUS, STATUS, VCU_STATUS};
use crate::judge::time::{MS, milliseconds};

/// What is kept of it.
#[derive(Debug, Default)]
pub(super) struct Missed {
    /// Whether the silence of each message that is watched was reported.
    reported: [bool; WATCHED.len()],
    /// Whether it was reported that the VCU does not show it, for certain or by all that was recorded, and when the VCU last showed it.
    reported_vcu: bool,
    warned_vcu: bool,
    shown_at: Option<i64>,
    /// Since when 520h has shown TSMS on, in every frame that was recorded.
    on_since: Option<i64>,
}

impl Missed {
    /// A message that is watched came.
    pub(super) fn heard(&mut self, place: usize) {
        if let Some(reported) = self.reported.get_mut(place) {
            *reported = false;
        }
    }

    /// Whether it was reported that this message is missing.
    pub(super) fn is(&self, index: usize) -> bool {
        place_of(index).and_then(|place| self.reported.get(place)).is_some_and(|reported| *reported)
    }

    /// Whether it was reported of any.
    pub(super) fn is_any(&self) -> bool {
        self.reported.contains(&true)
    }

    /// Is the AI Computer at fault, because a message of it has been silent?
    pub(super) fn judge(&mut self, est: &Estimator, book: &mut Book, t: i64) {
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
                report(est, book, place, (t, last, limit), None);
            }
        }
    }

    /// 520h still says that communication is present: has a message been silent for too long?
    pub(super) fn due(&mut self, est: &Estimator, book: &mut Book, t: i64) {
        let Some(limit) = est.silences.limit else { return };
        let on = est.vcu.status.is_some_and(|status| status.ts_switch_status);
        self.on_since = if on { self.on_since.or(Some(t)) } else { None };
        let shown = est.shows_comms_lost();
        if shown {
            self.shown_at = Some(t);
        }
        if est.silences.silent == Truth::False || shown || !est.vcu_is_seen() {
            (self.reported_vcu, self.warned_vcu) = (false, false);
            return;
        }
        // It showed it a moment ago: the frame that ended the silence may be recorded behind the 520h that says so.
        let late = t - est.deadline;
        if self.reported_vcu || self.shown_at.is_some_and(|shown_at| t - shown_at <= est.window) {
            return;
        }
        let watching = est.silences.is_watching(late, est.known.of(Atom::Tsms)) == Truth::True;
        let is_silent = |place: &usize| est.silences.is_silent(*place, late, &est.sampler) == Truth::True;
        if watching
            && est.sampler.is_fresh(AI_STATUS)
            && let Some(place) = others().find(is_silent)
        {
            self.reported_vcu = true;
            return book.found(not_shown(est, place, (t, limit), None));
        }
        self.likely_due(est, book, (t, limit));
    }

    /// The same by all that was recorded: where the recorder loses frames, it may have lost these.
    fn likely_due(&mut self, est: &Estimator, book: &mut Book, (t, limit): (i64, i64)) {
        let late = t - est.deadline;
        let heard = est.sampler.last(AI_STATUS).is_some_and(|at| t - at <= est.window);
        let watching = self.on_since.is_some_and(|since| late - since >= limit + est.window);
        // It showed it: the frames that ended the silence may be the ones that were lost.
        let just_shown = self.shown_at.is_some_and(|shown_at| t - shown_at <= est.long_patience());
        if est.options.complete || self.warned_vcu || just_shown || !heard || !watching {
            return;
        }
        let is_silent = |place: &usize| est.silences.seems_silent(*place, late, &est.sampler) == Truth::True;
        let Some(place) = others().find(is_silent) else { return };
        self.warned_vcu = true;
        let id = WATCHED.get(place).and_then(|&index| est.sampler.id(index));
        let Some((last, id)) = Silences::heard_at(place, &est.sampler).zip(id) else { return };
        let excuse = format!("frames were lost ({})", no_frame(id, last, t));
        if self.reported.get(place) == Some(&false) {
            report(est, book, place, (t, last, limit), Some(&excuse));
        }
        book.found(not_shown(est, place, (t, limit), Some(&excuse)));
    }

    /// The VCU was silent for long.
    pub(super) fn vcu_was_silent(&mut self) {
        self.on_since = None;
    }
}

/// The messages that are watched but for 510h: where that is silent itself, the handshake tells.
fn others() -> impl Iterator<Item = usize> {
    (0..WATCHED.len()).filter(|&place| WATCHED.get(place) != Some(&AI_STATUS))
}

/// In AS_OFF nothing drives yet.
pub(super) fn by_state(est: &Estimator) -> Severity {
    if matches!(est.vcu.state, Some(AsState::Off) | None) { Severity::Warning } else { Severity::Violation }
}

/// What the VCU says of it.
pub(super) fn and_raised(est: &Estimator) -> &'static str {
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

/// This message has not come for too long, unless there is this excuse.
fn report(
    est: &Estimator,
    book: &mut Book,
    place: usize,
    (t, last, limit): (i64, i64, i64),
    excuse: Option<&str>,
) {
    let index = WATCHED.get(place).copied().unwrap_or_default();
    let Some(def) = est.sampler.def(index) else { return };
    if excuse.is_none() {
        book.margins.gap(index, t - last, t);
    }
    let (silent, (raised, shows)) = (milliseconds(t - last), and_raised_of(est, place, index));
    let what = format!("{} ({:03X}h)", def.name, def.id);
    let cycle = est.edition.bus.cycle_requirements(def.id);
    let severity = if excuse.is_some() { Severity::Warning } else { by_state(est) };
    let finding = Finding::new(severity, Party::Ai, "2.4", Rule::MessageMissed, t.min(last + limit))
        .against(&[&[MISSED], cycle].concat())
        .seen(format!("{what} has not come for {silent:.0} ms while others have{raised}"))
        .expected(format!("it every {} ms, and no gap of {} ms", def.cycle_ms, limit / MS))
        .shown_by(est.sampler.last_frames(&shows));
    book.found(finding.unless(excuse.unwrap_or_default()));
}

/// The message has not come for too long, unless there is this excuse, and 520h says that communication is present.
fn not_shown(est: &Estimator, place: usize, (t, limit): (i64, i64), excuse: Option<&str>) -> Option<Finding> {
    let (index, last) = (*WATCHED.get(place)?, Silences::heard_at(place, &est.sampler)?);
    let def = est.sampler.def(index)?;
    let silent = milliseconds(t - last);
    let seen =
        format!("AI_COMMS_LOST is 0, but {} ({:03X}h) has not come for {silent:.0} ms", def.name, def.id);
    let severity = if excuse.is_some() { Severity::Warning } else { Severity::Violation };
    let finding = Finding::new(severity, Party::Vcu, "2.4", Rule::CommsLostDue, last + limit + est.deadline)
        .against(&[MISSED])
        .seen(seen)
        .expected(format!("1 after {} ms", limit / MS))
        .shown_by(est.sampler.last_frames(&[index, STATUS]));
    Some(finding.unless(excuse.unwrap_or_default()))
}
