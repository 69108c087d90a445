//! What the theorems of `belief/` catch: twins that know too much, or less than they could.

mod cases;
mod joins;
mod parts;

use crate::Mutant;

pub(crate) fn mutants() -> Vec<Mutant> {
    [parts::mutants(), cases::mutants(), joins::mutants()].into_iter().flatten().collect()
}
