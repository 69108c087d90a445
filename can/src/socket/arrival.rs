//! When frames came, also while the kernel only begins to note it.
//!
//! It notes that from a while after it was asked to, when a worker of its own has had its turn. A frame from before has the time at
//! which it is *read*, and the next, which came later, may have one that is earlier.

use std::time::SystemTime;

/// A time that is earlier than the last by more than this is from a clock that was set, in nanoseconds.
const CLOCK_SET_NS: i64 = 1_000_000_000;

/// What is known of the times of a socket's frames.
#[derive(Debug)]
pub(super) enum Arrival {
    /// No frame has shown yet that the kernel notes when they come. The time of the last one.
    Beginning(i64),
    /// The kernel notes it.
    Noted,
}

impl Arrival {
    pub(super) const NEW: Self = Self::Beginning(i64::MIN);

    /// The time at which a frame is asked for, where [`Arrival::time`] wants to know it.
    pub(super) fn asked(&self) -> i64 {
        if matches!(self, Self::Beginning(_)) { now_ns() } else { i64::MAX }
    }

    /// The time of a frame that came at `noted` as the kernel has it, and was asked for at `asked`. Never earlier than the last, until
    /// one shows that the kernel notes when they come: it was there before it was asked for, and came after the last.
    pub(super) fn time(&mut self, noted: i64, asked: i64) -> i64 {
        let Self::Beginning(last) = *self else { return noted };
        let earlier = last.saturating_sub(noted);
        if (noted < asked && earlier <= 0) || earlier > CLOCK_SET_NS {
            *self = Self::Noted;
            return noted;
        }
        let time = noted.max(last);
        *self = Self::Beginning(time);
        time
    }
}

/// The time that the kernel gives frames, now.
pub(super) fn now_ns() -> i64 {
    let since = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH).unwrap_or_default();
    i64::try_from(since.as_nanos()).unwrap_or(i64::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    const S: i64 = CLOCK_SET_NS;

    /// The times of frames that the kernel says came then, and that were asked for then.
    fn times<const N: usize>(frames: [(i64, i64); N]) -> [i64; N] {
        let mut arrival = Arrival::NEW;
        frames.map(|(noted, asked)| arrival.time(noted, asked))
    }

    #[test]
    fn a_frame_that_was_noted_is_not_before_one_that_was_not() {
        // The first two came before the kernel began, and have the times at which they are read.
        assert_eq!(
            times([(505, 500), (512, 510), (100, 520), (101, 530), (600, 610)]),
            [505, 512, 512, 512, 600]
        );
    }

    #[test]
    fn once_the_kernel_notes_them_the_times_are_its_own() {
        assert_eq!(times([(100, 500), (90, 510), (80, 520)]), [100, 90, 80]);
        // Of one that was waited for nothing is known, and the next shows it.
        assert_eq!(times([(505, 500), (600, 610), (590, 620)]), [505, 600, 590]);
    }

    #[test]
    fn a_clock_that_is_set_back_is_followed() {
        assert_eq!(times([(9 * S, 8 * S), (7 * S, 7 * S), (6 * S, 5 * S)]), [9 * S, 7 * S, 6 * S]);
    }
}
