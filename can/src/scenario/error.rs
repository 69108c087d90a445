//! Why there is no scenario.

use std::fmt;
use std::io;

use crate::car::Excerpt;

/// What is wrong with a line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LineError {
    /// The number of the line in its file; the first is 1.
    pub line: u64,
    /// Where it is wrong, in bytes; the first is 1.
    pub column: usize,
    /// What was found there, as it is in the file; empty if nothing was.
    pub found: Vec<u8>,
    /// What was expected instead.
    pub expected: String,
}

impl fmt::Display for LineError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { line, column, found, expected } = self;
        write!(f, "line {line}, column {column}: found {}, expected {expected}", Excerpt(found))
    }
}

impl std::error::Error for LineError {}

/// Why a file is no scenario.
#[derive(Debug)]
pub enum Unreadable {
    /// The file could not be read on.
    Io {
        /// The number of the line that could not be read.
        line: u64,
        /// Why.
        source: io::Error,
    },
    /// It is longer than any scenario.
    Long {
        /// So many bytes were read: [`MAX_BYTES`](super::MAX_BYTES).
        bytes: u64,
    },
    /// These lines are wrong, in their order; each line of its text is one of them.
    Lines {
        /// The first of what is wrong, at most [`MAX_ERRORS`].
        errors: Vec<LineError>,
        /// How much more is wrong.
        more: u64,
    },
}

/// So many errors are listed in full; the others are counted.
pub const MAX_ERRORS: usize = 50;

impl fmt::Display for Unreadable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Io { line, source } => write!(f, "cannot read on at line {line}: {source}"),
            Self::Long { bytes } => write!(f, "is longer than {bytes} bytes; expected a scenario"),
            Self::Lines { errors, more } => {
                for (index, error) in errors.iter().enumerate() {
                    let feed = if index == 0 { "" } else { "\n" };
                    write!(f, "{feed}{error}")?;
                }
                match more {
                    0 => Ok(()),
                    more => write!(f, "\nand {more} more"),
                }
            }
        }
    }
}

impl std::error::Error for Unreadable {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Io { source, .. } => Some(source),
            Self::Long { .. } | Self::Lines { .. } => None,
        }
    }
}
