//! A theorem that cannot fail says nothing: for each there is a mutant of the specification that it catches.
//!
//! Mutants of the table, the times and the thresholds are [`Mutation`](adsdv_spec::Mutation)s. What is not data is changed by putting another
//! [`Subject`] in place of the specification, which does one thing otherwise.

mod belief;
mod codec;
mod factoring;
mod figure2;
mod handshake;
mod invariant;
mod network;
mod otherwise;
mod outputs;
mod readings;
mod safety;
mod time;
mod totality;
mod truth;
mod v2026;
mod v4_0;

#[path = "../second_opinion/mutants.rs"]
mod mutations;

use adsdv_proofs::kani::Outcome;
use adsdv_proofs::seed;
use adsdv_proofs::subject::{self, Subject};
use adsdv_proofs::theorems::{self, Theorem};
use adsdv_spec::{Choice, Control, Edition, Inputs, Machine, Outputs};

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

    /// The theorem catches the mutation of version 4.0 of this name.
    fn table_of_4_0(theorem: &'static str, mutation: &str) -> Self {
        Self::new(theorem, mutation, Changed::named_in(&Edition::V4_0, mutation))
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
        Self { edition: *edition, machine: Machine::new(*edition, edition.readings) }
    }

    /// An edition with another answer to a question.
    fn read_as(edition: &Edition, choice: Choice) -> Self {
        Self { edition: *edition, machine: Machine::new(*edition, edition.readings.with(choice)) }
    }

    /// The mutation of this name.
    fn named(name: &str) -> Self {
        Self::named_in(Edition::DEFAULT, name)
    }

    /// The mutation of an edition of this name.
    fn named_in(edition: &Edition, name: &str) -> Self {
        let found = mutations::all_of(edition).find(|mutant| mutant.name == name);
        Self::of(&found.unwrap_or_else(|| panic!("there is no mutation {name:?}")).edition)
    }

    /// Its machine, if it is one of this edition, else the one that there is.
    fn or<'a>(&'a self, machine: &'a Machine) -> &'a Machine {
        if machine.edition().version == self.edition.version { &self.machine } else { machine }
    }
}

impl Subject for Changed {
    fn machine(&self) -> &Machine {
        self.or(&Machine::REFERENCE)
    }

    fn machine_of_4_0(&self) -> &Machine {
        const MACHINE: &Machine = &Machine::new(Edition::V4_0, Edition::V4_0.readings);
        self.or(MACHINE)
    }

    fn machine_of_2026(&self) -> &Machine {
        const MACHINE: &Machine = &Machine::new(Edition::V2026, Edition::V2026.readings);
        self.or(MACHINE)
    }

    fn step_of(
        &self,
        machine: &Machine,
        before: &Control,
        inputs: &Inputs,
        dt_ms: u32,
    ) -> (Control, Outputs) {
        let readings = machine.readings();
        if machine.edition().version != self.edition.version {
            machine.step(before, inputs, dt_ms)
        } else if readings == self.machine.readings() {
            self.machine.step(before, inputs, dt_ms)
        } else {
            Machine::new(self.edition, readings).step(before, inputs, dt_ms)
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
        network::mutants(),
        handshake::mutants(),
        codec::mutants(),
        outputs::mutants(),
        truth::mutants(),
        v4_0::mutants(),
        v2026::mutants(),
        belief::mutants(),
    ]
    .into_iter()
    .flatten()
}

#[test]
fn each_mutant_is_caught() {
    let mut missed = Vec::new();
    for Mutant { theorem, what, check } in mutants() {
        let found = Theorem::find(theorem).unwrap_or_else(|| panic!("there is no theorem {theorem}"));
        if check(found).failure.is_none() {
            missed.push(format!("{theorem} does not catch: {what}"));
        }
    }
    assert!(missed.is_empty(), "{missed:#?}");
}

#[test]
fn each_theorem_catches_a_mutant() {
    let caught: Vec<&str> = mutants().map(|mutant| mutant.theorem).collect();
    let without: Vec<&str> =
        theorems::all().map(|theorem| theorem.name).filter(|name| !caught.contains(name)).collect();
    assert!(without.is_empty(), "no mutant for {without:?}");
}

/// Of these mutations of an edition those that the theorems that hold its whole step against the words let pass.
fn survivors(edition: &Edition, whole: &str, of: impl Fn(&str) -> bool) -> Vec<String> {
    let of_edition = |theorem: &&Theorem| {
        let choices = adsdv_proofs::readings::CHOICES.iter();
        let mut of_edition = choices.filter(|(_, of, _)| of.version == edition.version);
        of_edition.any(|&(name, ..)| name == theorem.name)
    };
    let words = || {
        let whole = Theorem::find(whole).into_iter();
        whole.chain(adsdv_proofs::readings::THEOREMS.iter().filter(of_edition))
    };
    let survives = |mutant: &mutations::Mutant| {
        let subject = Changed::of(&mutant.edition);
        subject::with(subject, || words().all(|theorem| theorem.check(seed::USUAL).failure.is_none()))
    };
    let mutants: Vec<mutations::Mutant> =
        mutations::all_of(edition).filter(|mutant| of(&mutant.name)).collect();
    let survivors = |half: &[mutations::Mutant]| -> Vec<String> {
        half.iter().filter(|mutant| survives(mutant)).map(|mutant| mutant.name.clone()).collect()
    };
    let (one, other) = mutants.split_at(mutants.len() / 2);
    std::thread::scope(|scope| {
        let one = scope.spawn(|| survivors(one));
        let other = survivors(other);
        [one.join().expect("no theorem panics"), other].concat()
    })
}

/// What it means that they are others than expected.
const SURVIVORS: &str = "left: the mutations that the theorems on the whole step let pass; right: those that change nothing, for the \
    reasons in tests/second_opinion/mutants.rs, by the places of their terms. None at all on the left: a theorem fails of the \
    specification itself, see `cargo test -p adsdv-proofs --test theorems`";

/// The theorems that hold the whole step against the words are enough for every mutation of the data.
#[test]
fn every_mutation_is_caught_but_the_equivalent_ones() {
    let explained: Vec<&str> = mutations::EQUIVALENT.iter().map(|&(name, _)| name).collect();
    let survivors = survivors(&Edition::V3_0, "a_step_is_what_the_document_says", |_| true);
    assert_eq!(survivors, explained, "{SURVIVORS}");
}

/// The same of what version 4.0 has otherwise: the way from AS_DRIVING into EMERGENCY_BRAKE, and its numbers. All other rows
/// are those of 3.0.
#[test]
fn every_mutation_of_what_4_0_has_otherwise_is_caught() {
    let otherwise = |name: &str| !name.starts_with("3.") || name.starts_with("3.7");
    let survivors = survivors(&Edition::V4_0, "a_step_of_4_0_is_what_the_document_says", otherwise);
    // Without its own fault the term names what opens the circuit, which a fault of the battery is among.
    assert_eq!(survivors, ["3.7 term 9: fault dropped"], "{SURVIVORS}");
}
