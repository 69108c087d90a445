//! How far the work has come: a line on standard error, if a person is looking at it.

use std::fmt::Display;
use std::io::{self, IsTerminal as _, Write as _};
use std::time::{Duration, Instant};

/// What is done in less time shows nothing.
const PATIENCE: Duration = Duration::from_millis(500);
/// Between two updates; faster than this nobody reads.
const PACE: Duration = Duration::from_millis(100);
/// The columns of a bar.
const BAR: usize = 30;

/// The line. It is erased when it is dropped.
#[derive(Debug)]
pub(crate) struct ProgressLine {
    next: Option<Instant>,
    shown: bool,
}

impl ProgressLine {
    /// Shows nothing yet, and nothing at all if standard error is no terminal.
    pub(crate) fn new() -> Self {
        Self { next: io::stderr().is_terminal().then(|| Instant::now() + PATIENCE), shown: false }
    }

    /// Shows how far it is, not too often.
    pub(crate) fn show(&mut self, text: impl Display) {
        let now = Instant::now();
        if self.next.is_some_and(|next| now >= next) {
            self.next = Some(now + PACE);
            self.shown = true;
            // Progress is a courtesy: that it cannot be shown is no error.
            let _ = write!(io::stderr(), "\r{text}\x1b[K");
        }
    }

    /// Shows a bar, full when `done` is `all`, and text behind it.
    pub(crate) fn show_bar(&mut self, done: usize, all: usize, text: impl Display) {
        self.show(format_args!("{} {text}", bar(done, all)));
    }
}

/// Such as `[#####-----]  50 %`.
fn bar(done: usize, all: usize) -> String {
    let (done, all) = (done.min(all), all.max(1));
    let full = done * BAR / all;
    format!("[{}{}] {:3} %", "#".repeat(full), "-".repeat(BAR - full), done * 100 / all)
}

impl Drop for ProgressLine {
    fn drop(&mut self) {
        if self.shown {
            let _ = write!(io::stderr(), "\r\x1b[K");
        }
    }
}

#[cfg(test)]
mod tests {
    use super::bar;

    #[test]
    fn a_bar_fills() {
        assert_eq!(bar(0, 4), "[------------------------------]   0 %");
        assert_eq!(bar(1, 4), "[#######-----------------------]  25 %");
        assert_eq!(bar(9, 4), "[##############################] 100 %");
        assert!(bar(0, 0).ends_with("0 %"));
    }
}
