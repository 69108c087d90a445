//! Choices that a fuzzer makes.

use adsdv_spec::{Edition, Readings};
use arbitrary::{Arbitrary, Unstructured};

use crate::world::{Chance, any_readings};

/// The bytes of an input as a source of choices. When they are used up, everything is 0.
#[derive(Debug)]
pub struct Bytes<'a>(pub Unstructured<'a>);

impl<'a> Bytes<'a> {
    /// Choices from these bytes.
    pub fn new(bytes: &'a [u8]) -> Self {
        Self(Unstructured::new(bytes))
    }

    /// Whether there are any bytes left.
    pub fn are_left(&self) -> bool {
        !self.0.is_empty()
    }

    /// Any value of a type; its default if the bytes do not make one.
    pub fn any<T: Arbitrary<'a> + Default>(&mut self) -> T {
        self.0.arbitrary().unwrap_or_default()
    }

    /// All the bytes that are left.
    pub fn rest(&mut self) -> &'a [u8] {
        let len = self.0.len();
        self.0.bytes(len).unwrap_or_default()
    }

    /// At most so many bytes.
    pub fn some(&mut self, most: usize) -> &'a [u8] {
        let len = usize::try_from(self.below(most as u64 + 1)).unwrap_or_default().min(self.0.len());
        self.0.bytes(len).unwrap_or_default()
    }

    /// Any edition: 3.0 if the bytes are used up.
    pub fn edition(&mut self) -> &'static Edition {
        self.pick(Edition::ALL)
    }

    /// Any answers to the questions that an edition leaves open, mostly the usual ones.
    pub fn readings(&mut self, edition: &Edition) -> Readings {
        any_readings(self, edition)
    }
}

impl Chance for Bytes<'_> {
    fn below(&mut self, n: u64) -> u64 {
        self.0.int_in_range(0..=n.saturating_sub(1)).unwrap_or(0)
    }
}
