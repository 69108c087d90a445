//! It kills every mutation, takes every row, and shows every condition, fault, choice and limit to matter.

use std::collections::{BTreeMap, HashSet};

use adsdv_oracle::suite::{self, Kind, Test};
use adsdv_spec::{Atom, Choice, Edition, Fault, Machine, Mutation, Readings, Row, Rules, Term};

use crate::tests;

/// The rows and terms that the default readings have.
fn terms() -> impl Iterator<Item = (&'static Row, &'static Term)> {
    let rows = adsdv_spec::Edition::DEFAULT.rules.table.rows().iter();
    let terms = rows.flat_map(|row| row.terms().iter().map(move |term| (row, term)));
    terms.filter(|(_, term)| term.readings.is_subset(Readings::DEFAULT.choices()))
}

#[test]
fn every_mutation_is_killed_but_those_that_change_nothing() {
    let proof = suite::prove(Edition::DEFAULT, &tests());
    assert_eq!(proof.survivors, Vec::<String>::new());
    assert_eq!(proof.equivalent.len(), 3);
    assert!(proof.is_complete() && proof.killed() == proof.mutants && proof.mutants > 190);
}

/// The proof can fail: without the tests of conditions, of limits or of readings some mutation lives.
#[test]
fn a_suite_without_some_of_its_tests_lets_a_mutation_live() {
    for kind in [Kind::Condition, Kind::Limit, Kind::Reading] {
        let less: Vec<Test> = tests().into_iter().filter(|test| test.kind != kind).collect();
        let proof = suite::prove(Edition::DEFAULT, &less);
        assert!(!proof.is_complete(), "without {kind}");
        assert_eq!(proof.killed() + proof.survivors.len(), proof.mutants);
    }
    let proof = suite::prove(Edition::DEFAULT, &[]);
    assert_eq!(proof.killed(), 0);
}

/// A mutation that changes nothing in the document's table can change something in another: there it counts.
#[test]
fn what_changes_nothing_is_found_out_for_each_table() {
    let weaker =
        Mutation::all(Edition::DEFAULT).find(|mutation| mutation.to_string() == "3.1 term 0: asms dropped");
    let proof = suite::prove(&weaker.expect("it is one").apply(Edition::DEFAULT), &tests());
    assert_eq!(proof.survivors, Vec::<String>::new());
    let equivalent: Vec<&str> = proof.equivalent.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(equivalent, ["3.7 term 4: in every reading", "3.7 term 6: in every reading"]);
}

/// How often each alternative is taken in the tests.
fn taken() -> BTreeMap<(u8, u8), usize> {
    let mut taken = BTreeMap::new();
    for test in tests() {
        for (_, outputs) in test.scenario.run(&Machine::REFERENCE) {
            if let Some(by) = outputs.taken {
                *taken.entry((by.row, by.term)).or_default() += 1;
            }
        }
    }
    taken
}

#[test]
fn every_row_and_every_alternative_is_taken() {
    let taken = taken();
    for (place, row) in (0u8..).zip(adsdv_spec::Edition::DEFAULT.rules.table.rows()) {
        for (alternative, term) in (0u8..).zip(row.terms()) {
            if term.readings.is_subset(Readings::DEFAULT.choices()) {
                assert!(taken.contains_key(&(place, alternative)), "{} term {alternative}", row.section);
            }
        }
    }
}

/// For each condition there are two steps from the same control state after the same time that differ in nothing that is
/// read but in it, one of which takes the row by that alternative.
#[test]
fn every_condition_is_shown_to_matter_on_its_own() {
    let machine = Machine::REFERENCE;
    let mut steps = Vec::new();
    for test in tests() {
        let mut control = adsdv_spec::Control::INITIAL;
        for (step, (after, outputs)) in test.scenario.steps.iter().zip(test.scenario.run(&machine)) {
            steps.push((control.state, outputs));
            control = after;
            assert_eq!(after.state, outputs.state, "{step:?}");
        }
    }
    for (row, term) in terms() {
        for (atom, value) in term.literals() {
            let matters = term.on.union(term.off).without(atom);
            let others =
                |outputs: &adsdv_spec::Outputs| outputs.atoms.intersection(matters) == term.on.without(atom);
            let with = steps.iter().any(|(from, outputs)| {
                *from == row.from
                    && others(outputs)
                    && outputs.atoms.has(atom) == value
                    && outputs.state == row.to
            });
            let without = steps.iter().any(|(from, outputs)| {
                *from == row.from
                    && others(outputs)
                    && outputs.atoms.has(atom) != value
                    && outputs.state != row.to
            });
            // The dwell is over wherever an edge of "Go" can be accepted at all: it is tried by an edge that comes early.
            let implied = atom == Atom::DwellElapsed;
            assert!(with && (without || implied), "{} {atom}: {with} {without}", row.section);
        }
    }
}

#[test]
fn every_fault_is_a_cause_and_every_other_choice_fails_a_test() {
    let machine = Machine::REFERENCE;
    let causes: HashSet<_> = tests()
        .iter()
        .flat_map(|test| {
            test.scenario.run(&machine).map(|(control, _)| control.shutdown_cause).collect::<Vec<_>>()
        })
        .collect();
    for fault in Fault::ALL {
        assert!(causes.contains(&fault.cause()), "{fault}");
    }
    let tests = tests();
    for &choice in Choice::ALL.iter().filter(|&&choice| !Readings::DEFAULT.is(choice)) {
        let other = Machine::new(*Edition::DEFAULT, Readings::DEFAULT.with(choice));
        let tells = |test: &&Test| test.scenario.shown(&machine).ne(test.scenario.shown(&other));
        assert!(tests.iter().filter(tells).any(|test| test.reading == Some(choice.reading())), "{choice}");
    }
}

#[test]
fn every_limit_is_tried_below_at_and_above() {
    let names: HashSet<String> = tests().into_iter().map(|test| test.name).collect();
    let Rules { timing, thresholds, .. } = Edition::DEFAULT.rules;
    for rpm in [-1, 0, 1].map(|beside| thresholds.wheel_speed.raw() + beside) {
        for wheel in ["fl", "fr", "rl", "rr"] {
            assert!(names.contains(&format!("wheel-{wheel}-{rpm}-rpm")));
        }
    }
    let mut steps: HashSet<u32> = HashSet::new();
    for test in tests() {
        steps.extend(test.scenario.steps.iter().map(|step| step.dt_ms));
    }
    for limit in [timing.ready_dwell_ms, timing.ebs_timer_ms, timing.handshake_ms] {
        for beside in [limit - 1, limit, limit + 1] {
            assert!(steps.contains(&beside.into()), "{beside} ms");
        }
    }
}
