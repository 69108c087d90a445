//! The readers of recordings, on any bytes: every format, and what is around it.

use std::io::{Cursor, Read};

use adsdv_formats::{Entries as _, Entry, open};
use adsdv_oracle::candump::FrameKind;

/// More entries than any input of a fuzzer has frames; what is compressed may go on for long.
const MANY: usize = 100_000;

/// Reads the bytes as a recording: every entry makes sense, they come in order, and the same come from a source that gives single bytes.
pub fn body(bytes: &[u8]) {
    let whole = read(Cursor::new(bytes.to_vec()));
    if bytes.len() < 4096 {
        assert_eq!(read(ByteByByte(Cursor::new(bytes.to_vec()))), whole);
    }
}

/// What came of it: each entry in words, and how it ended.
fn read(source: impl Read + Send + 'static) -> Vec<String> {
    let mut log = match open(source) {
        Ok(log) => log,
        Err(error) => return vec![error.to_string()],
    };
    let (mut all, mut last) = (vec![log.format().to_string()], 0);
    while all.len() < MANY {
        let entry = match log.next_entry() {
            Ok(Some(entry)) => entry,
            Ok(None) => break,
            Err(error) => {
                all.push(error.to_string());
                break;
            }
        };
        let line = match &entry {
            Entry::Frame(record) => {
                assert!(record.time_ns >= 0 && record.id <= record.kind.max_id(), "{record:?}");
                assert!(!record.interface.is_empty(), "{record:?}");
                let most = match record.kind {
                    FrameKind::Remote { .. } => 0,
                    FrameKind::Fd { .. } => 64,
                    FrameKind::Xl => 2048,
                    _ => 8,
                };
                assert!(record.data.len() <= most, "{record:?}");
                record.line
            }
            Entry::Dropped(dropped) => dropped.line,
            Entry::Broken(error) => {
                // Rubbish in a recording does not reach a terminal.
                let text = error.to_string();
                assert!(text.bytes().all(|byte| (b' '..=b'~').contains(&byte)), "{text:?}");
                error.line
            }
        };
        assert!(line >= last, "{line} comes behind {last}");
        last = line;
        all.push(format!("{entry:?}"));
    }
    all
}

/// A source that gives a byte at a time.
struct ByteByByte(Cursor<Vec<u8>>);

impl Read for ByteByByte {
    fn read(&mut self, room: &mut [u8]) -> std::io::Result<usize> {
        self.0.read(room.get_mut(..1).unwrap_or_default())
    }
}
