//! What the theorems of `readings.rs` catch: a machine that answers the question of the reading otherwise.

use adsdv_proofs::readings::CHOICES;
use adsdv_proofs::subject::Subject;
use adsdv_spec::{Control, Inputs, Machine, Outputs};

use crate::Mutant;

pub(crate) fn mutants() -> Vec<Mutant> {
    let deaf = |&(theorem, _, choice)| Mutant::new(theorem, &format!("{choice} is not heard"), Deaf);
    CHOICES.iter().map(deaf).collect()
}

/// Whatever was chosen, the machine follows the defaults.
#[derive(Clone)]
struct Deaf;

impl Subject for Deaf {
    fn step_of(
        &self,
        machine: &Machine,
        before: &Control,
        inputs: &Inputs,
        dt_ms: u32,
    ) -> (Control, Outputs) {
        Machine::new(*machine.edition(), machine.edition().readings).step(before, inputs, dt_ms)
    }
}
