//! What was known when: the recent past, as long as a window can reach back.

use std::collections::VecDeque;

use adsdv_spec::{AsState, Atoms, Knowledge};

/// What is known from a moment on.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Moment {
    pub(crate) t: i64,
    pub(crate) known: Knowledge,
    pub(crate) state: Option<AsState>,
    /// What is known only because a silence seems to have hidden nothing.
    pub(crate) filled: Atoms,
}

/// How far back a window can reach.
const HORIZON_NS: i64 = 600_000_000;
/// A bound for logs in which something changes at every frame.
const MAX_MOMENTS: usize = 1024;

/// The recent moments, ascending; the first may lie before the horizon, because it is in force there.
#[derive(Debug)]
pub(crate) struct History {
    moments: VecDeque<Moment>,
}

impl History {
    pub(crate) fn new() -> Self {
        Self { moments: VecDeque::with_capacity(256) }
    }

    pub(crate) fn clear(&mut self) {
        self.moments.clear();
    }

    /// From `t` on, this is known.
    pub(crate) fn push(&mut self, t: i64, known: Knowledge, state: Option<AsState>) {
        self.moments.push_back(Moment { t, known, state, filled: Atoms::NONE });
        while self.moments.len() > MAX_MOMENTS
            || self.moments.get(1).is_some_and(|second| second.t <= t - HORIZON_NS)
        {
            self.moments.pop_front();
        }
    }

    /// The moments in force somewhere between `start` and `end`, both included.
    pub(crate) fn between(&self, start: i64, end: i64) -> impl Iterator<Item = &Moment> {
        let after = self.moments.partition_point(|moment| moment.t <= start);
        let first = after.saturating_sub(1);
        self.moments.range(first..).take_while(move |moment| moment.t <= end)
    }

    /// What is known of all of the time between `start` and `end`.
    pub(crate) fn throughout(&self, start: i64, end: i64) -> Knowledge {
        let mut moments = self.between(start, end);
        match moments.next() {
            Some(first) if first.t <= start => {
                moments.fold(first.known, |all, moment| all.meet(moment.known))
            }
            _ => Knowledge::NOTHING,
        }
    }

    /// Makes up for a silence that turned out to hide nothing: since `start`, these atoms had these values.
    pub(crate) fn fill(&mut self, start: i64, scope: Atoms, values: Atoms) {
        for moment in self.moments.iter_mut().rev().take_while(|moment| moment.t >= start) {
            moment.known = moment.known.learn(scope, values);
            moment.filled = moment.filled.union(scope);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn after(times: impl IntoIterator<Item = i64>) -> usize {
        let mut history = History::new();
        times.into_iter().for_each(|t| history.push(t, Knowledge::NOTHING, None));
        history.moments.len()
    }

    #[test]
    fn what_no_window_reaches_is_forgotten_and_the_moment_in_force_is_kept() {
        let second = 1_000_000_000;
        assert_eq!(after([second, 2 * second, 3 * second]), 2);
        assert_eq!(after([0, 1, HORIZON_NS]), 3);
        assert_eq!(after([0, 1, HORIZON_NS + 1]), 2);
        let tenth = second / 10;
        assert_eq!(after([-10 * second, -10 * second + tenth, -10 * second + 2 * tenth]), 3, "before 1970");
    }

    #[test]
    fn no_log_makes_it_grow_without_bound() {
        assert_eq!(after((0..).take(5 * MAX_MOMENTS)), MAX_MOMENTS);
        assert_eq!(after(std::iter::repeat_n(0, 5 * MAX_MOMENTS)), MAX_MOMENTS, "all at once");
    }
}
