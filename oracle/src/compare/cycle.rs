//! How often something comes: the median of its intervals, in bounded memory.

use std::collections::BTreeMap;

/// An interval belongs to a step by its highest bit and so many bits behind it: steps are a sixteenth of their size wide.
const BITS: u32 = 4;
/// Fewer intervals tell nothing.
const ENOUGH: u64 = 5;

/// The intervals between frames.
///
/// ```
/// use adsdv_oracle::compare::Cycle;
///
/// let mut cycle = Cycle::default();
/// for t_ms in [0, 10, 20, 30, 40, 500, 510, 521] {
///     cycle.seen(t_ms * 1_000_000);
/// }
/// assert_eq!(cycle.median_ms(), Some(10.0));
/// ```
#[derive(Clone, Debug, Default)]
pub struct Cycle {
    last: Option<i64>,
    count: u64,
    /// How many there are in each step, and their sum in nanoseconds.
    steps: BTreeMap<u32, (u64, i64)>,
}

impl Cycle {
    /// It came, at this time in nanoseconds.
    pub fn seen(&mut self, t_ns: i64) {
        let Some(last) = self.last.replace(t_ns) else { return };
        let interval = t_ns.saturating_sub(last).max(0);
        let (count, sum) = self.steps.entry(step(interval.unsigned_abs())).or_default();
        *count += 1;
        *sum = sum.saturating_add(interval);
        self.count += 1;
    }

    /// The median, as the mean of those in its step; `None` if there are too few.
    #[allow(clippy::cast_precision_loss, reason = "a duration for display")]
    pub fn median_ms(&self) -> Option<f64> {
        if self.count < ENOUGH {
            return None;
        }
        let mut before = 0;
        let median = self.steps.values().find(|(count, _)| {
            before += count;
            2 * before >= self.count
        });
        median.map(|(count, sum)| *sum as f64 / *count as f64 / 1e6)
    }
}

fn step(ns: u64) -> u32 {
    let bits = u64::BITS - ns.leading_zeros();
    let behind = ns.checked_shr(bits.saturating_sub(BITS + 1)).unwrap_or_default() & ((1 << BITS) - 1);
    (bits << BITS) | u32::try_from(behind).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_frames_have_no_cycle() {
        let mut cycle = Cycle::default();
        for place in 0..5 {
            cycle.seen(place * 10_000_000);
            assert_eq!(cycle.median_ms(), None);
        }
        cycle.seen(50_000_000);
        assert_eq!(cycle.median_ms(), Some(10.0));
    }

    #[test]
    fn steps_grow_with_the_interval_and_are_few() {
        let mut before = 0;
        for ns in (0..1_000_000).step_by(7).chain([u64::MAX >> 1, u64::MAX]) {
            let now = step(ns);
            assert!(now >= before, "{ns}");
            before = now;
        }
        assert!(step(10_000_000) < step(10_700_000) && step(10_000_000) == step(10_010_000));
        assert!(before < 1 << 11);
    }

    #[test]
    fn jitter_does_not_move_the_median_much() {
        let mut cycle = Cycle::default();
        for place in 0..1000_i64 {
            cycle.seen(place * 10_000_000 + place % 7 * 300_000);
        }
        assert!(cycle.median_ms().is_some_and(|ms| (9.5..10.5).contains(&ms)), "{cycle:?}");
    }
}
