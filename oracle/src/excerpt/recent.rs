//! The last seconds of a log that is read, in bounded memory.

use std::collections::VecDeque;

use crate::candump::{Entry, write_dropped, write_record};

/// So much is kept: the widest excerpt, what follows a finding, and what is heard before it is known by which edition to judge.
const KEPT_NS: i64 = 40_000_000_000;
/// So many lines are kept: half a minute of a bus of 500 kbit/s.
const MOST: usize = 150_000;

/// What was read in the last seconds.
#[derive(Debug, Default)]
pub(super) struct Recent {
    lines: VecDeque<LogLine>,
    /// The time of the first frame by the clock of the log.
    origin: Option<i64>,
    /// The last time that was given.
    now: i64,
}

/// A line of the log.
#[derive(Clone, Debug)]
pub(super) struct LogLine {
    /// When, by the time that the judge gives it.
    pub(super) t_ns: i64,
    /// The identifier, if it is a frame.
    pub(super) id: Option<u32>,
    /// As candump writes it.
    pub(super) text: Box<[u8]>,
}

impl Recent {
    /// Keeps what was read; `judged_at`: the time that the judge gave it, if it judges already.
    pub(super) fn keep(&mut self, judged_at: Option<i64>, entry: &Entry<'_>) {
        let mut text = Vec::new();
        let mut id = None;
        let written = match entry {
            Entry::Frame(record) => {
                id = Some(record.id);
                let origin = *self.origin.get_or_insert(record.time_ns);
                // As long as nothing is judged, the clock of the log is the judge's, unless it is set back.
                let t = judged_at.unwrap_or_else(|| record.time_ns.saturating_sub(origin));
                self.now = self.now.max(t);
                let written = write_record(&mut text, record);
                if !record.terminated {
                    text.pop();
                }
                written
            }
            Entry::Dropped(dropped) => write_dropped(&mut text, dropped),
            Entry::Broken(error) => {
                // Of a broken line there is what was found where it breaks; before that goes what breaks it as well.
                if error.column > 1 {
                    text.extend_from_slice(b"... ");
                }
                text.extend_from_slice(error.found.as_bytes());
                text.push(b'\n');
                Ok(())
            }
        };
        // A frame of CAN XL cannot be written, and is not judged either.
        if written.is_ok() {
            self.lines.push_back(LogLine { t_ns: self.now, id, text: text.into_boxed_slice() });
        }
        let old = |line: &LogLine| line.t_ns < self.now - KEPT_NS;
        while self.lines.len() > MOST || self.lines.front().is_some_and(old) {
            self.lines.pop_front();
        }
    }

    /// The lines of some time.
    pub(super) fn between(&self, from: i64, until: i64) -> Vec<LogLine> {
        let begin = self.lines.partition_point(|line| line.t_ns < from);
        let end = self.lines.partition_point(|line| line.t_ns <= until);
        self.lines.range(begin.min(end)..end).cloned().collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::candump::Reader;

    fn kept(log: &str) -> Recent {
        let (mut recent, mut reader) = (Recent::default(), Reader::new(log.as_bytes()));
        while let Ok(Some(entry)) = reader.next_record() {
            recent.keep(None, &entry);
        }
        recent
    }

    #[test]
    fn lines_are_kept_as_they_are_and_for_a_while() {
        let log = "(1000000001.000000) can0 520#01\nrubbish\nDROPCOUNT: dropped 1 CAN frame on 'can0' socket (total drops 1)\n(1000000001.500000) can0 18FF50E5#R3 T\n(1000000002.000000) can0 520#02";
        let recent = kept(log);
        let text: Vec<u8> =
            recent.between(0, 1_000_000_000).iter().flat_map(|line| line.text.to_vec()).collect();
        assert_eq!(String::from_utf8(text).as_deref(), Ok(log));
        let ids: Vec<_> = recent.between(400_000_000, 600_000_000).iter().map(|line| line.id).collect();
        assert_eq!(ids, [Some(0x18FF_50E5)]);
        assert_eq!(kept(&format!("{log}\n(1000000060.0) can0 520#03\n")).lines.len(), 1);
    }

    #[test]
    fn lines_are_bounded() {
        let log = "(1.0) can0 520#\n".repeat(MOST + 10);
        assert_eq!(kept(&log).lines.len(), MOST);
    }
}
