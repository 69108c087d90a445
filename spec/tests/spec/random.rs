//! Random numbers that are the same in every run. What a test draws from them stands beside the test.

use fastrand::Rng;

/// Where a test draws from.
pub(crate) struct Random(Rng);

impl Random {
    pub(crate) fn with_seed(seed: u64) -> Self {
        Self(Rng::with_seed(seed))
    }

    /// The next 64 random bits.
    pub(crate) fn next(&mut self) -> u64 {
        self.0.u64(..)
    }
}
