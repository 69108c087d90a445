//! Where what is decoded goes, and text on its way there: collected, and written in large pieces.

use std::io::Write;
use std::time::{Duration, Instant};

use crate::SinkError;

/// So much is collected.
const PIECE: usize = 128 * 1024;
/// Where somebody may be waiting, nothing is kept back for longer than this, as long as frames come.
const PATIENCE: Duration = Duration::from_millis(50);

/// Where what is decoded goes. Of any kind behind a pointer, so that what writes is compiled here, and not with each caller.
pub(crate) type Writer<'a> = Box<dyn Write + Send + 'a>;

/// Text that is collected until it is worth writing.
pub(crate) struct Out<'a> {
    pub(crate) text: Vec<u8>,
    writer: Writer<'a>,
    /// When it was written last, if somebody may be waiting.
    written: Option<Instant>,
}

impl<'a> Out<'a> {
    /// With `live` what is collected is written soon, though it is little.
    pub(crate) fn new(writer: impl Write + Send + 'a, live: bool) -> Self {
        let writer = Box::new(writer);
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
