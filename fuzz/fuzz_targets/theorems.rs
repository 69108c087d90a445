//! The theorems of `adsdv-proofs`, on values that the fuzzer chooses: the first byte picks the theorem, the others are what
//! it draws.

#![no_main]

use std::sync::LazyLock;

use adsdv_proofs::kani;
use adsdv_proofs::theorems::{self, Theorem};
use libfuzzer_sys::{Corpus, fuzz_target};

static THEOREMS: LazyLock<Vec<&Theorem>> = LazyLock::new(|| theorems::all().collect());

fuzz_target!(|data: &[u8]| -> Corpus {
    let Some((&first, values)) = data.split_first() else { return Corpus::Reject };
    let Some(theorem) = THEOREMS.get(usize::from(first)) else { return Corpus::Reject };
    kani::replay(theorem.harness, values);
    Corpus::Keep
});
