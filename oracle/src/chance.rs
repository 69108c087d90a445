//! Chance that stays the same, whatever version of a crate draws.

/// SplitMix64, the same numbers for the same seed on every machine and in every version.
///
/// Tests and the exam draw from the crate fastrand, which may draw otherwise in its next version. What is drawn from this one
/// stands written down: a seed of `adsdv conform` in somebody's ticket, the experiments of a diagnosis, and the figures of
/// `scripts/sensitivity.sh` and `scripts/diagnosis.sh`.
///
/// ```
/// use adsdv_oracle::chance::SplitMix64;
///
/// let mut random = SplitMix64(0);
/// assert_eq!(random.bits(), 0xE220_A839_7B1D_CDAF);
/// ```
#[derive(Clone, Debug)]
pub struct SplitMix64(pub u64);

impl SplitMix64 {
    /// The next 64 bits.
    pub const fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// A number below `end`, each as likely as another; 0 if that is 0.
    pub fn below(&mut self, end: usize) -> usize {
        let scaled = (u128::from(self.bits()) * end as u128) >> 64;
        usize::try_from(scaled).unwrap_or(0)
    }
}
