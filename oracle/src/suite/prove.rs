//! Whether the suite tells every mutation of the specification from it.

use adsdv_spec::mutation::{Change, TermChange};
use adsdv_spec::{Choice, Edition, Machine, Mutation, Readings};

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
const EQUIVALENT: [(&str, &str); 3] = [
    ("3.1 term 0: in every reading", "what asks for both implies what the other two readings ask for"),
    ("3.7 term 4: in every reading", "under the other reading no change of MISSION_STATUS is recorded"),
    ("3.7 term 6: in every reading", "under the other reading no change of DIRECTION_REQUEST is recorded"),
];

/// Tries every mutation of a version of the interface: it is killed if some test shows something else than the
/// specification does, under readings for which the mutation can matter.
pub fn prove(edition: &Edition, tests: &[Test]) -> Proof {
    let mut proof = Proof { mutants: 0, survivors: Vec::new(), equivalent: Vec::new() };
    for mutation in Mutation::all(edition) {
        let name = mutation.to_string();
        let killed = readings(edition, &mutation).into_iter().any(|readings| {
            let specified = Machine::new(*edition, readings);
            let mutant = Machine::new(mutation.apply(edition), readings);
            tests.iter().any(|test| test.scenario.shown(&specified).ne(test.scenario.shown(&mutant)))
        });
        match EQUIVALENT.iter().find(|(equivalent, _)| *equivalent == name) {
            // One that is told apart after all is a mutant like any other.
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

/// The default readings, and, for a term that only some readings have, those that have it; for one that is put into all, the
/// others.
fn readings(edition: &Edition, mutation: &Mutation) -> Vec<Readings> {
    let mut readings = vec![edition.readings];
    let Change::Term(row, term, change) = mutation.change else { return readings };
    let term = edition.rules.table.rows().get(row).and_then(|row| row.terms().get(term));
    for choice in term.into_iter().flat_map(|term| term.readings.iter()) {
        let answers: Vec<Choice> = if change == TermChange::InEveryReading {
            choice.reading().choices().iter().copied().filter(|&other| other != choice).collect()
        } else {
            vec![choice]
        };
        readings.extend(answers.into_iter().map(|choice| edition.readings.with(choice)));
    }
    readings
}
