//! What comes before it is known by which edition to judge: it is kept, and replayed to the judge.

use adsdv_spec::Edition;

use super::later::Later;
use super::{Recognised, Recogniser};
use crate::candump::{Direction, Dropped, FrameKind, LineError, Record};

/// After this time the frames may have shown enough, and after each further such time: ten frames of the slowest message.
const LOOK_NS: i64 = 1_000_000_000;

/// After this time it is decided, whatever they have shown: who looks at a live bus waits for it.
const LONGEST_NS: i64 = 10 * LOOK_NS;

/// After so many frames as well, several times what tells enough: the log's clock may stand.
const ENOUGH: usize = 10_000;

/// What was heard so far.
#[derive(Debug)]
pub(crate) struct Hearing {
    recogniser: Recogniser,
    /// The interface that is judged, once it is known.
    interface: Option<String>,
    /// The time of the first frame.
    began: Option<i64>,
    /// So long after it, it is seen next whether the frames have shown enough.
    look_ns: i64,
    held: Vec<Held>,
    /// How many of those are no passing of time.
    count: usize,
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
        let recogniser = Recogniser::new(default);
        Self { recogniser, interface, began: None, look_ns: LOOK_NS, held: Vec::new(), count: 0 }
    }

    /// Whether a frame was heard, of whatever kind.
    pub(crate) fn has_frame(&self) -> bool {
        self.began.is_some()
    }

    /// Whether enough has been heard before this time. A frame of this time is not part of it, so that silence up to then and
    /// that frame come to the same: a live bus is judged like its recording.
    pub(crate) fn is_enough_before(&mut self, time_ns: i64) -> bool {
        let Some(lasted) = self.began.map(|began| time_ns.saturating_sub(began)) else { return false };
        if lasted < self.look_ns {
            return false;
        }
        self.look_ns = (lasted - lasted % LOOK_NS).saturating_add(LOOK_NS);
        lasted >= LONGEST_NS || self.recogniser.recognise().certain
    }

    /// Something happened. Tells whether that is so much that enough has been heard.
    pub(crate) fn hear(&mut self, held: Held) -> bool {
        match (&held, self.held.last_mut()) {
            // Silence is reported again and again, and the last time says it all.
            (Held::TimePasses(now), Some(Held::TimePasses(before))) => *before = (*before).max(*now),
            (Held::TimePasses(_), _) => self.held.push(held),
            (Held::Frame(frame), _) => {
                self.listen(&frame.record());
                self.keep(held);
            }
            _ => self.keep(held),
        }
        self.count >= ENOUGH
    }

    fn keep(&mut self, held: Held) {
        self.held.push(held);
        self.count += 1;
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

    /// What was recognised, what the judge has to hear again, and what looks at the frames behind that.
    pub(crate) fn end(self) -> (Recognised, Vec<Held>, Later) {
        (self.recogniser.recognise(), self.held, Later::new(self.recogniser))
    }
}
