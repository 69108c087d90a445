//! How often the model steps.

use adsdv_spec::Edition;

use crate::document::DEFAULT;

/// The VCU's cycle, which is the model's, and the same in every edition. That steps of any length are right is for the proofs.
pub(crate) const CYCLE_MS: u32 = {
    let cycle_ms = DEFAULT.rules.timing.cycle_ms;
    let mut place = 0;
    while place < Edition::ALL.len() {
        assert!(Edition::ALL[place].rules.timing.cycle_ms == cycle_ms, "the model steps every edition alike");
        place += 1;
    }
    cycle_ms as u32
};
