//! Missed messages: whether one of the AI Computer's has been silent for too long (section 2.4 of version 4.0).
//!
//! A recorder loses frames as well. So a silence that is about as long as the limit, give or take the window, may be one or
//! not; and that nothing at all comes from the AI Computer may be the recorder's doing: what becomes of that is told by the
//! handshake.

use adsdv_spec::{AsState, Atom, Choice, Reading, Truth};

use super::events::milliseconds;
use super::exercised::MISSED;
use super::finding::{Finding, Party, Rule, Severity};
use super::{AI_BRAKE, AI_DRIVE_F, AI_DRIVE_R, AI_STATUS, AI_STEER, Judge, MS, STATUS};

/// The messages that are watched.
const WATCHED: [usize; 5] = [AI_STATUS, AI_DRIVE_F, AI_DRIVE_R, AI_STEER, AI_BRAKE];

/// Whether a message is watched.
pub(super) fn is_watched(index: usize) -> bool {
    WATCHED.contains(&index)
}

/// What is kept of the messages that are watched.
#[derive(Debug)]
pub(super) struct Missed {
    /// When the last frame of each came that nobody can refuse.
    valid_at: [Option<i64>; WATCHED.len()],
    /// Whether the silence of each was reported.
    reported: [bool; WATCHED.len()],
    /// Whether it was reported that the VCU does not tell of it.
    reported_vcu: bool,
    /// When the VCU last told of it.
    told_at: Option<i64>,
    /// Since when TSMS is known to have been on.
    on_since: Option<i64>,
    /// Whether any has been silent for too long, when that was looked at last.
    silent: Truth,
}

impl Default for Missed {
    fn default() -> Self {
        Self {
            valid_at: [None; WATCHED.len()],
            reported: [false; WATCHED.len()],
            reported_vcu: false,
            told_at: None,
            on_since: None,
            silent: Truth::Unknown,
        }
    }
}

impl Missed {
    /// The VCU's frames stopped: whether the switch stayed on is not known.
    pub(super) fn vcu_gone(&mut self) {
        self.on_since = None;
    }
}

impl Judge {
    /// How long a message may be silent, in nanoseconds; `None` where the edition has no such rule.
    fn missed_limit(&self) -> Option<i64> {
        Some(i64::from(self.edition.rules.thresholds.missed_ms?) * MS)
    }

    /// A frame came, and all else that it says is known.
    #[inline]
    pub(super) fn ends_silence(&mut self, index: usize, t: i64) {
        let Some(place) = WATCHED.iter().position(|&watched| watched == index) else { return };
        if self.missed_limit().is_none() {
            return;
        }
        let Some(slot) = self.slots.get(index) else { return };
        // A VCU may refuse a frame with a value out of range, or of another length than the edition's.
        let valid = slot.fresh && slot.bad == 0 && slot.def.is_some_and(|def| def.len == slot.len);
        if let (true, Some(at)) = (valid, self.missed.valid_at.get_mut(place)) {
            *at = Some(t);
        }
        if let Some(reported) = self.missed.reported.get_mut(place) {
            *reported = false;
        }
        if self.missed.silent != Truth::False {
            self.update_comms(t);
        }
    }

    /// Whether it was reported that this message is missing.
    pub(super) fn is_reported_missed(&self, index: usize) -> bool {
        let place = WATCHED.iter().position(|&watched| watched == index);
        place.and_then(|place| self.missed.reported.get(place)).is_some_and(|reported| *reported)
    }

    /// Whether a message may have been silent for too long, when that was looked at last.
    pub(super) fn is_silent_message(&self) -> bool {
        self.missed.silent != Truth::False
    }

    /// When a frame of a watched message came last.
    fn heard_at(&self, place: usize) -> Option<i64> {
        self.slots.get(*WATCHED.get(place)?)?.last
    }

    /// Whether another message of the AI Computer comes, so that it is not the recorder that hears nothing.
    fn others_come(&self, place: usize, t: i64, within: i64) -> bool {
        let others = (0..WATCHED.len()).filter(|&other| other != place);
        others.filter_map(|other| self.heard_at(other)).any(|last| t - last < within)
    }

    /// Whether the recorder is taken to lose frames of a message: a single one between two silences may be among them.
    fn loses_frames(&self, place: usize) -> bool {
        WATCHED.get(place).and_then(|&index| self.slots.get(index)).is_some_and(super::Slot::is_lossy)
    }

    /// Whether a message has been silent for too long. One that was never heard may have been left out by the recorder.
    fn is_silent(&self, place: usize, t: i64, limit: i64) -> Truth {
        let (sure, window) = (limit - self.window, self.window);
        match (self.missed.valid_at.get(place), self.heard_at(place)) {
            (Some(Some(valid)), _) if t - valid < sure => Truth::False,
            (_, Some(last)) if t - last < limit + window || self.loses_frames(place) => Truth::Unknown,
            (_, Some(_)) if self.others_come(place, t, sure) => Truth::True,
            _ => Truth::Unknown,
        }
    }

    /// Whether a VCU watches the messages, and has for long enough. One that does not yet may from its next step on, and a
    /// silence counts from before that.
    //= D-52
    fn is_watching(&self, t: i64, limit: i64) -> Truth {
        let always = self.pinned(Reading::MessageWatch) == Some(Choice::WatchAlways);
        let handshake = self.pinned(Reading::HandshakeActive);
        let only_then = self.pinned(Reading::MessageWatch) == Some(Choice::WatchHandshake);
        let on_for = self.missed.on_since.map(|since| t - since);
        match self.known.of(Atom::Tsms) {
            _ if always || only_then && handshake == Some(Choice::HandshakeAlways) => Truth::True,
            Truth::True if on_for.is_some_and(|on_for| on_for >= limit + self.window) => Truth::True,
            _ => Truth::Unknown,
        }
    }

