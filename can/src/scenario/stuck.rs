//! A scenario that does not come to its end.

use std::fmt;

use adsdv_spec::messages::AsState;

use crate::car::Missing;

/// For how long a scenario may wait for a state where nothing else is said, in milliseconds: ten minutes.
pub const PATIENCE_MS: u64 = 600_000;

/// A line that waits for a state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Waiting {
    /// The number of the line in its file.
    pub line: u64,
    /// The state.
    pub state: AsState,
    /// Since when, in milliseconds since the start.
    pub since_ms: u64,
}

/// A scenario has waited too long for a state.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Stuck {
    /// What it waits for.
    pub waiting: Waiting,
    /// The state that it has instead; `None` if the VCU is without power.
    pub state: Option<AsState>,
    /// For how long it has waited, in milliseconds.
    pub waited_ms: u64,
    /// What is missing for the next arrow on the way to the state that it waits for.
    pub missing: Option<Missing>,
}

impl fmt::Display for Stuck {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { waiting: Waiting { line, state: wanted, .. }, state, waited_ms, missing } = self;
        let found = state.map_or("a VCU without power", AsState::name);
        let seconds = waited_ms / 1000;
        write!(f, "line {line}: expected {wanted}, found {found} after {seconds} s")?;
        missing.as_ref().map_or(Ok(()), |missing| write!(f, "; {missing}"))
    }
}

impl std::error::Error for Stuck {}
