//! Why a CAN interface cannot be used.

use std::fmt;

/// Why a CAN interface cannot be used: what was given, what is wrong with it, and what to do.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OpenError {
    /// The interface that was asked for, in quotes if its name is none.
    pub what: String,
    /// What is wrong, and what was expected.
    pub why: String,
    /// What to do.
    pub hint: String,
}

impl fmt::Display for OpenError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { what, why, hint } = self;
        write!(f, "{what}: {why}\nhint: {hint}")
    }
}

impl std::error::Error for OpenError {}
