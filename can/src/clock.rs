//! Cycles of real time, without drift: cycle `n` is due at `start + n * cycle`, however late the ones before it were.
//!
//! A cycle that is late by whole cycles leaves these out: the step that follows gets the time that has really passed,
//! rather than being made up for by steps in a row, which would look to everybody else like a VCU in a hurry.
//!
//! Nothing here reads a clock: the time is what the caller says.

use std::time::{Duration, Instant};

use adsdv_oracle::judge::ResponseTimes;

use crate::status::Cycles;

/// The clock of a cycle.
///
/// ```
/// use std::time::{Duration, Instant};
/// use adsdv_can::clock::Clock;
///
/// let start = Instant::now();
/// let ms = Duration::from_millis;
/// let mut clock = Clock::new(start, 10);
/// assert_eq!(clock.deadline(), start);
/// assert_eq!(clock.begin(start + ms(3)).dt_ms, 10);
/// assert_eq!(clock.deadline(), start + ms(10)); // not 13: lateness does not add up
/// let late = clock.begin(start + ms(35));
/// assert_eq!((late.dt_ms, late.left_out), (30, 2));
/// assert_eq!(clock.deadline(), start + ms(40));
/// ```
#[derive(Clone, Debug)]
pub struct Clock {
    start: Instant,
    cycle_ms: u32,
    /// The cycle that is due next, counted from `start`.
    next: u64,
    count: u64,
    late: u64,
    left_out: u64,
    /// How late cycles began. The histogram of answers serves as well.
    lateness: ResponseTimes,
}

/// A cycle that begins.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Begun {
    /// The time since the cycle before it, in milliseconds: a whole number of cycles.
    pub dt_ms: u32,
    /// How many cycles were left out, because this one began so late.
    pub left_out: u64,
    /// How late it began.
    pub late_by: Duration,
}

impl Clock {
    /// A clock whose first cycle is due at `start`, and the next every `cycle_ms` milliseconds, at least one.
    pub fn new(start: Instant, cycle_ms: u32) -> Self {
        let lateness = ResponseTimes::default();
        Self { start, cycle_ms: cycle_ms.max(1), next: 0, count: 0, late: 0, left_out: 0, lateness }
    }

    /// When the next cycle is due.
    pub fn deadline(&self) -> Instant {
        self.at(self.next)
    }

    /// When a cycle is due. Beyond the end of time, which is further than any run, it is at once.
    fn at(&self, cycle: u64) -> Instant {
        let ms = cycle.saturating_mul(self.cycle_ms.into());
        self.start.checked_add(Duration::from_millis(ms)).unwrap_or(self.start)
    }

    /// The next cycle begins now. A cycle that begins early is not late.
    pub fn begin(&mut self, now: Instant) -> Begun {
        let late_by = now.saturating_duration_since(self.deadline());
        let left_out = u64::try_from(late_by.as_millis() / u128::from(self.cycle_ms)).unwrap_or(u64::MAX);
        let cycles = left_out.saturating_add(1);
        self.next = self.next.saturating_add(cycles);
        self.count += 1;
        self.late += u64::from(left_out > 0);
        self.left_out = self.left_out.saturating_add(left_out);
        self.lateness.add(i64::try_from(late_by.as_nanos()).unwrap_or(i64::MAX));
        let dt_ms = u32::try_from(cycles.saturating_mul(self.cycle_ms.into())).unwrap_or(u32::MAX);
        Begun { dt_ms, left_out, late_by }
    }

    /// When the cycle that began last was due, in milliseconds since the start; 0 before the first.
    pub fn time_ms(&self) -> u64 {
        self.next.saturating_sub(1).saturating_mul(self.cycle_ms.into())
    }

    /// The time since the first cycle was due.
    pub fn elapsed(&self, now: Instant) -> Duration {
        now.saturating_duration_since(self.start)
    }

    /// How well the cycle was held.
    pub fn cycles(&self) -> Cycles {
        Cycles {
            count: self.count,
            late: self.late,
            left_out: self.left_out,
            worst_ms: self.lateness.max_ms().unwrap_or(0.0),
            p50_ms: self.lateness.quantile_ms(0.5).unwrap_or(0.0),
            p99_ms: self.lateness.quantile_ms(0.99).unwrap_or(0.0),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const fn us(us: u64) -> Duration {
        Duration::from_micros(us)
    }

    #[test]
    fn lateness_does_not_add_up() {
        let start = Instant::now();
        let mut clock = Clock::new(start, 10);
        for cycle in 0..100_000 {
            let deadline = start + us(cycle * 10_000);
            assert_eq!(clock.deadline(), deadline);
            let begun = clock.begin(deadline + us(cycle % 9_000));
            assert_eq!((begun.dt_ms, begun.left_out), (10, 0));
            assert_eq!(clock.time_ms(), cycle * 10);
        }
        assert_eq!(clock.cycles().late, 0);
    }

    #[test]
    fn a_cycle_that_is_late_by_whole_cycles_leaves_them_out() {
        for (late_us, left_out) in
            [(0, 0), (9_999, 0), (10_000, 1), (19_999, 1), (20_000, 2), (1_234_567, 123)]
        {
            let start = Instant::now();
            let mut clock = Clock::new(start, 10);
            clock.begin(start);
            let begun = clock.begin(start + us(10_000 + late_us));
            let dt_ms = u32::try_from(left_out + 1).expect("few") * 10;
            assert_eq!(begun, Begun { dt_ms, left_out, late_by: us(late_us) });
            // The next is due on the same grid, in the future, and less than a cycle away.
            assert_eq!(clock.deadline(), start + us((left_out + 2) * 10_000));
            assert_eq!(clock.cycles().late, u64::from(left_out > 0));
            assert_eq!(clock.cycles().left_out, left_out);
            assert_eq!(clock.cycles().count + left_out, clock.time_ms() / 10 + 1);
            // The times of all steps add up to the time that has passed.
            assert_eq!(clock.time_ms(), u64::from(dt_ms));
        }
    }

    #[test]
    fn lateness_is_counted_with_its_worst_and_its_99th_percentile() {
        let start = Instant::now();
        let mut clock = Clock::new(start, 10);
        assert_eq!(clock.cycles(), Cycles::default());
        for cycle in 0..1000 {
            let late = if cycle % 200 == 7 { 7_000 } else { 150 };
            clock.begin(start + us(cycle * 10_000 + late));
        }
        let Cycles { count, late, left_out, worst_ms, p50_ms, p99_ms } = clock.cycles();
        assert_eq!((count, late, left_out), (1000, 0, 0));
        assert!((worst_ms - 7.0).abs() < 1e-9 && (p99_ms - 0.15).abs() < 1e-9, "{worst_ms} {p99_ms}");
        assert!((p50_ms - 0.15).abs() < 1e-9, "{p50_ms}");
    }

    #[test]
    fn no_time_breaks_it() {
        let start = Instant::now();
        let mut clock = Clock::new(start + us(1_000_000), 0);
        assert_eq!(clock.begin(start), Begun { dt_ms: 1, left_out: 0, late_by: Duration::ZERO });
        let centuries = Duration::from_secs(20_000_000_000);
        let begun = clock.begin(start + centuries);
        assert_eq!(begun.dt_ms, u32::MAX);
        assert!(begun.left_out > 1_000_000);
    }
}
