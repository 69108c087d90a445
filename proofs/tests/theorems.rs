//! Every theorem, run without Kani: one test each.

use adsdv_proofs::theorems::{self, Theorem};
use libtest_mimic::{Arguments, Failed, Trial};

fn check(theorem: &'static Theorem) -> Result<(), Failed> {
    theorem.check().complaint(theorem.runs).map_or(Ok(()), |complaint| Err(complaint.to_string().into()))
}

fn main() {
    let trial = |theorem: &'static Theorem| Trial::test(theorem.name, move || check(theorem));
    let trials = theorems::all().map(trial).collect();
    libtest_mimic::run(&Arguments::from_args(), trials).exit();
}
