//! The lines of a program, as they come: read by a thread, so that waiting for one can end.

use std::io::Read;
use std::ops::Range;
use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, sync_channel};
use std::thread;
use std::time::{Duration, Instant};

/// A line of more bytes is no answer.
pub(super) const LONGEST: usize = 1 << 16;
/// What is read at once.
const CHUNK: usize = 1 << 16;
/// So many chunks wait to be looked at, before the program has to wait.
const WAITING: usize = 16;
/// How often a program that does not answer is looked at.
const LOOK: Duration = Duration::from_millis(50);

/// Lines that are read.
#[derive(Debug)]
pub(super) struct Lines {
    chunks: Receiver<Vec<u8>>,
    buffer: Vec<u8>,
    /// Where the next line begins in the buffer.
    start: usize,
}

/// Why there is no line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Missing {
    /// The time is over.
    Late,
    /// There will be no more.
    End,
    /// It does not end within [`LONGEST`].
    TooLong,
}

impl Lines {
    /// The lines of a pipe. The thread that reads it ends with the pipe, or when nobody wants its lines any more.
    pub(super) fn of(pipe: impl Read + Send + 'static) -> Self {
        let (sender, chunks) = sync_channel(WAITING);
        thread::spawn(move || read(pipe, &sender));
        Self { chunks, buffer: Vec::new(), start: 0 }
    }

    /// Waits for the next line; where it stands without its end, for [`get`](Self::get). `ended` tells that the program is no more, so that nothing will come even if the
    /// pipe is still open.
    pub(super) fn next(
        &mut self,
        limit: Duration,
        mut ended: impl FnMut() -> bool,
    ) -> Result<Range<usize>, Missing> {
        let mut looked = self.start;
        let mut deadline = None;
        let mut gone = false;
        let end = loop {
            let fresh = self.buffer.get(looked..).unwrap_or_default();
            if let Some(end) = memchr::memchr(b'\n', fresh) {
                break looked + end;
            }
            if self.buffer.len() - self.start > LONGEST {
                return Err(Missing::TooLong);
            }
            self.buffer.drain(..self.start);
            self.start = 0;
            looked = self.buffer.len();
            let now = Instant::now();
            let left = deadline.get_or_insert(now + limit).saturating_duration_since(now);
            match self.chunks.recv_timeout(left.min(LOOK)) {
                Ok(chunk) => self.buffer.extend_from_slice(&chunk),
                Err(RecvTimeoutError::Disconnected) => return Err(Missing::End),
                // What it wrote before it ended may still be on its way: look once more.
                Err(RecvTimeoutError::Timeout) if gone => return Err(Missing::End),
                Err(RecvTimeoutError::Timeout) if left <= LOOK => return Err(Missing::Late),
                Err(RecvTimeoutError::Timeout) => gone = ended(),
            }
        };
        let line = self.start..end;
        if line.len() > LONGEST {
            return Err(Missing::TooLong);
        }
        self.start = end + 1;
        Ok(line)
    }

    /// A line that has come last.
    pub(super) fn get(&self, line: Range<usize>) -> &[u8] {
        self.buffer.get(line).unwrap_or_default()
    }

    /// What has come of a line that did not end.
    pub(super) fn rest(&self) -> &[u8] {
        self.buffer.get(self.start..).unwrap_or_default()
    }
}

fn read(mut pipe: impl Read, chunks: &SyncSender<Vec<u8>>) {
    let mut buffer = vec![0; CHUNK];
    loop {
        match pipe.read(&mut buffer) {
            Ok(0) => break,
            Ok(len) => {
                let chunk = buffer.get(..len).unwrap_or_default().to_vec();
                if chunks.send(chunk).is_err() {
                    break;
                }
            }
            Err(error) if error.kind() == std::io::ErrorKind::Interrupted => {}
            // A pipe that cannot be read any more has ended.
            Err(_) => break,
        }
    }
}
