//! A theorem that cannot fail says nothing: for each there is a mutant of the specification that it catches.
//!
//! Mutants of the table, the times and the thresholds are [`Mutation`](adsdv_spec::Mutation)s. What is not data is changed by putting another
//! [`Subject`] in place of the specification, which does one thing otherwise.

mod codec;
mod factoring;
mod figure2;
mod handshake;
mod invariant;
mod otherwise;
mod outputs;
mod readings;
mod safety;
mod time;
mod totality;
mod truth;

#[path = "../second_opinion/mutants.rs"]
mod mutations;

use adsdv_proofs::kani::Outcome;
use adsdv_proofs::seed;
use adsdv_proofs::subject::{self, Subject};
use adsdv_proofs::theorems::{self, Theorem};
use adsdv_spec::{Control, Edition, Inputs, Machine, Outputs, Readings};

/// A specification with one thing changed, and the theorem that catches it.
struct Mutant {
    theorem: &'static str,
    /// What is changed.
    what: String,
    check: Box<dyn Fn(&Theorem) -> Outcome>,
}

impl Mutant {
    /// The theorem catches this subject.
    fn new(theorem: &'static str, what: &str, subject: impl Subject + Clone + 'static) -> Self {
        let check = move |theorem: &Theorem| subject::with(subject.clone(), || theorem.check(seed::USUAL));
        Self { theorem, what: what.to_owned(), check: Box::new(check) }
    }

    /// The theorem catches the mutation of this name, such as `3.6: dropped`.
    fn table(theorem: &'static str, mutation: &str) -> Self {
        Self::new(theorem, mutation, Changed::named(mutation))
    }
}

/// A version of the interface with one thing changed.
#[derive(Clone)]
struct Changed {
    edition: Edition,
    machine: Machine,
}

impl Changed {
    fn of(edition: &Edition) -> Self {
        Self { edition: *edition, machine: Machine::new(*edition, Readings::DEFAULT) }
    }

    /// The mutation of this name.
    fn named(name: &str) -> Self {
        let found = mutations::all().find(|mutant| mutant.name == name);
        Self::of(&found.unwrap_or_else(|| panic!("there is no mutation {name:?}")).edition)
    }
}

impl Subject for Changed {
    fn machine(&self) -> &Machine {
        &self.machine
    }

    fn step_of(
        &self,
        machine: &Machine,
        before: &Control,
        inputs: &Inputs,
        dt_ms: u32,
    ) -> (Control, Outputs) {
        if machine.readings() == Readings::DEFAULT {
            self.machine.step(before, inputs, dt_ms)
        } else {
            Machine::new(self.edition, machine.readings()).step(before, inputs, dt_ms)
        }
    }
}

fn mutants() -> impl Iterator<Item = Mutant> {
    [
        totality::mutants(),
        invariant::mutants(),
        safety::mutants(),
        figure2::mutants(),
        readings::mutants(),
        time::mutants(),
        factoring::mutants(),
        handshake::mutants(),
        codec::mutants(),
        outputs::mutants(),
        truth::mutants(),
    ]
    .into_iter()
    .flatten()
}

#[test]
fn each_mutant_is_caught() {
    for Mutant { theorem, what, check } in mutants() {
        let found = Theorem::find(theorem).unwrap_or_else(|| panic!("there is no theorem {theorem}"));
        assert!(check(found).failure.is_some(), "{theorem} does not catch: {what}");
    }
}

#[test]
fn each_theorem_catches_a_mutant() {
    let caught: Vec<&str> = mutants().map(|mutant| mutant.theorem).collect();
    let without: Vec<&str> =
        theorems::all().map(|theorem| theorem.name).filter(|name| !caught.contains(name)).collect();
    assert!(without.is_empty(), "no mutant for {without:?}");
}

/// The theorems that hold the whole step against the words are enough for every mutation of the data.
#[test]
fn every_mutation_is_caught_but_the_equivalent_ones() {
    let words = || {
        let whole = Theorem::find("a_step_is_what_the_document_says").into_iter();
        whole.chain(adsdv_proofs::readings::THEOREMS)
    };
    let survives = |mutant: &mutations::Mutant| {
        let subject = Changed::of(&mutant.edition);
        subject::with(subject, || words().all(|theorem| theorem.check(seed::USUAL).failure.is_none()))
    };
    let survivors: Vec<String> = mutations::all().filter(survives).map(|mutant| mutant.name).collect();
    let explained: Vec<&str> = mutations::EQUIVALENT.iter().map(|&(name, _)| name).collect();
    assert_eq!(survivors, explained);
}
