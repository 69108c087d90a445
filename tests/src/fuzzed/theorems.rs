//! The theorems of `adsdv-proofs`: the first two bytes pick the theorem, the others are the values that it draws.

use std::sync::LazyLock;

use adsdv_proofs::kani;
use adsdv_proofs::theorems::{self, Theorem};

static THEOREMS: LazyLock<Vec<&Theorem>> = LazyLock::new(|| theorems::all().collect());

/// The body.
pub fn body(bytes: &[u8]) {
    let Some((&place, values)) = bytes.split_first_chunk() else { return };
    if let Some(theorem) = THEOREMS.get(usize::from(u16::from_le_bytes(place)) % THEOREMS.len()) {
        kani::replay(theorem.harness, values);
    }
}
