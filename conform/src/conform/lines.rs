//! The lines of a program, as they come; waiting for one can end.

use std::ops::Range;
use std::time::{Duration, Instant};

use super::chunks::{Chunks, Waited};

/// How often a program that does not answer is looked at.
const LOOK: Duration = Duration::from_millis(50);

/// The lines in what a program writes, in whatever pieces that comes.
///
/// ```
/// use adsdv_conform::LineBuffer;
///
/// let mut lines = LineBuffer::default();
/// lines.push(b"{\"as_state\":\"AS_OFF\"}\n{\"as_");
/// let line = lines.take().expect("it is not too long").expect("it is there");
/// assert_eq!(lines.get(line), br#"{"as_state":"AS_OFF"}"#);
/// assert_eq!(lines.take(), Ok(None));
/// assert_eq!(lines.rest(), br#"{"as_"#);
/// ```
#[derive(Clone, Debug, Default)]
pub struct LineBuffer {
    bytes: Vec<u8>,
    /// Where the next line begins.
    start: usize,
    /// Up to here there is no end of it.
    looked: usize,
}

/// A line does not end within [`LineBuffer::LONGEST`] bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TooLong;

impl LineBuffer {
    /// A line of more bytes is no answer.
    pub const LONGEST: usize = 1 << 16;

    /// More has come. What was [taken](Self::take) before is gone.
    pub fn push(&mut self, chunk: &[u8]) {
        self.bytes.drain(..self.start);
        self.looked = self.looked.saturating_sub(self.start);
        self.start = 0;
        self.bytes.extend_from_slice(chunk);
    }

    /// The next line; where it stands without its line feed, for [`get`](Self::get). `None` if its end has not come.
    ///
    /// # Errors
    ///
    /// Fails if it is [too long](Self::LONGEST). There is no way past such a line: a program that writes one is asked no more.
    pub fn take(&mut self) -> Result<Option<Range<usize>>, TooLong> {
        let fresh = self.bytes.get(self.looked..).unwrap_or_default();
        let Some(end) = memchr::memchr(b'\n', fresh).map(|end| self.looked + end) else {
            self.looked = self.bytes.len();
            return if self.rest().len() > Self::LONGEST { Err(TooLong) } else { Ok(None) };
        };
        let line = self.start..end;
        if line.len() > Self::LONGEST {
            return Err(TooLong);
        }
        self.start = end + 1;
        self.looked = self.start;
        Ok(Some(line))
    }

    /// A line that was taken last.
    pub fn get(&self, line: Range<usize>) -> &[u8] {
        self.bytes.get(line).unwrap_or_default()
    }

    /// What has come of a line that did not end.
    pub fn rest(&self) -> &[u8] {
        self.bytes.get(self.start..).unwrap_or_default()
    }
}

/// Lines that are read.
#[derive(Debug)]
pub(super) struct Lines {
    chunks: Chunks,
    buffer: LineBuffer,
}

/// Why there is no line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Missing {
    /// The time is over.
    Late,
    /// There will be no more.
    End,
    /// It does not end within [`LineBuffer::LONGEST`].
    TooLong,
}

impl Lines {
    /// Those in what a pipe brings.
    pub(super) fn of(chunks: Chunks) -> Self {
        Self { chunks, buffer: LineBuffer::default() }
    }

    /// Waits for the next line; where it stands, for [`get`](Self::get). `ended` tells that the program is no more, so that
    /// nothing will come even if the pipe is still open.
    pub(super) fn next(
        &mut self,
        limit: Duration,
        mut ended: impl FnMut() -> bool,
    ) -> Result<Range<usize>, Missing> {
        let mut deadline = None;
        let mut gone = false;
        loop {
            if let Some(line) = self.buffer.take().map_err(|TooLong| Missing::TooLong)? {
                return Ok(line);
            }
            let now = Instant::now();
            let left = deadline.get_or_insert(now + limit).saturating_duration_since(now);
            match self.chunks.wait(left.min(LOOK), |chunk| self.buffer.push(chunk)) {
                Waited::Look => {}
                Waited::End => return Err(Missing::End),
                // What it wrote before it ended may still be on its way: look once more.
                Waited::Nothing if gone => return Err(Missing::End),
                Waited::Nothing if left <= LOOK => return Err(Missing::Late),
                Waited::Nothing => gone = ended(),
            }
        }
    }

