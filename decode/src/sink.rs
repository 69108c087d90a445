//! Where decoded frames go.

use std::fmt;
use std::io;

use adsdv_oracle::candump::{Dropped, Entry, Record};

use crate::{Message, NotBuilt};

/// A frame of the recording, with the message that it is of.
#[derive(Clone, Copy, Debug)]
pub struct Frame<'a> {
    /// The frame as the recording has it.
    pub record: &'a Record<'a>,
    /// Its message, and the place of that in the catalog; `None` for what nothing knows, and for what is no data frame.
    pub message: Option<(usize, &'a Message)>,
}

/// Takes decoded frames, one after the other, in memory that does not grow with them.
pub trait Sink {
    /// Everything that the recording has, before any of it is decoded, also of interfaces that were not asked for: for a judge beside.
    ///
    /// # Errors
    ///
    /// Fails if the output cannot be written.
    fn heard(&mut self, _entry: &Entry<'_>) -> Result<(), SinkError> {
        Ok(())
    }

    /// The next frame.
    ///
    /// # Errors
    ///
    /// As [`heard`](Self::heard).
    fn frame(&mut self, frame: &Frame<'_>) -> Result<(), SinkError>;

    /// Word of frames that are missing before the next one.
    ///
    /// # Errors
    ///
    /// As [`heard`](Self::heard).
    fn dropped(&mut self, _dropped: &Dropped<'_>) -> Result<(), SinkError> {
        Ok(())
    }

    /// There is no more: writes what is left. `lines` is how many lines the recording had. Without this call the output is not complete.
    ///
    /// # Errors
    ///
    /// As [`heard`](Self::heard).
    fn finish(&mut self, lines: u64) -> Result<(), SinkError>;

    /// What a reader of the output has to know, a sentence each; asked after the end.
    fn notes(&self) -> Vec<String> {
        Vec::new()
    }
}

/// Why the output could not be written.
#[derive(Debug)]
pub struct SinkError(pub io::Error);

impl fmt::Display for SinkError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl std::error::Error for SinkError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        Some(&self.0)
    }
}

/// Why a sink could not be had.
#[derive(Debug)]
pub enum BeginError {
    /// Its format was not built in.
    NotBuilt(NotBuilt),
    /// What stands at the beginning could not be written.
    Sink(SinkError),
}

impl fmt::Display for BeginError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotBuilt(error) => error.fmt(f),
            Self::Sink(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for BeginError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::NotBuilt(_) => None,
            Self::Sink(error) => Some(error),
        }
    }
}

impl From<SinkError> for BeginError {
    fn from(error: SinkError) -> Self {
        Self::Sink(error)
    }
}

impl From<io::Error> for SinkError {
    fn from(error: io::Error) -> Self {
        Self(error)
    }
}
