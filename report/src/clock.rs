//! The time of a frame as the judge gives it: since the first frame, and never backwards.

/// Follows the clock of a log.
#[derive(Debug)]
pub(crate) struct Clock {
    window_ns: i64,
    /// What is added to the log's own time, once there was a frame.
    offset: Option<i64>,
    now: i64,
}

impl Clock {
    pub(crate) fn new(window_ms: u32) -> Self {
        Self { window_ns: i64::from(window_ms) * 1_000_000, offset: None, now: 0 }
    }

    /// The time of the last frame.
    pub(crate) const fn now(&self) -> i64 {
        self.now
    }

    /// A frame came, with this time. One that is a little early was shuffled; at more than that, the clock was set back, and
    /// what follows comes after all that was.
    pub(crate) fn at(&mut self, time_ns: i64) -> i64 {
        let offset = *self.offset.get_or_insert(time_ns.saturating_neg());
        let t = time_ns.saturating_add(offset);
        let back = self.now.saturating_sub(t);
        if back > self.window_ns {
            self.offset = Some(offset.saturating_add(back));
        }
        self.now = self.now.max(t);
        self.now
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn time_never_goes_back() {
        let mut clock = Clock::new(50);
        let ms = |ms: i64| ms * 1_000_000;
        let times = [1000, 1010, 1005, 1020, 500, 510, 520].map(|t| clock.at(ms(t)) / ms(1));
        assert_eq!(times, [0, 10, 10, 20, 20, 30, 40]);
        assert_eq!(clock.now(), ms(40));
        let mut clock = Clock::new(0);
        assert_eq!([i64::MAX, 0, i64::MAX].map(|t| clock.at(t)), [0, 0, i64::MAX]);
    }
}
