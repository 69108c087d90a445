//! Why a recording cannot be opened.

use std::fmt;
use std::io;

use crate::Format;
use crate::foreign::Foreign;

/// Why a recording cannot be opened.
#[derive(Debug)]
pub enum OpenError {
    /// The source failed before anything was read.
    Read(io::Error),
    /// It is a file that is known, and not read.
    Foreign(Foreign),
    /// It is of a format whose reader was not built in.
    NotBuilt {
        /// The format.
        format: Format,
        /// The feature of this crate, and of `adsdv`, that builds it in.
        feature: &'static str,
    },
}

impl fmt::Display for OpenError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Read(error) => write!(f, "cannot read it: {error}"),
            Self::Foreign(foreign) => write!(f, "it is {}, which is not read", foreign.what),
            Self::NotBuilt { format, feature } => {
                write!(
                    f,
                    "it is {format}, which this build does not read: it was built without the feature {feature}"
                )?;
                write!(f, " (cargo install --path cli --features {feature}, or a release binary, has it)")
            }
        }
    }
}

impl std::error::Error for OpenError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Read(error) => Some(error),
            Self::Foreign(_) | Self::NotBuilt { .. } => None,
        }
    }
}
