//! Time: in nanoseconds, as recorders have it.

/// Milliseconds as nanoseconds.
pub(crate) const MS: i64 = 1_000_000;

/// After a silence of this length, in nanoseconds, nothing is known of a VCU any more; it may have been power-cycled.
pub const SILENCE_NS: i64 = 500 * MS;

/// Times further away than this (73 years) are taken for this, so that no sum of times overflows.
pub(super) const FAR_NS: i64 = 1 << 61;

#[allow(clippy::cast_precision_loss, reason = "a duration for display")]
pub(super) fn milliseconds(ns: i64) -> f64 {
    ns as f64 / 1e6
}
