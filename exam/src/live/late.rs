//! How late this machine was: a cycle of the virtual VCU that begins late is known, and whatever kept it waiting may have kept the
//! program waiting as well.

use std::time::Duration;

/// Less is nothing: every answer has more room than this.
const COUNTS: Duration = Duration::from_millis(5);
/// The VCU and the program wait for each other, so that what is late shows for some time.
const BEFORE_MS: u64 = 1000;
/// What keeps both waiting may be over for one of them sooner.
const BEHIND_MS: u64 = 200;

/// When cycles were late, and by how much.
#[derive(Clone, Debug, Default)]
pub(super) struct Lateness(Vec<(u64, u64)>);

impl Lateness {
    /// The cycle that was due at this time began so late.
    pub(super) fn note(&mut self, due_ms: u64, by: Duration) {
        if by >= COUNTS {
            self.0.push((due_ms, u64::try_from(by.as_millis()).unwrap_or(u64::MAX)));
        }
    }

    /// How late it was at worst, in milliseconds.
    pub(super) fn worst_ms(&self) -> u64 {
        self.0.iter().map(|(_, by)| *by).max().unwrap_or_default()
    }

    /// How late it was in all, in milliseconds.
    pub(super) fn sum_ms(&self) -> u64 {
        self.0.iter().map(|(_, by)| *by).sum()
    }

    /// How late it was around this time, in milliseconds, if that is as much as `slack_ms` in all.
    pub(super) fn around(&self, time_ms: u64, slack_ms: u64) -> Option<u64> {
        let from = time_ms.saturating_sub(BEFORE_MS.max(slack_ms.saturating_mul(2)));
        let near = self.0.iter().filter(|(due, by)| {
            (from..=time_ms + BEHIND_MS).contains(due) || (*due..=due + by).contains(&time_ms)
        });
        let by: u64 = near.map(|(_, by)| *by).sum();
        (by > 0 && by >= slack_ms).then_some(by)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const fn ms(ms: u64) -> Duration {
        Duration::from_millis(ms)
    }

    #[test]
    fn only_what_was_late_around_a_time_puts_it_in_doubt() {
        let mut late = Lateness::default();
        assert_eq!((late.around(0, 0), late.worst_ms()), (None, 0));
        late.note(4000, ms(4));
        assert_eq!(late.around(4000, 0), None);
        late.note(5000, ms(6));
        late.note(5010, ms(40));
        assert_eq!((late.worst_ms(), late.sum_ms()), (40, 46));
        assert_eq!(late.around(5010, 10), Some(46));
        assert_eq!(late.around(4850, 10), Some(46));
        assert_eq!(late.around(6000, 10), Some(46));
        assert_eq!(late.around(6011, 10), None);
        assert_eq!(late.around(4700, 10), None);
        // Who has a second for something is not excused by a few milliseconds.
        assert_eq!(late.around(5500, 500), None);
        late.note(5100, ms(600));
        assert_eq!(late.around(5500, 500), Some(646));
        assert_eq!(late.around(5690, 10), Some(646));
    }
}
