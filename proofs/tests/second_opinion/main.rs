//! A second opinion of the VCU: the table of Figure 2, run by [`Machine`], against an independent transcription of the
//! document's text.
//!
//! - [`words`](adsdv_proofs::words), in the crate: sections 2.4, 3 and 4 as plain `if`s, written from the text alone.
//! - `compare`: one step of both, side by side.
//! - `random`: long runs of random raw inputs, boundary values among them.
//! - `exhaustive`: every combination of the conditions that a state looks at, from every control state on a grid of time.
//! - `mutants`: the specification with one thing changed; the transcription must differ from each, which shows
//!   that the two comparisons see what they claim to see.

mod compare;
mod exhaustive;
mod mutants;
mod random;

use adsdv_spec::table::Row;
use adsdv_spec::{Choice, Edition, Machine, Readings};

use crate::exhaustive::explore;
use crate::random::{Prng, Run};

/// The default readings of an edition, and each other choice alone.
fn one_choice_each(edition: &Edition) -> impl Iterator<Item = Readings> + use<> {
    let (usual, others) = (edition.readings, edition.alternatives().iter());
    std::iter::once(usual).chain(others.map(move |choice| usual.with(choice)))
}

/// Any combination of choices.
fn any_readings(prng: &mut Prng, edition: &Edition) -> Readings {
    edition.questions().fold(edition.readings, |readings, reading| {
        let choices: Vec<Choice> = edition.choices.of_reading(reading).collect();
        readings.with(prng.pick(&choices))
    })
}

/// Every row of the table is taken at least this often in a run, or the run says too little.
const OFTEN: u32 = 50;

fn assert_agreement(run: &Run, machine: &Machine) {
    let (Edition { version, rules, .. }, readings) = (machine.edition(), machine.readings());
    if let Some(disagreement) = &run.disagreement {
        panic!("{version}, readings [{readings}]: {disagreement}");
    }
    for (row, taken) in rules.table.rows().iter().zip(run.taken) {
        assert!(
            taken >= OFTEN,
            "{version}, readings [{readings}]: section {} was taken only {taken} times",
            row.section
        );
    }
}

//= SM-1, SM-2, SM-9 to SM-18, MSG-9, RDY-1 to RDY-5, DRV-4 to DRV-9, DRV-11, DRV-12, DRV-14, DRV-15, FIN-4
//= FTO-1, RTE-1 to RTE-8, RTO-1, DTE-1 to DTE-5, FTE-1, ETO-1 to ETO-3, IMP-1 to IMP-4
//= HS-1, HS-4, HS-6 to HS-10, HS-15, HS-16, MSG-54 to MSG-64, D-12 to D-18, D-22 to D-27, D-36, D-44, D-45
#[test]
fn random_runs_agree_under_the_default_readings() {
    for edition in Edition::ALL {
        let machine = Machine::new(**edition, edition.readings);
        assert_agreement(&Run::of(&machine, &mut Prng::new(1), 500_000), &machine);
    }
}

//= D-1 to D-11
#[test]
fn random_runs_agree_under_each_choice_alone() {
    for edition in Edition::ALL {
        for (seed, readings) in (2..).zip(one_choice_each(edition)) {
            let machine = Machine::new(**edition, readings);
            assert_agreement(&Run::of(&machine, &mut Prng::new(seed), 100_000), &machine);
        }
    }
}

#[test]
fn random_runs_agree_under_random_combinations_of_choices() {
    let mut prng = Prng::new(100);
    for _ in 0..40 {
        let edition = prng.pick(Edition::ALL);
        let machine = Machine::new(*edition, any_readings(&mut prng, edition));
        assert_agreement(&Run::of(&machine, &mut prng, 40_000), &machine);
    }
}

/// What this covers exactly stands at [`explore`]: the conditions of version 3.0. Those of the later editions are for the random runs
/// here, and for the theorems.
#[test]
fn every_combination_of_conditions_agrees_in_3_0() {
    for readings in one_choice_each(Edition::DEFAULT) {
        let exploration = explore(&Machine::new(*Edition::DEFAULT, readings));
        if let Some(disagreement) = exploration.disagreement {
            panic!("readings [{readings}]: {disagreement}");
        }
        for (row, taken) in Edition::DEFAULT.rules.table.rows().iter().zip(exploration.taken) {
            assert!(taken >= OFTEN, "readings [{readings}]: section {} was taken {taken} times", row.section);
        }
    }
}

/// A mutant that no comparison can tell apart must stand in [`mutants::EQUIVALENT`], with the reason, and one that
/// stands there must indeed behave the same.
#[test]
fn every_mutant_differs_but_the_equivalent_ones() {
    for (place, edition) in Edition::ALL.iter().enumerate() {
        // The state machine of 2026 is that of 4.0.
        if Edition::ALL.iter().take(place).any(|before| before.rules == edition.rules) {
            continue;
        }
        let survivors = mutants::all_of(edition).filter(|mutant| survives(edition, mutant));
        let survivors: Vec<_> = survivors.map(|mutant| mutant.name).collect();
        let explained = mutants::equivalent_in(edition);
        assert_eq!(
            survivors, explained,
            "{}: left: the mutants that behave like the specification; right: those that mutants.rs here has a reason for",
            edition.version
        );
    }
}

fn survives(edition: &Edition, mutant: &mutants::Mutant) -> bool {
    let machines = || one_choice_each(edition).map(|readings| Machine::new(mutant.edition, readings));
    let random = |machine: &Machine| Run::of(machine, &mut Prng::new(7), 40_000).disagreement.is_none();
    // Of the conditions of 3.0.
    let is_first = edition.version == Edition::DEFAULT.version;
    let exhaustive = |machine: &Machine| !is_first || explore(machine).disagreement.is_none();
    machines().all(|machine| random(&machine))
        && machines().filter(has_terms_of_its_own).all(|machine| exhaustive(&machine))
}

/// Whether the readings are the default, or bring a term into the table that the default does not have. To what other
/// readings take away or reorder, the random runs are enough.
fn has_terms_of_its_own(machine: &Machine) -> bool {
    let names = |choice| {
        Edition::DEFAULT.rules.table.rows().iter().flat_map(Row::terms).any(|t| t.readings.has(choice))
    };
    machine.readings().choices().iter().all(|choice| Readings::DEFAULT.is(choice) || names(choice))
}
