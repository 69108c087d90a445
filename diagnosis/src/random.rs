//! Numbers that look random.

/// The next of a row of numbers that look random, the same every time. They stay as they are: which experiments are made hangs on
/// them, and with that what tests hold as printed and TESTING.md as measured.
#[derive(Clone, Debug)]
pub(crate) struct Random(pub(crate) u64);

impl Random {
    /// The next number below an end.
    pub(crate) fn below(&mut self, end: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        usize::try_from(self.0 >> 33).unwrap_or(0) % end.max(1)
    }
}
