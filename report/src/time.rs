//! Times as the page has them.

use std::fmt;

/// Nanoseconds as microseconds, rounded, as `--json` has them.
pub(crate) const fn micros(ns: i64) -> i64 {
    ns.saturating_add(500).div_euclid(1000)
}

/// Seconds with three decimals, as the report in text has them.
pub(crate) struct Seconds(pub(crate) i64);

impl fmt::Display for Seconds {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ms = self.0.saturating_add(500_000).div_euclid(1_000_000);
        let sign = if ms < 0 { "-" } else { "" };
        let ms = ms.unsigned_abs();
        write!(f, "{sign}{}.{:03}", ms / 1000, ms % 1000)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn seconds_have_three_decimals() {
        let texts =
            [0, 499_999, 500_000, 13_015_234_567, -400, -1_500_000_000].map(|ns| Seconds(ns).to_string());
        assert_eq!(texts, ["0.000", "0.000", "0.001", "13.015", "0.000", "-1.500"]);
        assert_eq!((micros(13_015_234_567), micros(-400)), (13_015_235, 0));
    }
}
