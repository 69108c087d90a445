//! Times in the text of a scenario.

use std::fmt;

use adsdv_can::scenario::When;

/// Milliseconds as a scenario writes them.
pub(crate) struct Seconds(pub(crate) u64);

impl fmt::Display for Seconds {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        When::At(u32::try_from(self.0).unwrap_or(u32::MAX)).fmt(f)
    }
}
