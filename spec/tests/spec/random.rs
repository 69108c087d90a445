//! Random numbers that are the same in every run. What a test draws from them stands beside the test.

/// The xorshift generator of Marsaglia, from a seed that is not 0.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    /// The next 64 random bits.
    pub(crate) fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }
}
