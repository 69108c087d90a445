//! From what lines say of the time to times.
//!
//! `candump -t z` prints the time since the first frame, `-t d` that since the frame before, and both look the same. They are told apart by
//! what follows: times since the first frame do not fall, and those since the frame before do, soon, since frames come in groups. Until then they
//! are taken for the former. The few frames of the beginning get times that are too early by then, by no more than a group takes; nothing is read
//! ahead for them, so that a log in pieces, from a pipe, reads like a file.

use super::super::time::NS_PER_SECOND;
use super::Stamp;

/// No frame comes so long after the one before; a time that falls from there begins another recording.
const LONGEST: i64 = 10 * NS_PER_SECOND;

/// The time of what is read.
#[derive(Debug, Default)]
pub(in super::super) struct Clock {
    /// The time of the last frame.
    now: i64,
    /// What its line said, if it was since when is not known.
    last: Option<i64>,
    /// The sum of all that was said so: the time, if each was since the frame before.
    sum: i64,
    /// Times are since the frame before.
    deltas: bool,
}

impl Clock {
    /// The time of a frame by what its line says. Where nothing is said, no time passes.
    pub(in super::super) fn time(&mut self, said: Stamp) -> i64 {
        match said {
            Stamp::None => {}
            Stamp::Absolute(time_ns) => self.now = time_ns,
            Stamp::Since(ns) => {
                self.sum = self.sum.saturating_add(ns);
                self.deltas |= self.last.is_some_and(|last| falls(last, ns));
                self.now = if self.deltas { self.sum } else { ns };
                self.last = Some(ns);
            }
        }
        self.now
    }
}

/// Whether a time falls as no time since the first frame does: by far, and not from one recording to the next.
fn falls(last: i64, next: i64) -> bool {
    last < LONGEST && next < last / 2
}

#[cfg(test)]
mod tests {
    use super::*;

    const MS: i64 = 1_000_000;

    fn times(said: &[i64]) -> Vec<i64> {
        let mut clock = Clock::default();
        said.iter().map(|ms| clock.time(Stamp::Since(ms * MS)) / MS).collect()
    }

    #[test]
    fn times_since_the_first_frame_are_taken_as_they_are() {
        assert_eq!(times(&[0, 10, 20, 19, 30]), [0, 10, 20, 19, 30], "a little out of order is no fall");
        assert_eq!(times(&[0, 20_000, 0, 10]), [0, 20_000, 0, 10], "another recording begins");
    }

    #[test]
    fn times_since_the_frame_before_are_added_up_as_soon_as_one_falls() {
        assert_eq!(times(&[0, 9, 1, 9, 1]), [0, 9, 10, 19, 20]);
        assert_eq!(times(&[0, 3, 9, 1, 9, 1]), [0, 3, 9, 13, 22, 23]);
    }

    #[test]
    fn where_a_line_says_nothing_no_time_passes() {
        let mut clock = Clock::default();
        assert_eq!(clock.time(Stamp::None), 0);
        assert_eq!(clock.time(Stamp::Absolute(7)), 7);
        assert_eq!(clock.time(Stamp::None), 7);
    }
}
