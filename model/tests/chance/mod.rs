//! Chance that is the same in every run, so that a failure can be repeated.
#![allow(dead_code, reason = "each of the tests that share it uses some of it")]

use fastrand::Rng;

/// What is drawn from a seed.
pub(crate) struct Random(Rng);

impl Random {
    pub(crate) fn with_seed(seed: u64) -> Self {
        Self(Rng::with_seed(seed))
    }

    pub(crate) fn bits(&mut self) -> u64 {
        self.0.u64(..)
    }

    pub(crate) fn one_in(&mut self, many: u64) -> bool {
        self.0.u64(..many) == 0
    }

    pub(crate) fn below(&mut self, limit: usize) -> usize {
        self.0.usize(..limit)
    }

    pub(crate) fn one<'a, T>(&mut self, of: &'a [T]) -> &'a T {
        &of[self.below(of.len())]
    }
}
