//! What comes from the terminal: keys, and its new size; or that it is gone.

use std::io;
#[cfg(unix)]
use std::time::Duration;
use std::time::Instant;

use ratatui::crossterm::event;

/// The terminal that keys come from.
///
/// crossterm reads from a terminal that has hung up again and again, for ever. So it is asked only while there is one.
#[cfg(unix)]
pub(super) struct Keyboard(std::fs::File);

#[cfg(unix)]
impl Keyboard {
    /// The terminal that crossterm reads: standard input, or the one that the program was started from.
    pub(super) fn open() -> io::Result<Self> {
        use std::io::IsTerminal as _;
        use std::os::fd::AsFd as _;

        let stdin = io::stdin();
        if stdin.is_terminal() {
            stdin.as_fd().try_clone_to_owned().map(|terminal| Self(terminal.into()))
        } else {
            std::fs::File::open("/dev/tty").map(Self)
        }
    }

    /// Waits until then for a key or a new size, and tells whether there is one.
    ///
    /// # Errors
    ///
    /// The terminal is gone, or cannot be read.
    pub(super) fn has_news(&self, until: Instant) -> io::Result<bool> {
        // What crossterm has read already is not waited for.
        self.wait(Duration::ZERO)?;
        if event::poll(Duration::ZERO)? {
            return Ok(true);
        }
        self.wait(until.saturating_duration_since(Instant::now()))?;
        event::poll(Duration::ZERO)
    }

    fn wait(&self, patience: Duration) -> io::Result<()> {
        use rustix::event::{PollFd, PollFlags, Timespec, poll};

        let patience = Timespec::try_from(patience).map_err(io::Error::other)?;
        let mut terminal = [PollFd::new(&self.0, PollFlags::IN)];
        match poll(&mut terminal, Some(&patience)) {
            // A signal: crossterm knows whether it is a new size.
            Ok(_) | Err(rustix::io::Errno::INTR) => {}
            Err(error) => return Err(error.into()),
        }
        let gone = PollFlags::HUP | PollFlags::ERR | PollFlags::NVAL;
        if terminal.iter().any(|terminal| terminal.revents().intersects(gone)) {
            return Err(io::Error::new(io::ErrorKind::UnexpectedEof, "the terminal is gone"));
        }
        Ok(())
    }
}

/// The terminal that keys come from.
#[cfg(not(unix))]
pub(super) struct Keyboard;

#[cfg(not(unix))]
impl Keyboard {
    #[expect(clippy::unnecessary_wraps, reason = "as on unix")]
    pub(super) fn open() -> io::Result<Self> {
        Ok(Self)
    }

    pub(super) fn has_news(&self, until: Instant) -> io::Result<bool> {
        event::poll(until.saturating_duration_since(Instant::now()))
    }
}
