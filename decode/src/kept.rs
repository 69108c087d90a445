//! What came before the edition was known: kept, and decoded then.

use adsdv_oracle::candump::{Direction, Dropped, Entry, FrameKind, LineError, Record};

/// An entry of a recording, kept.
#[derive(Debug)]
pub(crate) enum Kept {
    Frame {
        line: u64,
        time_ns: i64,
        interface: String,
        kind: FrameKind,
        id: u32,
        data: Vec<u8>,
        direction: Option<Direction>,
        terminated: bool,
    },
    Dropped {
        line: u64,
        interface: String,
        count: u64,
        total: u64,
    },
    Broken(LineError),
}

impl Kept {
    pub(crate) fn of(entry: &Entry<'_>) -> Self {
        match *entry {
            Entry::Frame(Record { line, time_ns, interface, kind, id, data, direction, terminated }) => {
                let (interface, data) = (interface.to_owned(), data.to_owned());
                Self::Frame { line, time_ns, interface, kind, id, data, direction, terminated }
            }
            Entry::Dropped(Dropped { line, interface, count, total }) => {
                Self::Dropped { line, interface: interface.to_owned(), count, total }
            }
            Entry::Broken(error) => Self::Broken(error),
        }
    }

    pub(crate) fn entry(&self) -> Entry<'_> {
        match *self {
            Self::Frame { line, time_ns, ref interface, kind, id, ref data, direction, terminated } => {
                Entry::Frame(Record { line, time_ns, interface, kind, id, data, direction, terminated })
            }
            Self::Dropped { line, ref interface, count, total } => {
                Entry::Dropped(Dropped { line, interface, count, total })
            }
            Self::Broken(error) => Entry::Broken(error),
        }
    }
}