    /// A line that has come last.
    pub(super) fn get(&self, line: Range<usize>) -> &[u8] {
        self.buffer.get(line)
    }

    /// What has come of a line that did not end.
    pub(super) fn rest(&self) -> &[u8] {
        self.buffer.rest()
    }
}

#[cfg(test)]
mod tests {
    #[cfg(unix)]
    use std::io::Write as _;

    use super::*;

    #[cfg(unix)]
    const LONG: Duration = Duration::from_mins(1);

    fn line(len: usize) -> Vec<u8> {
        [vec![b'x'; len], vec![b'\n']].concat()
    }

    #[test]
    fn a_line_may_be_as_long_as_that_and_no_longer() {
        let longest = LineBuffer::LONGEST;
        assert_eq!(longest, 65_536);
        let mut lines = LineBuffer::default();
        lines.push(&line(longest));
        assert_eq!(lines.take(), Ok(Some(0..longest)));
        lines.push(&line(longest + 1));
        assert_eq!(lines.take(), Err(TooLong));
        assert_eq!(lines.rest().len(), longest + 2, "it can still be shown");
        let mut lines = LineBuffer::default();
        lines.push(&vec![b'x'; longest]);
        assert_eq!(lines.take(), Ok(None), "its end may come");
        lines.push(b"x");
        assert_eq!(lines.take(), Err(TooLong));
    }

    #[test]
    fn lines_come_one_after_the_other_in_any_pieces() {
        let mut lines = LineBuffer::default();
        let mut taken = Vec::new();
        for piece in ["a\nb", "b", "b\n\nc", "\n", "d"] {
            lines.push(piece.as_bytes());
            while let Some(line) = lines.take().expect("short lines") {
                taken.push(String::from_utf8_lossy(lines.get(line)).into_owned());
            }
        }
        assert_eq!(taken, ["a", "bbb", "", "c"]);
        assert_eq!(lines.rest(), b"d");
    }

    /// The lines of a pipe, and its other end.
    #[cfg(unix)]
    fn piped() -> (Lines, std::io::PipeWriter) {
        let (reader, writer) = std::io::pipe().expect("a pipe");
        (Lines::of(Chunks::of(reader)), writer)
    }

    #[cfg(unix)]
    #[test]
    fn a_pipe_is_read_to_its_end() {
        let (mut lines, mut writer) = piped();
        writer.write_all(b"one\ntwo\nth").expect("there is room");
        for expected in ["one", "two"] {
            let line = lines.next(LONG, || false).expect("a line");
            assert_eq!(lines.get(line), expected.as_bytes());
        }
        drop(writer);
        assert_eq!(lines.next(LONG, || false), Err(Missing::End));
        assert_eq!(lines.rest(), b"th");
    }

    #[cfg(unix)]
    #[test]
    fn an_open_pipe_is_late_or_that_of_a_program_that_is_no_more() {
        let (mut lines, mut writer) = piped();
        assert_eq!(lines.next(Duration::ZERO, || false), Err(Missing::Late));
        let begun = Instant::now();
        assert_eq!(lines.next(LOOK * 2, || false), Err(Missing::Late));
        assert!(begun.elapsed() >= LOOK * 2);
        // It is looked at again after it is known to have ended.
        let mut looks = 0;
        let ended = || {
            looks += 1;
            true
        };
        assert_eq!(lines.next(LONG, ended), Err(Missing::End));
        assert_eq!(looks, 1);
        let endless = std::thread::spawn(move || while writer.write_all(&[b'x'; 1000]).is_ok() {});
        assert_eq!(lines.next(LONG, || false), Err(Missing::TooLong));
        drop(lines);
        endless.join().expect("nobody reads it any more");
    }
}
