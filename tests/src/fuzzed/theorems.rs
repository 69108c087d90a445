//! The theorems of `adsdv-proofs`: the first byte picks the theorem, the others are the values that it draws.

use std::sync::LazyLock;

use adsdv_proofs::kani;
use adsdv_proofs::theorems::{self, Theorem};

static THEOREMS: LazyLock<Vec<&Theorem>> = LazyLock::new(|| theorems::all().collect());

/// The body.
pub fn body(bytes: &[u8]) {
    if let Some((&first, values)) = bytes.split_first() {
        // More of the theorems than there are bytes would go untried.
        assert!(THEOREMS.len() <= 256);
        if let Some(theorem) = THEOREMS.get(usize::from(first) % THEOREMS.len()) {
            kani::replay(theorem.harness, values);
        }
    }
}
