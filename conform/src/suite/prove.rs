//! Whether the suite tells every mutation of the specification from it.

use adsdv_spec::{Edition, Machine, Mutation, Readings};

use super::Test;

/// What the mutations came to.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Proof {
    /// How many mutations change some behaviour.
    pub mutants: usize,
    /// Those that no test tells from the specification, by name, such as `3.7 term 1: dropped`.
    pub survivors: Vec<String>,
    /// Those that change nothing, each with the reason.
    pub equivalent: Vec<(String, &'static str)>,
}

impl Proof {
    /// How many mutations some test tells from the specification.
    pub fn killed(&self) -> usize {
        self.mutants - self.survivors.len()
    }

    /// Whether all are.
    pub fn is_complete(&self) -> bool {
        self.survivors.is_empty()
    }
}

/// The mutations that behave like the specification under every reading, each with the reason.
const EQUIVALENT: [(&str, &str); 4] = [
    ("3.1 term 0: in every reading", "what asks for both implies what the other two readings ask for"),
    ("3.7 term 4: in every reading", "under the other reading no change of MISSION_STATUS is recorded"),
    ("3.7 term 6: in every reading", "under the other reading no change of DIRECTION_REQUEST is recorded"),
    ("3.7 term 9: fault dropped", "a fault of the battery is one that opens the circuit, and shows as that"),
];

/// Tries every mutation of a version of the interface: it is killed if some test shows something else than the
/// specification does, under the default readings or under one other answer.
pub fn prove(edition: &Edition, tests: &[Test]) -> Proof {
    let mut proof = Proof { mutants: 0, survivors: Vec::new(), equivalent: Vec::new() };
    for mutation in Mutation::all(edition) {
        let name = mutation.to_string();
        let killed = readings(edition).any(|readings| {
            let specified = Machine::new(*edition, readings);
            let mutant = Machine::new(mutation.apply(edition), readings);
            tests.iter().any(|test| test.scenario.shown(&specified).ne(test.scenario.shown(&mutant)))
        });
        match EQUIVALENT.iter().find(|(equivalent, _)| *equivalent == name) {
            // One that a test distinguishes after all is a mutant like any other.
            Some(&(_, reason)) if !killed => proof.equivalent.push((name, reason)),
            _ => {
                proof.mutants += 1;
                if !killed {
                    proof.survivors.push(name);
                }
            }
        }
    }
    proof
}

/// The default readings, and then each other answer: some terms are there, and some conditions matter, under another one only.
fn readings(edition: &Edition) -> impl Iterator<Item = Readings> {
    let usual = edition.readings;
    let others = edition.alternatives();
    let others: Vec<Readings> = others.iter().map(|choice| usual.with(choice)).collect();
    std::iter::once(usual).chain(others)
}