    /// Whether communication is lost because a message is missed.
    pub(super) fn is_missed(&mut self, t: i64) -> Truth {
        let Some(limit) = self.missed_limit() else { return Truth::False };
        if self.known.of(Atom::Tsms) == Truth::True {
            self.missed.on_since.get_or_insert(t);
        } else {
            self.missed.on_since = None;
        }
        let each = (0..WATCHED.len()).map(|place| self.is_silent(place, t, limit));
        self.missed.silent = each.fold(Truth::False, Truth::or);
        self.is_watching(t, limit).and(self.missed.silent)
    }

    /// When a silence changes what is known.
    pub(super) fn missed_event(&self) -> i64 {
        let Some(limit) = self.missed_limit() else { return i64::MAX };
        let (sure, certain) = (limit - self.window, limit + self.window);
        let valid = self.missed.valid_at.iter().flatten().map(|at| at + sure);
        let heard = (0..WATCHED.len()).filter_map(|place| self.heard_at(place)).map(|at| at + certain);
        let on = self.missed.on_since.map(|at| at + certain);
        valid.chain(heard).chain(on).filter(|&at| at > self.comms_known_at).min().unwrap_or(i64::MAX)
    }

    /// Time has passed, or the VCU says that communication is lost: is the AI Computer at fault?
    pub(super) fn judge_missed(&mut self, t: i64) {
        let Some(limit) = self.missed_limit() else { return };
        if self.missed.silent == Truth::False || self.is_watching(t, limit) != Truth::True {
            return;
        }
        let told = self.vcu.shows_comms_lost();
        for place in 0..WATCHED.len() {
            let Some(last) = self.heard_at(place) else { continue };
            let silent = t - last >= limit && told && self.others_come(place, t, limit - self.window)
                || self.is_silent(place, t, limit) == Truth::True;
            let reported = self.missed.reported.get_mut(place).filter(|_| silent);
            if reported.is_some_and(|reported| !std::mem::replace(reported, true)) {
                self.report_missed(place, t, last, limit);
            }
        }
    }

    fn report_missed(&mut self, place: usize, t: i64, last: i64, limit: i64) {
        let def = WATCHED.get(place).and_then(|&index| self.slots.get(index)?.def);
        let Some(def) = def else { return };
        if let Some(&index) = WATCHED.get(place) {
            self.margins.gap(index, t - last, t);
        }
        let told = if self.vcu.shows_comms_lost() { ", and the VCU has raised AI_COMMS_LOST" } else { "" };
        // In AS_OFF nothing drives yet.
        let off = matches!(self.vcu.state, Some(AsState::Off) | None);
        let severity = if off { Severity::Warning } else { Severity::Violation };
        let finding = Finding::new(severity, Party::Ai, "2.4", Rule::MessageMissed, t.min(last + limit))
            .seen(format!(
                "{} ({:03X}h) has not come for {:.0} ms while others have{told}",
                def.name,
                def.id,
                milliseconds(t - last)
            ))
            .expected(format!("it every {} ms, and no gap of {} ms", def.cycle_ms, limit / MS))
            .shown_by(WATCHED.get(place).map_or(Vec::new(), |&index| self.last_frames(&[index])));
        self.found(finding);
    }

    /// 520h still says that communication is present: has a message been silent for too long?
    pub(super) fn missed_due(&mut self, t: i64) {
        let Some(limit) = self.missed_limit() else { return };
        let told = self.vcu.shows_comms_lost();
        if told {
            self.missed.told_at = Some(t);
        }
        if self.missed.silent == Truth::False || told || !self.vcu_is_seen() {
            self.missed.reported_vcu = false;
            return;
        }
        // It told of it a moment ago: the frame that ended the silence may be recorded behind the 520h that says so.
        if self.missed.told_at.is_some_and(|told_at| t - told_at <= self.window) {
            return;
        }
        let late = t - self.deadline;
        if self.missed.reported_vcu || self.is_watching(late, limit) != Truth::True {
            return;
        }
        // Where 510h is silent itself, the handshake tells.
        let others = (0..WATCHED.len()).filter(|&place| WATCHED.get(place) != Some(&AI_STATUS));
        let due = others.filter(|&place| self.is_silent(place, late, limit) == Truth::True);
        let answers = self.slots.get(AI_STATUS).is_some_and(|slot| slot.fresh);
        let Some((place, last)) = { due }.find_map(|place| Some((place, self.heard_at(place)?))) else {
            return;
        };
        let def = WATCHED.get(place).and_then(|&index| self.slots.get(index)?.def).filter(|_| answers);
        let Some(def) = def else { return };
        self.missed.reported_vcu = true;
        let t_ns = last + limit + self.deadline;
        let finding = Finding::violation(Party::Vcu, "2.4", Rule::CommsLostDue, t_ns)
            .against(&[MISSED])
            .seen(format!(
                "AI_COMMS_LOST is 0, but {} ({:03X}h) has not come for {:.0} ms",
                def.name,
                def.id,
                milliseconds(t - last)
            ))
            .expected(format!("1 after {} ms", limit / MS))
            .shown_by(WATCHED.get(place).map_or(Vec::new(), |&index| self.last_frames(&[index, STATUS])));
        self.found(finding);
    }
}
