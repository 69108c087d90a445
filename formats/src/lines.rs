//! Lines of a source, one after the other, in bounded memory: what the readers of text formats have in common.

use std::io::{self, BufRead as _, BufReader};

use adsdv_oracle::candump::{MAX_LINE, ReadError, Unit};
use adsdv_oracle::text::BYTE_ORDER_MARK;
use memchr::memchr;

use crate::Source;

/// A line of text, without its line feed and a carriage return before that.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Line<'a> {
    /// Its number; the first is 1.
    pub(crate) number: u64,
    /// Its text; of a line longer than [`MAX_LINE`] the beginning, of one byte more than that.
    pub(crate) text: &'a [u8],
    /// Whether it ended with a line feed. The last one of a log that was cut off does not, and may lack data.
    pub(crate) terminated: bool,
}

impl Line<'_> {
    /// Whether it is longer than anything that is read.
    pub(crate) fn is_too_long(&self) -> bool {
        self.text.len() > MAX_LINE
    }
}

/// The lines of a source.
pub(crate) struct Lines {
    source: BufReader<Source>,
    /// The last line.
    text: Vec<u8>,
    number: u64,
}

impl Lines {
    pub(crate) fn new(source: Source) -> Self {
        Self { source: BufReader::with_capacity(128 * 1024, source), text: Vec::new(), number: 0 }
    }

    /// How many lines have been read.
    pub(crate) const fn count(&self) -> u64 {
        self.number
    }

    /// The next line, blank or not; `None` at the end.
    pub(crate) fn next_line(&mut self) -> Result<Option<Line<'_>>, ReadError> {
        self.text.clear();
        match self.take() {
            Ok(None) => Ok(None),
            Ok(Some(terminated)) => {
                self.number += 1;
                let mut text = self.text.as_slice();
                if self.number == 1 {
                    text = text.strip_prefix(BYTE_ORDER_MARK).unwrap_or(text);
                }
                let text = text.strip_suffix(b"\r").unwrap_or(text);
                Ok(Some(Line { number: self.number, text, terminated }))
            }
            // Half a line before the failure is no line.
            Err(source) => Err(ReadError { unit: Unit::Line, line: self.number, source }),
        }
    }

    /// Takes up to the next line feed; whether there was one. `None` at the end.
    fn take(&mut self) -> io::Result<Option<bool>> {
        let mut any = false;
        loop {
            let here = match self.source.fill_buf() {
                Ok(here) => here,
                Err(error) if error.kind() == io::ErrorKind::Interrupted => continue,
                Err(error) => return Err(error),
            };
            if here.is_empty() {
                return Ok(any.then_some(false));
            }
            any = true;
            let end = memchr(b'\n', here);
            let room = (MAX_LINE + 1).saturating_sub(self.text.len());
            let line = here.get(..end.unwrap_or(here.len())).unwrap_or(here);
            self.text.extend_from_slice(line.get(..room).unwrap_or(line));
            let taken = end.map_or(here.len(), |end| end + 1);
            self.source.consume(taken);
            if end.is_some() {
                return Ok(Some(true));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use std::io::{Cursor, Read};

    use super::*;

    fn lines(text: impl Read + Send + 'static) -> Vec<(u64, Vec<u8>, bool)> {
        let mut lines = Lines::new(Box::new(text));
        let mut all = Vec::new();
        while let Some(Line { number, text, terminated }) = lines.next_line().expect("it can be read") {
            all.push((number, text.to_vec(), terminated));
        }
        assert_eq!(lines.count(), all.len() as u64);
        all
    }

    #[test]
    fn lines_have_numbers_and_no_ends() {
        let expected: [(u64, &[u8], bool); 4] =
            [(1, b"a", true), (2, b"", true), (3, b"bc", true), (4, b"d", false)];
        let expected = expected.map(|(number, text, terminated)| (number, text.to_vec(), terminated));
        assert_eq!(lines(Cursor::new("\u{feff}a\r\n\nbc\nd")), expected);
        assert_eq!(lines(Cursor::new("")), []);
    }

    #[test]
    fn a_line_without_end_is_kept_up_to_a_limit() {
        let long = io::repeat(b'x').take(1 << 24).chain(&b"\nshort\n"[..]);
        let mut lines = Lines::new(Box::new(long));
        let line = lines.next_line().expect("readable").expect("a line");
        assert!(line.is_too_long() && line.text.len() == MAX_LINE + 1);
        let line = lines.next_line().expect("readable").expect("a line");
        assert_eq!((line.number, line.text), (2, &b"short"[..]));
        assert!(lines.text.capacity() < 3 * MAX_LINE);
    }

    #[test]
    fn a_failure_has_its_place() {
        struct Fails;
        impl Read for Fails {
            fn read(&mut self, _: &mut [u8]) -> io::Result<usize> {
                Err(io::ErrorKind::TimedOut.into())
            }
        }
        let mut lines = Lines::new(Box::new((&b"one\ntw"[..]).chain(Fails)));
        assert!(lines.next_line().is_ok());
        let error = lines.next_line().expect_err("it fails").to_string();
        assert_eq!(error, "cannot read on after line 1: timed out");
    }
}
