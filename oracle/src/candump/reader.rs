//! Streaming: finds the lines, counts them, and never holds more than a buffer of them.

use std::io::{self, Read};
use std::ops::Range;

use memchr::memchr;

use super::cursor;
use super::dropped;
use super::error::{Flaw, LineError, ReadError};
use super::line;
use super::printed::{self, Clock, Printed};
use super::record::{FrameKind, MAX_DATA, Record};
use super::usual::{self, Before, Interface, Usual};
use super::{Entries, Entry, MAX_LINE, Unit};
use crate::text::BYTE_ORDER_MARK;

const SHORTER: &str = "a line of at most 8192 bytes; is this a log of candump -L?";
const _: () = assert!(MAX_LINE == 8192, "SHORTER names the limit");

/// Large enough that system calls do not count, small enough to stay in the processor's cache.
const BUFFER: usize = 128 * 1024;
const _: () = assert!(BUFFER > 2 * MAX_LINE, "a line and its line feed have to fit, with room to read more");

/// Reads a log line by line.
///
/// It has a buffer of its own, so `source` needs none. A line is handed out as soon as the source has given
/// it, so that a pipe from a running `candump -L` is followed live.
#[derive(Debug)]
pub struct Reader<R> {
    source: R,
    buffer: Box<[u8]>,
    /// What of the buffer has been read from the source and not yet handed out.
    pending: Range<usize>,
    /// Whether `pending` starts inside a line that has been reported as too long.
    inside_long_line: bool,
    /// Number of the last line handed out.
    line: u64,
    /// Whether that line ended with a line feed.
    terminated: bool,
    /// Data of the last record handed out.
    data: Box<[u8; MAX_DATA]>,
    /// The interface that the next line will name most of the time: that of a line before. Empty at first.
    interface: String,
    /// What a usual line says again, and what is then not read anew.
    before: Box<Before>,
    /// The time of lines that were printed for a person.
    clock: Clock,
}

impl<R: Read> Reader<R> {
    /// Starts at the first line of `source`.
    pub fn new(source: R) -> Self {
        Self {
            source,
            buffer: vec![0; BUFFER].into_boxed_slice(),
            pending: 0..0,
            inside_long_line: false,
            line: 0,
            terminated: true,
            data: Box::new([0; MAX_DATA]),
            interface: String::new(),
            before: Box::new(Before::NOTHING),
            clock: Clock::default(),
        }
    }

    /// Number of the last line that was read, blank ones included; 0 before the first.
    pub fn line(&self) -> u64 {
        self.line
    }

    /// Bytes of memory that the reader holds, whatever the log.
    #[cfg(test)]
    pub(super) fn capacity(&self) -> usize {
        self.buffer.len() + self.data.len() + self.interface.capacity()
    }

