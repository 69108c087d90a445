//! The messages that do not come in every cycle.

use std::collections::BTreeMap;

/// When each slow message was sent last.
#[derive(Clone, Debug, Default)]
pub(super) struct Slow {
    /// By identifier: milliseconds since then, less what it came too late.
    since_ms: BTreeMap<u16, u32>,
}

impl Slow {
    /// Whether it is time for a message that comes every so many milliseconds, `dt_ms` after it was last asked: in the first
    /// cycle, and then without drift.
    pub(super) fn is_due(&mut self, id: u16, cycle_ms: u32, dt_ms: u32) -> bool {
        let since = self.since_ms.get(&id).map(|since| since.saturating_add(dt_ms));
        // What is too much counts for the next one, but for whole cycles that were missed.
        self.since_ms.insert(id, since.and_then(|since| since.checked_rem(cycle_ms)).unwrap_or(0));
        since.is_none_or(|since| since >= cycle_ms)
    }
}
