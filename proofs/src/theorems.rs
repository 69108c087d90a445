//! The list of all theorems, to run them without Kani.

use crate::kani::{self, Outcome, Runs};

/// A theorem: a harness, and how it is run without Kani.
#[derive(Clone, Copy, Debug)]
pub struct Theorem {
    /// The file that it stands in, as a module path, such as `adsdv_proofs::figure2`.
    pub module: &'static str,
    /// The name of the harness.
    pub name: &'static str,
    /// The harness.
    pub harness: fn(),
    /// How it is run.
    pub runs: Runs,
}

impl Theorem {
    /// The theorem of this name; names are unique.
    pub fn find(name: &str) -> Option<&'static Self> {
        all().find(|theorem| theorem.name == name)
    }

    /// Runs the harness, on values drawn from this seed if they are drawn at random.
    pub fn check(&self, seed: u64) -> Outcome {
        kani::check(self.harness, self.runs, seed)
    }
}

/// How often a harness runs on random values.
pub const RANDOM_RUNS: u32 = 40_000;

/// Every theorem.
pub fn all() -> impl Iterator<Item = &'static Theorem> {
    let files = [
        crate::totality::THEOREMS,
        crate::invariant::THEOREMS,
        crate::safety::off::THEOREMS,
        crate::safety::ready::THEOREMS,
        crate::safety::driving::THEOREMS,
        crate::safety::finished::THEOREMS,
        crate::safety::emergency_brake::THEOREMS,
        crate::safety::every_state::THEOREMS,
        crate::safety::v4_0::THEOREMS,
        crate::figure2::THEOREMS,
        crate::readings::THEOREMS,
        crate::time::THEOREMS,
        crate::factoring::THEOREMS,
        crate::network::THEOREMS,
        crate::independence::THEOREMS,
        crate::handshake::THEOREMS,
        crate::codec::ai::THEOREMS,
        crate::codec::vcu::THEOREMS,
        crate::codec::log::THEOREMS,
        crate::codec::v4_0::THEOREMS,
        crate::codec::v2026::THEOREMS,
        crate::codec::devices::THEOREMS,
        crate::codec::any::THEOREMS,
        crate::codec::table::THEOREMS,
        crate::codec::quantities::THEOREMS,
        crate::codec::reserved::THEOREMS,
        crate::outputs::THEOREMS,
        crate::outputs_of_4_0::THEOREMS,
        crate::outputs_of_2026::THEOREMS,
        crate::truth::THEOREMS,
        crate::belief::span::THEOREMS,
        crate::belief::handshakes::THEOREMS,
        crate::belief::glimpse::THEOREMS,
        crate::belief::atoms::THEOREMS,
        crate::belief::outcomes::THEOREMS,
        crate::belief::remember::THEOREMS,
        crate::belief::causes::THEOREMS,
        crate::belief::joins::THEOREMS,
    ];
    files.into_iter().flatten()
}
