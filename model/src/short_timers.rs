//! Short timers: enough of them where time itself is not what is looked at.

use adsdv_spec::{Edition, Timing};

use crate::document::DEFAULT;

/// Timers with which all combinations are explored: longer than the handshake's by enough that everything that can
/// happen while the real ones run can happen while these do. The lemma `short-timers` says so.
pub const SHORT_TIMERS: Timing = short_timers(DEFAULT);

/// The [`SHORT_TIMERS`] of an edition.
pub const fn short_timers(edition: &Edition) -> Timing {
    let timer_ms = edition.rules.timing.handshake_ms + 3 * edition.rules.timing.cycle_ms;
    Timing { ready_dwell_ms: timer_ms, ebs_timer_ms: timer_ms, ..edition.rules.timing }
}
