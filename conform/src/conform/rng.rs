//! Chance that is the same for the same seed, on every machine.

use adsdv_oracle::chance::SplitMix64;

/// A source of numbers.
#[derive(Clone, Debug)]
pub(super) struct Rng(SplitMix64);

impl Rng {
    /// That of one run of a seed.
    pub(super) fn new(seed: u64, run: u64) -> Self {
        let start = SplitMix64(seed).bits();
        Self(SplitMix64(start ^ run.wrapping_mul(0x9E37_79B9_7F4A_7C15)))
    }

    /// A number below `end`; 0 if that is 0.
    pub(super) fn below(&mut self, end: usize) -> usize {
        self.0.below(end)
    }

    /// Whether something happens that does so `times` out of a hundred.
    pub(super) fn percent(&mut self, times: usize) -> bool {
        self.below(100) < times
    }

    /// One of these; `None` if there is none.
    pub(super) fn pick<T: Copy>(&mut self, from: &[T]) -> Option<T> {
        from.get(self.below(from.len())).copied()
    }
}
