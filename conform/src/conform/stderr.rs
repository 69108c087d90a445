//! What a program writes to its standard error: read all the time, so that it never has to wait, and the end of it kept.

use std::io::Read;
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use super::program_error::excerpt;

/// So much of the end is kept.
const KEPT: usize = 4096;
/// So many lines of it are shown.
const LINES: usize = 5;
/// How long the last words may take after the program has ended.
const PATIENCE: Duration = Duration::from_millis(200);

/// The end of a program's standard error.
#[derive(Debug)]
pub(super) struct LastWords {
    end: Arc<Mutex<Vec<u8>>>,
    reader: JoinHandle<()>,
}

impl LastWords {
    /// Those of a pipe.
    pub(super) fn of(pipe: impl Read + Send + 'static) -> Self {
        let end = Arc::new(Mutex::new(Vec::new()));
        let kept = Arc::clone(&end);
        Self { end, reader: thread::spawn(move || read(pipe, &kept)) }
    }

    /// The last lines, once all is read or a moment has passed.
    pub(super) fn lines(&self) -> Vec<String> {
        let start = Instant::now();
        while !self.reader.is_finished() && start.elapsed() < PATIENCE {
            thread::sleep(Duration::from_millis(5));
        }
        let end = self.end.lock().unwrap_or_else(PoisonError::into_inner);
        let mut lines: Vec<String> =
            end.split(|&byte| byte == b'\n').map(excerpt).filter(|line| !line.trim().is_empty()).collect();
        lines.drain(..lines.len().saturating_sub(LINES));
        lines
    }
}

fn read(mut pipe: impl Read, kept: &Mutex<Vec<u8>>) {
    let mut buffer = [0; KEPT];
    while let Ok(len) = pipe.read(&mut buffer) {
        if len == 0 {
            break;
        }
        let mut end = kept.lock().unwrap_or_else(PoisonError::into_inner);
        end.extend_from_slice(buffer.get(..len).unwrap_or_default());
        let before = end.len().saturating_sub(KEPT);
        end.drain(..before);
    }
}

#[cfg(test)]
mod tests {
    use std::io;

    use super::*;

    fn last_words(pipe: impl Read + Send + 'static) -> Vec<String> {
        LastWords::of(pipe).lines()
    }

    #[test]
    fn the_last_lines_are_kept_and_empty_ones_are_none() {
        assert_eq!(last_words(io::empty()), [""; 0]);
        assert_eq!(last_words(&b"one\n\n  \ntwo"[..]), ["one", "two"]);
        let many: Vec<String> = (0..5000).map(|number| format!("line {number}")).collect();
        assert_eq!(last_words(io::Cursor::new(many.join("\n") + "\n")), many[4995..]);
        let long = "x".repeat(KEPT) + "y";
        assert_eq!(last_words(io::Cursor::new(long.into_bytes())).len(), 1);
    }

    /// A pipe that says something after a while, and then stays open without a word or ends.
    struct Slow(&'static [u8], bool);

    impl Read for Slow {
        fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
            thread::sleep(Duration::from_millis(20));
            while self.0.is_empty() && self.1 {
                thread::park();
            }
            self.0.read(buffer)
        }
    }

    #[test]
    fn words_that_are_late_are_waited_for_and_an_open_pipe_is_not() {
        assert_eq!(last_words(Slow(b"late", false)), ["late"]);
        assert_eq!(last_words(Slow(b"late", true)), ["late"]);
    }
}
