//! The reader of logs, on any bytes.

use std::io::{self, Read};

use adsdv_oracle::candump::{
    Direction, Dropped, Entry, FrameKind, MAX_LINE, Reader, Record, write_dropped, write_record,
};

/// A source that hands out as little at a time as it likes, and is interrupted now and then.
struct Drip<'a> {
    left: &'a [u8],
    most: usize,
    calls: usize,
}

impl Read for Drip<'_> {
    fn read(&mut self, room: &mut [u8]) -> io::Result<usize> {
        self.calls += 1;
        if self.calls.is_multiple_of(5) {
            return Err(io::ErrorKind::Interrupted.into());
        }
        let len = self.most.min(room.len()).min(self.left.len());
        let (now, later) = self.left.split_at(len);
        room[..len].copy_from_slice(now);
        self.left = later;
        Ok(len)
    }
}

/// An entry that has been kept.
#[derive(Clone, Debug, PartialEq)]
enum Kept {
    Frame {
        line: u64,
        time_ns: i64,
        interface: String,
        kind: FrameKind,
        id: u32,
        data: Vec<u8>,
        direction: Option<Direction>,
    },
    Dropped {
        line: u64,
        interface: String,
        count: u64,
        total: u64,
    },
    Broken {
        line: u64,
        error: String,
    },
}

impl Kept {
    fn of(entry: Entry<'_>) -> Self {
        match entry {
            Entry::Frame(Record { line, time_ns, interface, kind, id, data, direction, .. }) => {
                let (interface, data) = (interface.to_owned(), data.to_vec());
                Self::Frame { line, time_ns, interface, kind, id, data, direction }
            }
            Entry::Dropped(Dropped { line, interface, count, total }) => {
                Self::Dropped { line, interface: interface.to_owned(), count, total }
            }
            Entry::Broken(error) => Self::Broken { line: error.line, error: error.to_string() },
        }
    }

    /// The same in another line.
    fn at(&self, number: u64) -> Self {
        let mut other = self.clone();
        match &mut other {
            Self::Frame { line, .. } | Self::Dropped { line, .. } | Self::Broken { line, .. } => {
                *line = number;
            }
        }
        other
    }

    const fn line(&self) -> u64 {
        match self {
            Self::Frame { line, .. } | Self::Dropped { line, .. } | Self::Broken { line, .. } => *line,
        }
    }
}

/// Reads to the end.
fn read(source: impl Read) -> Vec<Kept> {
    let mut reader = Reader::new(source);
    let mut all = Vec::new();
    while let Some(entry) = reader.next_record().expect("the source does not fail") {
        all.push(Kept::of(entry));
    }
    assert!(all.iter().all(|entry| entry.line() <= reader.line()));
    all
}

/// What was read is written, and reads the same.
fn same_again(all: &[Kept]) {
    let mut log = Vec::new();
    let mut written = Vec::new();
    for entry in all {
        let before = log.len();
        let (result, interface, xl) = match entry {
            Kept::Frame { time_ns, interface, kind, id, data, direction, .. } => {
                let (line, time_ns, kind, id, direction) = (0, *time_ns, *kind, *id, *direction);
                let record = Record { line, time_ns, interface, kind, id, data, direction, terminated: true };
                (write_record(&mut log, &record), interface, kind == FrameKind::Xl)
            }
            Kept::Dropped { interface, count, total, .. } => {
                let dropped = Dropped { line: 0, interface, count: *count, total: *total };
                (write_dropped(&mut log, &dropped), interface, false)
            }
            Kept::Broken { error, .. } => {
                // Rubbish in a log does not reach a terminal.
                assert!(error.bytes().all(|byte| (b' '..=b'~').contains(&byte)), "{error:?}");
                continue;
            }
        };
        match result {
            Ok(()) => written.push(entry),
            // Of CAN XL a record does not keep all, and a log may name an interface longer than any that there is.
            Err(error) => {
                assert_eq!((error.kind(), log.len()), (io::ErrorKind::InvalidInput, before));
                assert!(xl || interface.len() > 15, "{entry:?}: {error}");
            }
        }
    }
    let again = read(log.as_slice());
    assert_eq!(again.len(), written.len());
    for (line, (again, entry)) in (1..).zip(again.into_iter().zip(written)) {
        assert_eq!(again, entry.at(line));
    }
}

/// The body. The first byte is how much the source hands out at a time.
pub fn body(bytes: &[u8]) {
    let Some((&most, log)) = bytes.split_first() else { return };
    let all = read(log);
    same_again(&all);
    let drip = Drip { left: log, most: usize::from(most) + 1, calls: 0 };
    assert_eq!(read(drip), all, "it does not matter in which pieces it is read");

    // Some editors put a mark before the first line. Nothing is lost: each line that is not blank is one entry, in order.
    let log = log.strip_prefix(b"\xef\xbb\xbf").unwrap_or(log);
    let mut lines: Vec<&[u8]> = log.split(|&byte| byte == b'\n').collect();
    if lines.last().is_some_and(|last| last.is_empty()) {
        lines.pop();
    }
    let blank = |line: &[u8]| line.len() <= MAX_LINE && line.iter().all(|byte| b" \t\r".contains(byte));
    let expected = (1..).zip(&lines).filter(|(_, line)| !blank(line)).map(|(number, _)| number);
    let lines: Vec<u64> = all.iter().map(Kept::line).collect();
    assert_eq!(lines, expected.collect::<Vec<u64>>());
}
