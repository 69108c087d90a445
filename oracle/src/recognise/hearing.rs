//! What comes before it is known by which edition to judge: it is kept, and told again.

use adsdv_spec::Edition;

use super::later::Later;
use super::{Recognised, Recogniser};
use crate::candump::{Direction, Dropped, FrameKind, LineError, Record};

/// After this time enough has been heard: ten frames of the slowest message.
const LONG_ENOUGH_NS: i64 = 1_000_000_000;

/// After so many frames as well, several times what a bus carries in that time: the log's clock may stand.
const ENOUGH: usize = 10_000;

/// What was heard so far.
#[derive(Debug)]
pub(crate) struct Hearing {
    recogniser: Recogniser,
    /// The interface that is judged, once it is known.
    interface: Option<String>,
    /// The time of the first frame.
    began: Option<i64>,
    held: Vec<Held>,
}

/// Something that happened, kept.
#[derive(Debug)]
pub(crate) enum Held {
    Frame(HeldFrame),
    TimePasses(i64),
    Lost(u64),
    Dropped { line: u64, interface: String, count: u64, total: u64 },
    Broken(LineError),
}

/// A frame of a log, kept.
#[derive(Debug)]
pub(crate) struct HeldFrame {
    line: u64,
    time_ns: i64,
    interface: String,
    kind: FrameKind,
    id: u32,
    data: Vec<u8>,
    direction: Option<Direction>,
    terminated: bool,
}

impl HeldFrame {
    pub(crate) fn record(&self) -> Record<'_> {
        let Self { line, time_ns, ref interface, kind, id, ref data, direction, terminated } = *self;
        Record { line, time_ns, interface, kind, id, data, direction, terminated }
    }
}

impl Held {
    pub(crate) fn frame(record: &Record<'_>) -> Self {
        let Record { line, time_ns, interface, kind, id, data, direction, terminated } = *record;
        let (interface, data) = (interface.to_owned(), data.to_owned());
        Self::Frame(HeldFrame { line, time_ns, interface, kind, id, data, direction, terminated })
    }

    pub(crate) fn dropped(dropped: &Dropped<'_>) -> Self {
        let Dropped { line, interface, count, total } = *dropped;
        Self::Dropped { line, interface: interface.to_owned(), count, total }
    }
}

impl Hearing {
    pub(crate) fn new(default: &'static Edition, interface: Option<String>) -> Self {
        Self { recogniser: Recogniser::new(default), interface, began: None, held: Vec::new() }
    }

    /// Whether a frame was heard, of whatever kind.
    pub(crate) fn has_frame(&self) -> bool {
        self.began.is_some()
    }

    /// Something happened. Tells whether enough has been heard.
    pub(crate) fn hear(&mut self, held: Held) -> bool {
        let now = match &held {
            Held::Frame(frame) => {
                self.listen(&frame.record());
                Some(frame.time_ns)
            }
            Held::TimePasses(time_ns) => Some(*time_ns),
            _ => None,
        };
        self.held.push(held);
        let long = match (self.began, now) {
            (Some(began), Some(now)) => now.saturating_sub(began) >= LONG_ENOUGH_NS,
            _ => false,
        };
        long || self.held.len() >= ENOUGH
    }

    fn listen(&mut self, record: &Record<'_>) {
        self.began.get_or_insert(record.time_ns);
        if record.kind != FrameKind::Standard {
            return;
        }
        if self.interface.is_none() && self.recogniser.knows(record.id) {
            self.interface = Some(record.interface.to_owned());
        }
        if self.interface.as_deref() == Some(record.interface) {
            self.recogniser.frame(record.time_ns, record.id, record.data);
        }
    }

    /// What was recognised, what is to be told again, and what looks at the frames behind that.
    pub(crate) fn end(self) -> (Recognised, Vec<Held>, Later) {
        (self.recogniser.recognise(), self.held, Later::new(self.recogniser))
    }
}
