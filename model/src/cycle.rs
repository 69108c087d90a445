//! How often the model steps.

use adsdv_spec::Machine;

/// The cycle of a VCU, which is the model's, in milliseconds. That steps of any length are right is for the proofs.
pub(crate) const fn cycle_ms(machine: &Machine) -> u32 {
    machine.edition().rules.timing.cycle_ms as u32
}
