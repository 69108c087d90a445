//! Every theorem, run without Kani: one test each; and together they come by every place that is to be covered.

mod sources;

use std::collections::{BTreeMap, BTreeSet};
use std::sync::OnceLock;

use adsdv_proofs::kani::{Complaint, Outcome};
use adsdv_proofs::seed;
use adsdv_proofs::theorems::{self, Theorem};
use libtest_mimic::{Arguments, Failed, Trial};
use sources::sources;

/// A theorem and what its runs have shown: two tests ask for it, and it is run once.
struct Run {
    theorem: &'static Theorem,
    outcome: OnceLock<Outcome>,
}

impl Run {
    fn outcome(&self) -> &Outcome {
        self.outcome.get_or_init(|| self.theorem.check(seed::seed()))
    }

    fn check(&self) -> Result<(), Failed> {
        let (seed, theorem, outcome) = (seed::seed(), self.theorem, self.outcome());
        let complaint = if seed == seed::USUAL {
            outcome.complaint(theorem.runs)
        } else {
            // That the usual values reach every case is enough: that others do not is nothing wrong.
            outcome.failure.clone().map(Complaint::Failed)
        };
        let Some(complaint) = complaint else { return Ok(()) };
        let again = seed::again(seed, env!("CARGO_PKG_NAME"), env!("CARGO_CRATE_NAME"), theorem.name);
        Err(format!("{complaint}\nAgain, with the seed {seed}: {again}").into())
    }
}

/// The name of a source file within `src`.
fn in_src(path: &str) -> String {
    path.rsplit("src/").next().unwrap_or(path).to_owned()
}

/// A place that no run comes by does not show up in any outcome: so the sources are searched for them.
fn every_place_to_be_covered_is_covered(runs: &[Run]) -> Result<(), Failed> {
    let mut written = BTreeSet::new();
    for (path, text) in sources() {
        let name = in_src(&path.to_string_lossy());
        for (number, line) in (1u32..).zip(text.lines()) {
            let code = line.split("//").next().unwrap_or_default();
            if code.contains("kani::cover!(") {
                written.insert((name.clone(), number));
            }
        }
    }
    assert!(!written.is_empty(), "there are places to be covered");
    let mut covered: BTreeMap<(String, u32), bool> = BTreeMap::new();
    for (cover, reached) in runs.iter().flat_map(|run| &run.outcome().covers) {
        *covered.entry((in_src(cover.file), cover.line)).or_default() |= *reached;
    }
    let missed: Vec<_> = written.iter().filter(|place| covered.get(place) != Some(&true)).collect();
    if missed.is_empty() { Ok(()) } else { Err(format!("no run comes by {missed:?}").into()) }
}

fn main() {
    let runs = theorems::all().map(|theorem| Run { theorem, outcome: OnceLock::new() });
    let runs: &'static [Run] = runs.collect::<Vec<_>>().leak();
    let mut trials: Vec<Trial> =
        runs.iter().map(|run| Trial::test(run.theorem.name, || run.check())).collect();
    if seed::seed() == seed::USUAL {
        // It comes last, when there is nothing left to be run for it alone.
        let covered = || every_place_to_be_covered_is_covered(runs);
        trials.push(Trial::test("every_place_to_be_covered_is_covered", covered));
    }
    libtest_mimic::run(&Arguments::from_args(), trials).exit();
}
