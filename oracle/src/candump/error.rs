//! What can go wrong: a line that is no frame, and a log that cannot be read any further.

use std::fmt;
use std::io;

use super::Unit;

/// Where and why a line could not be read; its number is the reader's to know.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Flaw {
    /// Offset in the line, in bytes.
    pub(super) at: usize,
    /// What should have stood there.
    pub(super) expected: &'static str,
}

/// A line that is no frame, or what a log is made of instead. It has been passed over; the next line is read as if it were not there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LineError {
    /// What the log is made of.
    pub unit: Unit,
    /// Number of the line in the log; the first is 1.
    pub line: u64,
    /// Where the line stops being readable, in bytes; the first is 1.
    pub column: usize,
    /// What was found there.
    pub found: Excerpt,
    /// What should have stood there.
    pub expected: &'static str,
}

impl LineError {
    /// Number `line` of the log, which is these bytes, cannot be read from an offset `at` on, where `expected` should have stood.
    #[cold]
    pub fn new(unit: Unit, line: u64, bytes: &[u8], at: usize, expected: &'static str) -> Self {
        let found = Excerpt::new(bytes.get(at..).unwrap_or_default());
        Self { unit, line, column: at + 1, found, expected }
    }
}

impl fmt::Display for LineError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { unit, line, column, found, expected } = self;
        write!(f, "{unit} {line}, {} {column}: found ", unit.part())?;
        if found.as_bytes().is_empty() {
            write!(f, "the end of the {unit}, expected {expected}")
        } else {
            write!(f, "{found}, expected {expected}")
        }
    }
}

impl std::error::Error for LineError {}

/// The first bytes of what was found, short enough for a message.
///
/// It prints as quoted ASCII with everything else escaped, so that rubbish in a log cannot reach a terminal.
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct Excerpt {
    bytes: [u8; Self::LIMIT],
    len: u8,
    cut: bool,
}

impl Excerpt {
    const LIMIT: usize = 24;

    fn new(text: &[u8]) -> Self {
        let mut excerpt = Self { bytes: [0; Self::LIMIT], len: 0, cut: text.len() > Self::LIMIT };
        for (place, byte) in excerpt.bytes.iter_mut().zip(text) {
            *place = *byte;
            excerpt.len += 1;
        }
        excerpt
    }

    /// The bytes as they stand in the log; empty if the line ended.
    pub fn as_bytes(&self) -> &[u8] {
        self.bytes.get(..usize::from(self.len)).unwrap_or_default()
    }
}

impl fmt::Display for Excerpt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.len == 0 {
            return f.write_str("the end of the line");
        }
        write!(f, "\"{}\"{}", self.as_bytes().escape_ascii(), if self.cut { "..." } else { "" })
    }
}

impl fmt::Debug for Excerpt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

/// The source of the log failed. Every complete line before the failure has been handed out.
#[derive(Debug)]
pub struct ReadError {
    /// What the log is made of.
    pub unit: Unit,
    /// Number of the last line that was read completely; 0 if there was none.
    pub line: u64,
    /// The failure itself.
    pub source: io::Error,
}

impl fmt::Display for ReadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "cannot read on after {} {}: {}", self.unit, self.line, self.source)
    }
}

impl std::error::Error for ReadError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        Some(&self.source)
    }
}

impl From<ReadError> for io::Error {
    fn from(error: ReadError) -> Self {
        Self::new(error.source.kind(), error)
    }
}

#[cfg(test)]
mod tests {
    use std::error::Error as _;

    use super::*;

    #[test]
    fn what_ends_too_early_is_called_what_it_is() {
        for (unit, text) in [
            (Unit::Line, "line 3, column 5: found the end of the line, expected more"),
            (Unit::Object, "object 3, byte 5: found the end of the object, expected more"),
        ] {
            assert_eq!(LineError::new(unit, 3, b"four", 4, "more").to_string(), text);
        }
    }

    #[test]
    fn an_excerpt_is_short_and_printable() {
        let cases: [(&[u8], &str); 4] = [
            (b"", "the end of the line"),
            (b"52x#", r#""52x#""#),
            (b"\x1b[2J\0\xff\"", r#""\x1b[2J\x00\xff\"""#),
            (b"0123456789abcdefghijklmnopqrstuvwxyz", r#""0123456789abcdefghijklmn"..."#),
        ];
        for (text, printed) in cases {
            let excerpt = Excerpt::new(text);
            assert_eq!(
                (excerpt.to_string(), format!("{excerpt:?}")),
                (printed.to_owned(), printed.to_owned())
            );
        }
    }

    #[test]
    fn a_read_error_keeps_its_line_and_kind() {
        let error = ReadError { unit: Unit::Line, line: 7, source: io::ErrorKind::TimedOut.into() };
        assert_eq!(error.source().map(ToString::to_string), Some("timed out".to_owned()));
        let error = io::Error::from(error);
        assert_eq!(error.kind(), io::ErrorKind::TimedOut);
        assert_eq!(error.to_string(), "cannot read on after line 7: timed out");
    }
}
