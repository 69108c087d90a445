//! Which frames are judged, and why others are not.

use adsdv_spec::messages::Node;

use super::LogJudge;
use crate::candump::{Direction, FrameKind, Record};
use crate::judge::Rule;
use crate::recognise::Held;

/// A log can name any number of interfaces; the first few tell enough.
const MAX_INTERFACES: usize = 64;

impl LogJudge {
    /// Whether a frame has come, of whatever kind.
    pub(super) fn has_frame(&self) -> bool {
        self.frames > 0 || self.hearing.as_ref().is_some_and(|hearing| hearing.has_frame())
    }

    /// Judges a frame, of whatever kind.
    #[inline]
    pub fn frame(&mut self, record: &Record<'_>) {
        if self.hearing.is_some() && self.still_hears(record.time_ns) {
            return self.hear(Held::frame(record));
        }
        self.frames += 1;
        let t = record.time_ns.saturating_sub(*self.origin.get_or_insert(record.time_ns));
        let ours = match &self.interface {
            Some(interface) => interface == record.interface,
            None => self.choose(record),
        };
        if !ours || record.kind != FrameKind::Standard {
            return self.pass_over(t, record, ours);
        }
        self.on_interface += 1;
        if !record.terminated && self.is_cut_off(record) {
            return self.cut_off(t, record);
        }
        if record.direction.is_some() && self.forged(t, record) {
            return;
        }
        self.judge.frame(t, record.id, record.data);
        if let Some(collector) = &mut self.collector {
            collector.frame(&self.judge, record.id, record.data);
        }
        if let Some(later) = &mut self.later
            && let Some(other) = later.frame(record.id, record.data, self.judge.edition().version)
        {
            self.fits_another(&other);
        }
    }

    /// The first interface that carries a message of the document is the one to judge.
    #[cold]
    fn choose(&mut self, record: &Record<'_>) -> bool {
        if self.is_known(record) {
            self.interface = Some(record.interface.to_owned());
        }
        true
    }

    #[cold]
    fn pass_over(&mut self, t: i64, record: &Record<'_>, ours: bool) {
        self.judge.other_frame(t);
        if !ours && self.is_known(record) && self.neglected.len() < MAX_INTERFACES {
            self.neglected.insert(record.interface.to_owned());
        }
        let reason = match record.kind {
            _ if !ours => format!("on interface {}", record.interface),
            FrameKind::Standard => return,
            FrameKind::Extended => "with an extended identifier".to_owned(),
            FrameKind::Remote { .. } => "of the remote kind".to_owned(),
            FrameKind::Error => "of the error kind".to_owned(),
            FrameKind::Fd { .. } => "of CAN FD".to_owned(),
            FrameKind::Xl => "of CAN XL".to_owned(),
        };
        if self.passed_over.len() < MAX_INTERFACES || self.passed_over.contains_key(&reason) {
            *self.passed_over.entry(reason).or_default() += 1;
        } else {
            *self.passed_over.entry("on further interfaces".to_owned()).or_default() += 1;
        }
    }

    #[cold]
    fn cut_off(&mut self, t: i64, record: &Record<'_>) {
        self.judge.other_frame(t);
        let message = format!(
            "line {}: the log ends in the middle of frame {:03X}h; expected a line feed at its end",
            record.line, record.id
        );
        self.warn(Rule::BrokenLine, message);
    }

    /// Uses the direction of a frame: whether the log was recorded by the AI Computer, and sent by it what only others
    /// may send. Such a frame is the AI Computer's fault, and says nothing about the VCU.
    #[cold]
    fn forged(&mut self, t: i64, record: &Record<'_>) -> bool {
        let Ok(id) = u16::try_from(record.id) else { return false };
        self.directions.count(id, record.direction);
        let forged = self.directions.recorded_by_ai()
            && record.direction == Some(Direction::Tx)
            && !self.judge.edition().bus.may_send(Node::Ai, id);
        if forged {
            self.judge.sent_by_ai(t, record.id);
        }
        forged
    }

    /// Whether a frame has the identifier of a message of the document.
    fn is_known(&self, record: &Record<'_>) -> bool {
        self.judge.message(record.id).is_some() && record.kind == FrameKind::Standard
    }

    /// Whether a frame lacks data that its message has.
    fn is_cut_off(&self, record: &Record<'_>) -> bool {
        self.judge.message(record.id).is_some_and(|def| record.data.len() < def.bytes_needed())
    }
}
