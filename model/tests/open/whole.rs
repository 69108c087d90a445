//! Nothing is left out.

use std::collections::HashSet;

use adsdv_model::{Report, Vectors, explore, goals, properties, verify};
use adsdv_spec::{Control, Edition, Machine, Readings};

use crate::{SHORT, each_choice_alone, machine, options, reachable};

#[test]
fn the_reference_keeps_every_property_with_the_real_times() {
    let exploration =
        explore(Machine::REFERENCE, options(Vectors::Read, Edition::DEFAULT.rules.timing), |_| {});
    let broken: Vec<_> = exploration.broken.iter().map(|property| property.name).collect();
    let missed: Vec<_> = exploration.missed.iter().map(|goal| goal.name).collect();
    let dead: Vec<_> =
        exploration.parts.iter().filter(|(_, decides)| !decides).map(|(p, _)| p.to_string()).collect();
    assert_eq!((broken, missed, dead), (vec![], vec![], vec![]));
    assert!(exploration.complete && exploration.holds());
    // Stateright keeps fingerprints. Had two states had the same one, it would have found fewer.
    let exactly = reachable(&Machine::REFERENCE, Vectors::Read);
    assert_eq!(exploration.states, exactly.len() as u64);
}

#[test]
fn an_exploration_with_two_threads_finds_the_same() {
    let one = options(Vectors::Read, SHORT);
    let [one, two] = [1, 2].map(|threads| {
        explore(machine(SHORT, Readings::DEFAULT), adsdv_model::Options { threads, ..one }, |_| {})
    });
    assert!(one.complete && two.complete);
    assert_eq!((one.states, one.transitions), (two.states, two.transitions));
}

/// What a broken table does to everything else must not end the exploration early.
#[test]
fn an_exploration_that_finds_much_still_goes_to_its_end() {
    let mutation = adsdv_spec::Mutation::all(Edition::DEFAULT).find(|m| m.to_string() == "3.7: dropped");
    let edition = mutation.expect("3.7 is a row").apply(&Edition::DEFAULT.with_timing(SHORT));
    let machine = Machine::new(edition, Readings::DEFAULT);
    let exploration = explore(machine, options(Vectors::Read, SHORT), |_| {});
    assert!(exploration.broken.len() >= 7, "much is broken");
    assert!(exploration.complete);
    assert_eq!(exploration.states, reachable(&machine, Vectors::Read).len() as u64);
}

/// What is gathered from every step, and what stateright finds, is the same.
#[test]
fn a_run_is_found_for_everything_that_is_decided() {
    for readings in each_choice_alone() {
        let report = verify(machine(SHORT, readings), options(Vectors::Read, SHORT), |_| {});
        let Report { exploration, runs } = report;
        for property in properties(Edition::DEFAULT) {
            let broken = exploration.broken.iter().any(|broken| broken.name == property.name);
            assert_eq!(broken, runs.contains_key(property.name), "{}, {readings}", property.name);
        }
        for goal in goals(Edition::DEFAULT) {
            let missed = exploration.missed.contains(goal);
            assert_eq!(!missed, runs.contains_key(goal.name), "{}, {readings}", goal.name);
        }
    }
}

/// The runs that are reported do what they are reported for, and are the shortest that do.
#[test]
fn a_run_ends_with_the_step_that_reaches_its_goal() {
    let machine = machine(SHORT, Readings::DEFAULT);
    let report = verify(machine, options(Vectors::Read, SHORT), |_| {});
    for goal in goals(Edition::DEFAULT) {
        let Some(run) = report.runs.get(goal.name) else { panic!("{} is not reached", goal.name) };
        let mut control = adsdv_spec::Control::INITIAL;
        for (place, action) in run.iter().enumerate() {
            let after = action.apply(&machine, &control);
            assert_eq!(
                goal.is_reached(&control, &after),
                place + 1 == run.len(),
                "{} at step {place}",
                goal.name
            );
            control = after;
        }
    }
    let length = |name| report.runs.get(name).map(Vec::len);
    // AS_READY; the dwell, at the end of which "Go" is off; "Go"; FINISHED; ASMS off.
    assert_eq!(length("whole-mission"), Some(1 + 8 + 1 + 1 + 1));
    assert_eq!(length("arrow-3.9"), Some(1 + 1 + 8), "AS_READY, EMERGENCY_BRAKE, and its timer");
}

#[test]
fn all_input_vectors_and_those_that_are_read_show_the_same() {
    for readings in each_choice_alone() {
        let machine = machine(SHORT, readings);
        let [every, read] = [Vectors::Every, Vectors::Read].map(|vectors| {
            let exploration = explore(machine, options(vectors, SHORT), |_| {});
            assert!(exploration.complete);
            let broken: Vec<_> = exploration.broken.iter().map(|property| property.name).collect();
            let missed: Vec<_> = exploration.missed.iter().map(|goal| goal.name).collect();
            (exploration.states, broken, missed)
        });
        assert_eq!(every, read, "{readings}");
        let [every, read] = [Vectors::Every, Vectors::Read].map(|vectors| reachable(&machine, vectors));
        let only = |a: &HashSet<Control>, b: &HashSet<Control>| a.difference(b).next().copied();
        assert_eq!((only(&every, &read), only(&read, &every)), (None, None), "{readings}");
    }
}
