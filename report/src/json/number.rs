//! Numbers with the digits that mean something.

/// Nanoseconds as seconds, rounded to whole microseconds, which is what candump writes.
#[allow(clippy::cast_precision_loss, reason = "285 years of microseconds fit")]
pub fn seconds(ns: i64) -> f64 {
    ns.saturating_add(500).div_euclid(1000) as f64 / 1e6
}

/// Milliseconds rounded to whole microseconds.
pub(super) fn to_microseconds(ms: f64) -> f64 {
    (ms * 1e3).round() / 1e3
}

/// A number rounded to one of so many steps.
pub(super) fn rounded(value: f64, steps: f64) -> f64 {
    (value * steps).round() / steps
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_rounded_to_microseconds() {
        let cases = [
            (0, "0.0"),
            (499, "0.0"),
            (500, "1e-6"),
            (13_015_234_567, "13.015235"),
            (-400, "0.0"),
            (3_600_000_000_001_499, "3600000.000001"),
        ];
        for (ns, text) in cases {
            assert_eq!(serde_json::to_string(&seconds(ns)).ok().as_deref(), Some(text), "{ns} ns");
        }
        assert!(seconds(i64::MAX).is_finite() && seconds(i64::MIN).is_finite());
    }
}
