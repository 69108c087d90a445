//! `adsdv suite`: the conformance test suite, and the proof that it is complete.

use std::fmt::Write as _;

use adsdv_conform::suite::{self, Kind, Proof, Test};
use adsdv_spec::Edition;
use serde::Serialize;

use crate::args::{ChosenEdition, SuiteArgs};
use crate::error::Error;
use crate::status::Status;
use crate::{json, output, pins};

pub(crate) fn run(args: &SuiteArgs) -> Result<Status, Error> {
    let chosen = args.edition.chosen()?;
    let edition = chosen.edition();
    let tests = suite::generate(edition);
    if args.prove {
        let proof = suite::prove(edition, &tests);
        output::plain(&if args.json {
            json::line(&ProofJson::of(edition, &tests, &proof))
        } else {
            text(chosen, &tests, &proof)
        })?;
        return Ok(if proof.is_complete() { Status::Conforms } else { Status::Violates });
    }
    let machine = pins::machine(edition, &args.readings)?;
    let lines: Vec<String> = tests.iter().map(|test| test.to_line(&machine) + "\n").collect();
    output::plain(&lines.concat())?;
    Ok(Status::Conforms)
}

/// How many tests and steps a kind has.
#[derive(Serialize)]
struct KindJson {
    kind: &'static str,
    tests: usize,
    steps: usize,
}

#[derive(Serialize)]
struct ProofJson<'a> {
    schema: u32,
    edition: &'static str,
    tests: usize,
    steps: usize,
    kinds: Vec<KindJson>,
    mutants: usize,
    killed: usize,
    survivors: &'a [String],
    equivalent: Vec<EquivalentJson<'a>>,
}

#[derive(Serialize)]
struct EquivalentJson<'a> {
    mutation: &'a str,
    reason: &'static str,
}

impl<'a> ProofJson<'a> {
    fn of(edition: &Edition, tests: &[Test], proof: &'a Proof) -> Self {
        let equivalent = |(mutation, reason): &'a (String, &'static str)| EquivalentJson { mutation, reason };
        Self {
            schema: json::SCHEMA,
            edition: edition.version,
            tests: tests.len(),
            steps: steps(tests.iter()),
            kinds: kinds(tests),
            mutants: proof.mutants,
            killed: proof.killed(),
            survivors: &proof.survivors,
            equivalent: proof.equivalent.iter().map(equivalent).collect(),
        }
    }
}

fn kinds(tests: &[Test]) -> Vec<KindJson> {
    let of = |kind: Kind| tests.iter().filter(move |test| test.kind == kind);
    let count = |kind: Kind| KindJson { kind: kind.name(), tests: of(kind).count(), steps: steps(of(kind)) };
    Kind::ALL.into_iter().filter(|kind| *kind != Kind::Written).map(count).collect()
}

fn steps<'a>(tests: impl Iterator<Item = &'a Test>) -> usize {
    tests.map(|test| test.scenario.steps.len()).sum()
}

/// The proof for a person.
fn text(chosen: ChosenEdition, tests: &[Test], proof: &Proof) -> String {
    let mut text = format!("{chosen}\n\n");
    let longest = tests.iter().map(|test| test.scenario.steps.len()).max().unwrap_or_default();
    // Writing to a string does not fail.
    let _ = writeln!(
        text,
        "SUITE\n  {} tests, {} steps, at most {longest} each\n",
        tests.len(),
        steps(tests.iter())
    );
    let _ = writeln!(text, "  {:10} {:>6} {:>6}", "KIND", "TESTS", "STEPS");
    for KindJson { kind, tests, steps } in kinds(tests) {
        let _ = writeln!(text, "  {kind:10} {tests:6} {steps:6}");
    }
    text.push_str("\nMUTATIONS OF THE TABLE, THE TIMES AND THE THRESHOLDS\n");
    let _ = writeln!(text, "  killed {} of {}", proof.killed(), proof.mutants);
    for survivor in &proof.survivors {
        let _ = writeln!(text, "  lives: {survivor}");
    }
    for (mutation, reason) in &proof.equivalent {
        let _ = writeln!(text, "  changes nothing: {mutation}: {reason}");
    }
    text.push_str(if proof.is_complete() { "\ncomplete\n" } else { "\nnot complete\n" });
    text
}
