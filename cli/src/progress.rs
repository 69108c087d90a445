//! How far the reading has come: a line on standard error, if a person is looking at it.

use std::io::{self, IsTerminal as _, Write as _};
use std::time::{Duration, Instant};

use adsdv_oracle::log::Progress;

/// A log that is read in less time shows nothing.
const PATIENCE: Duration = Duration::from_millis(500);
/// Between two counts; faster than this nobody reads.
const PACE: Duration = Duration::from_millis(100);

/// The count of lines. It is erased when it is dropped.
#[derive(Debug)]
pub(crate) struct Count {
    next: Option<Instant>,
    shown: bool,
}

impl Count {
    /// Shows nothing yet, and nothing at all if standard error is no terminal.
    pub(crate) fn new() -> Self {
        Self { next: io::stderr().is_terminal().then(|| Instant::now() + PATIENCE), shown: false }
    }

    /// Shows the count, not too often.
    pub(crate) fn show(&mut self, progress: Progress) {
        let now = Instant::now();
        if self.next.is_some_and(|next| now >= next) {
            self.next = Some(now + PACE);
            self.shown = true;
            // Progress is a courtesy: that it cannot be shown is no error.
            let _ = write!(io::stderr(), "\r{} lines", progress.lines);
        }
    }
}

impl Drop for Count {
    fn drop(&mut self) {
        if self.shown {
            let _ = write!(io::stderr(), "\r\x1b[K");
        }
    }
}
