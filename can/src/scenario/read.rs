//! Reads a file line by line, in memory that does not grow with what is wrong with it, and tells everything that is wrong.

use std::io::{self, BufRead};

use super::error::{LineError, MAX_ERRORS, Unreadable};
use super::parse::Lines;
use super::{Line, Scenario};

/// The longest line that is read, in bytes; a longer one is passed over, and reported.
pub const MAX_LINE: usize = 4096;

/// The most lines that say something.
const MAX_LINES: usize = 100_000;

/// The longest scenario that is read, in bytes. Without a limit, a source without end would never be refused.
pub const MAX_BYTES: u64 = 4 << 20;

impl Scenario {
    /// Reads a scenario to its end.
    ///
    /// # Errors
    ///
    /// Fails if the source cannot be read, is too long, or has lines that are wrong: of each it says what was found and expected.
    pub fn read(source: impl BufRead) -> Result<Self, Unreadable> {
        let mut source = Source { bytes: source, left: MAX_BYTES, number: 0 };
        let mut reading = Reading::default();
        let mut text = Vec::new();
        loop {
            match source.line(&mut text).map_err(|why| Unreadable::Io { line: source.number, source: why })? {
                End::Source => break,
                End::Patience => return Err(Unreadable::Long { bytes: MAX_BYTES }),
                End::Line { cut } => reading.line(source.number, &text, cut),
            }
            if reading.lines.len() > MAX_LINES {
                reading.wrong(
                    source.number,
                    "more",
                    &format!("at most {MAX_LINES} lines that say something"),
                );
                break;
            }
        }
        reading.finish(source.number)
    }
}

/// Where a line came to its end.
enum End {
    /// There is no further line.
    Source,
    /// The source gives more than is read.
    Patience,
    /// At its line feed, or with the source. Whether it was too long, and only its beginning is there.
    Line { cut: bool },
}

struct Source<R> {
    bytes: R,
    /// So many bytes may still be read.
    left: u64,
    number: u64,
}

impl<R: BufRead> Source<R> {
    /// Reads the next line, without its line feed.
    fn line(&mut self, text: &mut Vec<u8>) -> io::Result<End> {
        text.clear();
        self.number += 1;
        let mut cut = false;
        let mut begun = false;
        loop {
            let buffer = match self.bytes.fill_buf() {
                Ok(buffer) => buffer,
                Err(error) if error.kind() == io::ErrorKind::Interrupted => continue,
                Err(error) => return Err(error),
            };
            if buffer.is_empty() {
                if !begun {
                    self.number -= 1;
                }
                return Ok(if begun { End::Line { cut } } else { End::Source });
            }
            if self.left == 0 {
                return Ok(End::Patience);
            }
            begun = true;
            let feed = buffer.iter().position(|&byte| byte == b'\n');
            let piece = buffer.get(..feed.unwrap_or(buffer.len())).unwrap_or_default();
            let over = u64::try_from(piece.len()).is_ok_and(|bytes| bytes > self.left);
            if over {
                return Ok(End::Patience);
            }
            let room = MAX_LINE.saturating_sub(text.len());
            text.extend(piece.iter().take(room));
            cut |= piece.len() > room;
            let used = piece.len() + usize::from(feed.is_some());
            self.left = self.left.saturating_sub(u64::try_from(used).unwrap_or(u64::MAX));
            self.bytes.consume(used);
            if feed.is_some() {
                return Ok(End::Line { cut });
            }
        }
    }
}

/// What has been read so far.
#[derive(Default)]
struct Reading {
    parser: Lines,
    lines: Vec<Line>,
    errors: Vec<LineError>,
    more: u64,
}

impl Reading {
    fn line(&mut self, number: u64, text: &[u8], cut: bool) {
        let text = text.strip_prefix(b"\xEF\xBB\xBF").filter(|_| number == 1).unwrap_or(text);
        if cut {
            return self.error(LineError {
                line: number,
                column: 1,
                found: text.to_vec(),
                expected: format!("a line of at most {MAX_LINE} bytes"),
            });
        }
        match self.parser.line(number, text) {
            Ok(line) => self.lines.extend(line),
            Err(errors) => errors.into_iter().for_each(|error| self.error(error)),
        }
    }

    fn wrong(&mut self, line: u64, found: &str, expected: &str) {
        self.error(LineError { line, column: 1, found: found.into(), expected: expected.to_owned() });
    }

    fn error(&mut self, error: LineError) {
        if self.errors.len() < MAX_ERRORS {
            self.errors.push(error);
        } else {
            self.more += 1;
        }
    }

    fn finish(mut self, last: u64) -> Result<Scenario, Unreadable> {
        if self.lines.is_empty() && self.errors.is_empty() {
            self.wrong(last + 1, "", "a line such as: 0.5 asms on");
        }
        let Self { lines, errors, more, .. } = self;
        if errors.is_empty() { Ok(Scenario { lines }) } else { Err(Unreadable::Lines { errors, more }) }
    }
}
