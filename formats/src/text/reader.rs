//! Goes from line to line, and makes entries of them.

use adsdv_oracle::candump::{Entries, Entry, LineError, ReadError, Unit};

use crate::Source;
use crate::lines::Lines;

use super::{Flaw, Frame};

/// What a line is, if it is one of the format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Meaning {
    /// A frame, which has been written.
    Frame,
    /// Something else that such a file has: a header, a comment, an event.
    Other,
}

/// How the lines of a format are read, one after the other.
pub(crate) trait Dialect: Send {
    /// What is expected instead of a line that is longer than any that is read.
    const SHORTER: &'static str;

    /// Reads a line that is not blank. If it is a frame, `frame` is that; if not, `frame` may be anything.
    fn read(&mut self, line: &[u8], frame: &mut Frame) -> Result<Meaning, Flaw>;
}

/// Reads a text of some dialect.
pub(crate) struct TextReader<D> {
    lines: Lines,
    dialect: D,
    frame: Frame,
}

impl<D: Dialect> TextReader<D> {
    /// Starts at the first line; `interface` is the name of a bus until a line names another.
    pub(crate) fn new(source: Source, dialect: D, interface: &str) -> Self {
        Self { lines: Lines::new(source), dialect, frame: Frame::on(interface) }
    }
}

/// What a line came to.
enum TextStep {
    Frame { line: u64, terminated: bool },
    Broken(LineError),
}

impl<D: Dialect> TextReader<D> {
    /// Goes on to the next line that is worth an entry.
    #[inline]
    fn step(&mut self) -> Result<Option<TextStep>, ReadError> {
        while let Some(line) = self.lines.next_line()? {
            let read = if line.is_too_long() {
                Err(Flaw { at: 0, expected: D::SHORTER })
            } else if line.text.iter().all(u8::is_ascii_whitespace) {
                continue;
            } else {
                self.dialect.read(line.text, &mut self.frame)
            };
            match read {
                Ok(Meaning::Other) => {}
                Ok(Meaning::Frame) => {
                    return Ok(Some(TextStep::Frame { line: line.number, terminated: line.terminated }));
                }
                Err(Flaw { at, expected }) => {
                    let error = LineError::new(Unit::Line, line.number, line.text, at, expected);
                    return Ok(Some(TextStep::Broken(error)));
                }
            }
        }
        Ok(None)
    }
}

impl<D: Dialect> Entries for TextReader<D> {
    #[inline]
    fn next_entry(&mut self) -> Result<Option<Entry<'_>>, ReadError> {
        Ok(self.step()?.map(|step| match step {
            TextStep::Frame { line, terminated } => Entry::Frame(self.frame.record(line, terminated)),
            TextStep::Broken(error) => Entry::Broken(error),
        }))
    }

    fn count(&self) -> u64 {
        self.lines.count()
    }
}
