//! The specification with one thing changed: a literal, a term, a destination, an order, a time or a threshold.

use adsdv_spec::{Choice, Edition, Mutation};

/// A specification with one change, and what was changed.
pub(crate) struct Mutant {
    pub(crate) name: String,
    pub(crate) edition: Edition,
}

/// The mutants that behave like the specification, each with the reason.
pub(crate) const EQUIVALENT: &[(&str, &str)] = &[
    ("3.1 term 0: in every reading", "what asks for both implies what the other two readings ask for"),
    ("3.7 term 4: in every reading", "under the other reading no change of MISSION_STATUS is recorded"),
    ("3.7 term 6: in every reading", "under the other reading no change of DIRECTION_REQUEST is recorded"),
];

/// Those of version 4.0 that behave like it. What the answers that it has settled would change is never there.
const EQUIVALENT_IN_4_0: &[(&str, &str)] = &[
    ("3.1 term 0: in every reading", "what asks for both implies what the other two readings ask for"),
    ("3.7 term 9: fault dropped", "a fault of the battery is one that opens the circuit, and shows as that"),
];

/// The names of the mutants of an edition that behave like it.
#[allow(dead_code, reason = "of two tests that have this file one needs those of one edition")]
pub(crate) fn equivalent_in(edition: &Edition) -> Vec<&'static str> {
    let settled = !edition.choices.has(Choice::FaultEdge);
    let equivalent = if settled { EQUIVALENT_IN_4_0 } else { EQUIVALENT };
    equivalent.iter().map(|&(name, _)| name).collect()
}

/// Every mutant of an edition.
pub(crate) fn all_of(edition: &Edition) -> impl Iterator<Item = Mutant> + use<> {
    let edition = *edition;
    let mutations: Vec<Mutation> = Mutation::all(&edition).collect();
    let mutant =
        move |mutation: Mutation| Mutant { name: mutation.to_string(), edition: mutation.apply(&edition) };
    mutations.into_iter().map(mutant)
}
