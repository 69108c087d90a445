//! Why there is no report of a log.

use std::fmt;

use super::counted;
use crate::candump::{ReadError, Unit};
use crate::rules::RuleErrors;

/// Why there is no report.
#[derive(Debug)]
pub enum LogError {
    /// The log could not be read to its end.
    Read(ReadError),
    /// Nothing in the log is a frame.
    NoFrame {
        /// How many lines there are.
        lines: u64,
        /// What is wrong with the first line that is not blank.
        first: Option<crate::candump::LineError>,
    },
    /// The log has frames, but none on the interface that was asked for.
    NoSuchInterface {
        /// The interface asked for.
        wanted: String,
        /// The interfaces that the log has.
        found: Vec<String>,
    },
    /// The edition that is judged by has not all that the rules of the user's own name.
    Rules(RuleErrors),
}

impl fmt::Display for LogError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Read(error) => write!(f, "{error}"),
            Self::NoFrame { lines: 0, .. } => {
                write!(
                    f,
                    "the log is empty; expected lines of candump -L, such as (1.000000) can0 520#0000010000000000"
                )
            }
            Self::NoFrame { lines, first } => {
                let unit = first.map_or(Unit::Line, |first| first.unit);
                write!(f, "no readable frame in {}", counted(*lines, unit.name()))?;
                if let Some(first) = first {
                    write!(f, "; {first}")?;
                }
                Ok(())
            }
            Self::Rules(error) => write!(f, "{error}"),
            Self::NoSuchInterface { wanted, found } => {
                write!(f, "no data frame with an 11-bit identifier on interface {wanted}")?;
                if found.is_empty() { Ok(()) } else { write!(f, "; the log has {}", found.join(", ")) }
            }
        }
    }
}

impl std::error::Error for LogError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Read(error) => Some(error),
            Self::Rules(error) => Some(error),
            _ => None,
        }
    }
}
