//! Every theorem, run without Kani: one test each.

use adsdv_proofs::kani::Complaint;
use adsdv_proofs::seed;
use adsdv_proofs::theorems::{self, Theorem};
use libtest_mimic::{Arguments, Failed, Trial};

fn check(theorem: &'static Theorem) -> Result<(), Failed> {
    let seed = seed::seed();
    let outcome = theorem.check(seed);
    let complaint = if seed == seed::USUAL {
        outcome.complaint(theorem.runs)
    } else {
        // That the usual values reach every case is enough: that others do not is nothing wrong.
        outcome.failure.map(Complaint::Failed)
    };
    let Some(complaint) = complaint else { return Ok(()) };
    let again = seed::again(seed, env!("CARGO_PKG_NAME"), env!("CARGO_CRATE_NAME"), theorem.name);
    Err(format!("{complaint}\nAgain, with the seed {seed}: {again}").into())
}

fn main() {
    let trial = |theorem: &'static Theorem| Trial::test(theorem.name, move || check(theorem));
    let trials = theorems::all().map(trial).collect();
    libtest_mimic::run(&Arguments::from_args(), trials).exit();
}
