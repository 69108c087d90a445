//! Text on its way out: collected, and written in large pieces.

use std::io::Write;
use std::time::{Duration, Instant};

use crate::SinkError;

/// So much is collected.
const PIECE: usize = 128 * 1024;
/// Where somebody may be waiting, nothing is kept back for longer than this, as long as frames come.
const PATIENCE: Duration = Duration::from_millis(50);

/// Text that is collected until it is worth writing.
pub(crate) struct Out<W> {
    pub(crate) text: Vec<u8>,
    writer: W,
    /// When it was written last, if somebody may be waiting.
    written: Option<Instant>,
}

impl<W: Write> Out<W> {
    /// With `live` what is collected is written soon, though it is little.
    pub(crate) fn new(writer: W, live: bool) -> Self {
        Self { text: Vec::with_capacity(PIECE + PIECE / 8), writer, written: live.then(Instant::now) }
    }

    /// A frame is complete.
    #[inline]
    pub(crate) fn end_frame(&mut self) -> Result<(), SinkError> {
        if self.text.len() >= PIECE || self.written.is_some_and(|written| written.elapsed() >= PATIENCE) {
            return self.write();
        }
        Ok(())
    }

    fn write(&mut self) -> Result<(), SinkError> {
        self.writer.write_all(&self.text)?;
        self.text.clear();
        if let Some(written) = &mut self.written {
            self.writer.flush()?;
            *written = Instant::now();
        }
        Ok(())
    }

    /// Writes what is left.
    pub(crate) fn finish(&mut self) -> Result<(), SinkError> {
        self.write()?;
        Ok(self.writer.flush()?)
    }
}