    /// The next line that is not blank; `None` at the end of the log.
    ///
    /// # Errors
    ///
    /// Fails when the source does, after every complete line that it gave. A broken line is no failure of
    /// the reader but an [`Entry::Broken`].
    #[inline]
    pub fn next_record(&mut self) -> Result<Option<Entry<'_>>, ReadError> {
        let text = self.buffer.get(self.pending.clone()).unwrap_or_default();
        let Some((usual, taken)) = usual::read(text, &mut self.before).filter(|_| !self.inside_long_line)
        else {
            return self.next_unusual();
        };
        self.pending.start += taken;
        self.line += 1;
        let Usual { time_ns, id, data, len } = usual;
        if let Some(place) = self.data.first_chunk_mut() {
            *place = data;
        }
        Ok(Some(Entry::Frame(Record {
            line: self.line,
            time_ns,
            interface: &self.interface,
            kind: FrameKind::Standard,
            id,
            data: self.data.get(..len).unwrap_or_default(),
            direction: None,
            terminated: true,
        })))
    }

    /// The next line that is not blank, whatever it is.
    #[cold]
    fn next_unusual(&mut self) -> Result<Option<Entry<'_>>, ReadError> {
        let Some(span) = self.next_line()? else { return Ok(None) };
        let terminated = self.terminated;
        let text = text(&self.buffer, span, self.line);
        let parsed = if text.len() > MAX_LINE {
            Err(Flaw { at: 0, expected: SHORTER })
        } else {
            match dropped::parse(self.line, text) {
                Some(Ok(dropped)) => return Ok(Some(Entry::Dropped(dropped))),
                Some(Err(flaw)) => Err(flaw),
                None => match printed::parse(text, &mut self.data) {
                    Some(printed) => printed.map(|printed| {
                        let Printed { stamp, interface, kind, id, len, direction } = printed;
                        Record {
                            line: self.line,
                            time_ns: self.clock.time(stamp),
                            interface,
                            kind,
                            id,
                            data: self.data.get(..len).unwrap_or_default(),
                            direction,
                            terminated,
                        }
                    }),
                    None => line::parse(self.line, text, &mut self.data),
                },
            }
        };
        Ok(Some(match parsed {
            Ok(record) => {
                if record.interface != self.interface {
                    self.interface.clear();
                    self.interface.push_str(record.interface);
                    self.before.interface = Interface::named(record.interface);
                }
                Entry::Frame(Record { terminated, ..record })
            }
            Err(Flaw { at, expected }) => {
                Entry::Broken(LineError::new(Unit::Line, self.line, text, at, expected))
            }
        }))
    }

    /// Where in the buffer the next line stands that is not blank. Of a line longer than [`MAX_LINE`] it is
    /// the beginning, of more than that length.
    #[inline]
    fn next_line(&mut self) -> Result<Option<Range<usize>>, ReadError> {
        let mut searched = 0;
        loop {
            let pending = self.buffer.get(self.pending.clone()).unwrap_or_default();
            if let Some(found) = memchr(b'\n', pending.get(searched..).unwrap_or_default()) {
                let end = self.pending.start + searched + found;
                let span = self.pending.start..end;
                self.pending.start = end + 1;
                searched = 0;
                if self.inside_long_line {
                    self.inside_long_line = false;
                } else if self.begin_line(&span) {
                    return Ok(Some(span));
                }
                continue;
            }
            searched = pending.len();
            let too_long = searched > MAX_LINE;
            if self.inside_long_line || too_long {
                let span = self.pending.clone();
                self.pending = 0..0;
                searched = 0;
                if !self.inside_long_line {
                    self.inside_long_line = true;
                    self.line += 1;
                    return Ok(Some(span));
                }
            }
            if self.fill()? == 0 {
                let span = self.pending.clone();
                self.pending = 0..0;
                self.terminated = false;
                let last = !span.is_empty() && self.begin_line(&span);
                return Ok(last.then_some(span));
            }
        }
    }

    /// Counts a line, and tells whether it holds anything.
    #[inline]
    fn begin_line(&mut self, span: &Range<usize>) -> bool {
        self.line += 1;
        !cursor::is_blank(text(&self.buffer, span.clone(), self.line))
    }

    /// Reads on, behind what is pending; 0 bytes at the end of the source.
    #[cold]
    fn fill(&mut self) -> Result<usize, ReadError> {
        self.buffer.copy_within(self.pending.clone(), 0);
        self.pending = 0..self.pending.len();
        let room = self.buffer.get_mut(self.pending.end..).unwrap_or_default();
        loop {
            match self.source.read(room) {
                Ok(count) => {
                    let count = count.min(room.len());
                    self.pending.end += count;
                    return Ok(count);
                }
                Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                Err(source) => return Err(ReadError { unit: Unit::Line, line: self.line, source }),
            }
        }
    }
}

impl<R: Read> Entries for Reader<R> {
    #[inline]
    fn next_entry(&mut self) -> Result<Option<Entry<'_>>, ReadError> {
        self.next_record()
    }

    fn count(&self) -> u64 {
        self.line()
    }
}

/// What stands there in the buffer, which is of this line.
#[inline]
fn text(buffer: &[u8], span: Range<usize>, line: u64) -> &[u8] {
    let text = buffer.get(span).unwrap_or_default();
    if line == 1 { text.strip_prefix(BYTE_ORDER_MARK).unwrap_or(text) } else { text }
}
