//! It kills every mutation, takes every row, and shows every condition, fault, choice and limit to matter.

use std::collections::{BTreeMap, HashSet};

use adsdv_conform::suite::{self, Kind, Test};
use adsdv_spec::{Atom, Choice, Edition, Machine, Mutation, Row, Rules, Term};

use crate::tests;

/// The rows and terms that the default readings of an edition have.
fn terms(edition: &Edition) -> impl Iterator<Item = (&Row, &Term)> {
    let rows = edition.rules.table.rows().iter();
    let terms = rows.flat_map(|row| row.terms().iter().map(move |term| (row, term)));
    terms.filter(|(_, term)| term.readings.is_subset(edition.readings.choices()))
}

/// An edition under its default readings.
fn reference(edition: &Edition) -> Machine {
    Machine::new(*edition, edition.readings)
}

/// The same, and under each other answer.
fn machines(edition: &Edition) -> Vec<Machine> {
    let others = edition.alternatives();
    let others = others.iter().map(|choice| Machine::new(*edition, edition.readings.with(choice)));
    std::iter::once(reference(edition)).chain(others).collect()
}

/// Of each edition, how many mutations change some behaviour, and how many change nothing.
const MUTATIONS: &[(&str, usize, usize)] = &[("3.0", 199, 3), ("4.0", 207, 2), ("2026", 207, 2)];

#[test]
fn every_mutation_is_killed_but_those_that_change_nothing() {
    for edition in Edition::ALL {
        let (version, proof) = (edition.version, suite::prove(edition, &suite::generate(edition)));
        assert_eq!(proof.survivors, Vec::<String>::new(), "{version}");
        assert!(proof.is_complete() && proof.killed() == proof.mutants, "{version}");
        let found = (version, proof.mutants, proof.equivalent.len());
        assert!(MUTATIONS.contains(&found), "`MUTATIONS` here needs {found:?}: {:?}", proof.equivalent);
    }
}

/// Whatever answer is the default: the suite is made for it, and is as complete.
#[test]
fn every_mutation_is_killed_whatever_the_default_answers_are() {
    for choice in Edition::V4_0.alternatives().iter() {
        let edition = Edition { readings: Edition::V4_0.readings.with(choice), ..Edition::V4_0 };
        let proof = suite::prove(&edition, &suite::generate(&edition));
        // These matter under two other answers at once only.
        let expected: &[&str] = match choice {
            Choice::PowerCycleNotLatched => {
                &["3.1 term 1: power-cycle-needed dropped", "3.1 term 2: power-cycle-needed dropped"]
            }
            _ => &[],
        };
        assert_eq!(proof.survivors, expected, "{choice}");
    }
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

/// How often each alternative is taken in the tests of an edition, under its default readings and under each other answer:
/// where a fault of the battery opens the circuit, it is never its own alternative that is taken.
fn taken(edition: &Edition) -> BTreeMap<(u8, u8), usize> {
    let mut taken = BTreeMap::new();
    let machines = machines(edition);
    for test in suite::generate(edition) {
        for (_, outputs) in machines.iter().flat_map(|machine| test.scenario.run(machine)) {
            if let Some(by) = outputs.taken {
                *taken.entry((by.row, by.term)).or_default() += 1;
            }
        }
    }
    taken
}

#[test]
fn every_row_and_every_alternative_is_taken() {
    for edition in Edition::ALL {
        let taken = taken(edition);
        for (place, row) in (0u8..).zip(edition.rules.table.rows()) {
            for (alternative, term) in (0u8..).zip(row.terms()) {
                if term.readings.is_subset(edition.choices) {
                    let name = format!("{} {} term {alternative}", edition.version, row.section);
                    assert!(taken.contains_key(&(place, alternative)), "{name}");
                }
            }
        }
    }
}

/// For each condition there are two steps from the same control state after the same time that differ in nothing that is
/// read but in it, one of which takes the row by that alternative.
#[test]
fn every_condition_is_shown_to_matter_on_its_own() {
    for edition in Edition::ALL {
        conditions_matter(edition);
    }
}

fn conditions_matter(edition: &Edition) {
    let machine = reference(edition);
    let mut steps = Vec::new();
    for test in suite::generate(edition) {
        let mut control = adsdv_spec::Control::INITIAL;
        for (step, (after, outputs)) in test.scenario.steps.iter().zip(test.scenario.run(&machine)) {
            steps.push((control.state, outputs));
            control = after;
            assert_eq!(after.state, outputs.state, "{step:?}");
        }
    }
    for (row, term) in terms(edition) {
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
    for edition in Edition::ALL {
        faults_and_choices_matter(edition);
    }
}

fn faults_and_choices_matter(edition: &Edition) {
    let (machine, tests) = (reference(edition), suite::generate(edition));
    // There may be a fault that the default answers never raise.
    let machines = machines(edition);
    let runs = tests.iter().flat_map(|test| machines.iter().map(move |machine| (test, machine)));
    let controls = runs.flat_map(|(test, machine)| test.scenario.run(machine));
    let causes: HashSet<_> = controls.map(|(control, _)| control.shutdown_cause).collect();
    for fault in machine.edition().faults.iter() {
        assert!(causes.contains(&fault.cause()), "{fault}");
    }
    for choice in edition.alternatives().iter() {
        let other = Machine::new(*edition, edition.readings.with(choice));
        let tells = |test: &&Test| test.scenario.shown(&machine).ne(test.scenario.shown(&other));
        assert!(tests.iter().filter(tells).any(|test| test.reading == Some(choice.reading())), "{choice}");
    }
}

#[test]
fn every_limit_is_tried_below_at_and_above() {
    for edition in Edition::ALL {
        limits_are_tried(edition);
    }
}

fn limits_are_tried(edition: &Edition) {
    let tests = suite::generate(edition);
    let names: HashSet<&str> = tests.iter().map(|test| test.name.as_str()).collect();
    let Rules { timing, thresholds, .. } = edition.rules;
    for rpm in [-1, 0, 1].map(|beside| thresholds.wheel_speed.raw() + beside) {
        for wheel in ["fl", "fr", "rl", "rr"] {
            assert!(names.contains(format!("wheel-{wheel}-{rpm}-rpm").as_str()));
        }
    }
    for silence in thresholds.missed_ms.iter().flat_map(|&limit| [limit - 1, limit, limit + 1]) {
        for message in ["status", "drive_f", "drive_r", "steer", "brake"] {
            let name = format!("missed-{message}_silence_ms-{silence}");
            assert!(names.contains(name.as_str()), "{name}");
        }
    }
    let mut steps: HashSet<u32> = HashSet::new();
    for test in &tests {
        steps.extend(test.scenario.steps.iter().map(|step| step.dt_ms));
    }
    for limit in [timing.ready_dwell_ms, timing.ebs_timer_ms, timing.handshake_ms] {
        for beside in [limit - 1, limit, limit + 1] {
            assert!(steps.contains(&beside.into()), "{beside} ms");
        }
    }
}
