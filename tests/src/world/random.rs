//! Random numbers that are the same in every run.

use adsdv_oracle::chance::SplitMix64;

use super::Chance;

/// What is drawn from a seed. Its numbers stay as they are: TESTING.md has what was measured with them, and the corpora of
/// the fuzzers what was drawn.
#[derive(Clone, Debug)]
pub struct Random(SplitMix64);

impl Random {
    /// What is drawn from this seed.
    pub const fn with_seed(seed: u64) -> Self {
        Self(SplitMix64(seed))
    }

    /// The next 64 random bits.
    pub const fn bits(&mut self) -> u64 {
        self.0.bits()
    }
}

impl Chance for Random {
    fn below(&mut self, n: u64) -> u64 {
        self.bits() % n.max(1)
    }
}
