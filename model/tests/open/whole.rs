//! Nothing is left out.

use std::collections::{BTreeMap, HashSet};
use std::sync::Mutex;
use std::thread;

use adsdv_model::{Open, Report, State, Vectors, explore, goals, properties, state_machines, verify};
use adsdv_spec::{Control, Edition, Machine, Readings, Timing};
use stateright::Model as _;

use crate::{SHORT, machine, options, reachable, some_choices_alone};

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
    // Version 3.0 is what it was, however many editions come.
    assert_eq!(exploration.states, 200_779);
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

/// A condition that no row of a state mentions decides nothing there: each makes twice the steps, or fewer where two exclude one another.
#[test]
fn further_conditions_make_more_steps_and_show_nothing_else() {
    let explored = |further| {
        let options = adsdv_model::Options { further, ..options(Vectors::Every, SHORT) };
        explore(machine(SHORT, Readings::DEFAULT), options, |_| {})
    };
    let [none, one, three] = [0, 1, 3].map(explored);
    for more in [&one, &three] {
        assert!(more.complete && more.broken.is_empty() && more.missed.is_empty());
        assert_eq!(more.states, none.states);
    }
    assert!(none.transitions < one.transitions && one.transitions <= 2 * none.transitions);
    assert!(one.transitions < three.transitions && three.transitions <= 4 * one.transitions);
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
    for readings in some_choices_alone() {
        let report = verify(machine(SHORT, readings), options(Vectors::Read, SHORT), |_| {});
        let Report { exploration, runs, .. } = report;
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

/// From each state that can be reached, all input vectors lead to the same states as those that are read, break the same
/// properties and reach the same goals. So the two explorations are the same: one goes along the other here, and each state is
/// looked at once.
#[test]
fn all_input_vectors_and_those_that_are_read_show_the_same() {
    // Even shorter timers have a step of each kind: long before they elapse, just before, and after.
    let short = |edition: &Edition, readings| {
        let ms = 3 * edition.rules.timing.cycle_ms;
        let timing = Timing { ready_dwell_ms: ms, ebs_timer_ms: ms, ..edition.rules.timing };
        Machine::new(edition.with_timing(timing), readings)
    };
    let of_default = some_choices_alone().map(|readings| short(Edition::DEFAULT, readings));
    let of_others = state_machines().filter(|edition| edition.version != Edition::DEFAULT.version);
    let of_others = of_others.map(|edition| short(edition, edition.readings));
    let machines: Mutex<Vec<Machine>> = Mutex::new(of_default.chain(of_others).collect());
    let threads = thread::available_parallelism().map_or(1, usize::from);
    thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                loop {
                    let Some(machine) = machines.lock().expect("nobody failed").pop() else { break };
                    all_and_read_show_the_same(&machine);
                }
            });
        }
    });
}

fn all_and_read_show_the_same(machine: &Machine) {
    let (document, of) = (machine.edition().rules.timing, (machine.edition().version, machine.readings()));
    let [every, read] = [Vectors::Every, Vectors::Read].map(|vectors| Open::new(*machine, document, vectors));
    let mut level: Vec<(State, State)> = every.init_states().into_iter().zip(read.init_states()).collect();
    let mut known: HashSet<Control> = level.iter().map(|(state, _)| *state.control()).collect();
    while !level.is_empty() {
        let mut next = Vec::new();
        for (by_every, by_read) in &level {
            let ((shown, ways), (shown_read, ways_read)) = (look(&every, by_every), look(&read, by_read));
            let control = by_every.control();
            assert_eq!(shown, shown_read, "{of:?}: what shows at {control:?}");
            let only = |a: &Ways, b: &Ways| a.keys().find(|after| !b.contains_key(after)).copied();
            let differ = (only(&ways, &ways_read), only(&ways_read, &ways));
            assert_eq!(differ, (None, None), "{of:?}: where steps from {control:?} lead");
            // Both have the same control states, in the same order.
            let after = ways.into_values().zip(ways_read.into_values());
            next.extend(after.filter(|(after, _)| known.insert(*after.control())));
        }
        level = next;
    }
    assert_eq!(known.len(), reachable(machine, Vectors::Read).len(), "{of:?}: all of it");
}

/// The states after a step, by their control states.
type Ways = BTreeMap<Control, State>;

/// What the steps out of a state show, by the names of what they break or reach, and where they lead.
fn look(model: &Open, state: &State) -> (BTreeMap<&'static str, bool>, Ways) {
    let shown = model.properties().into_iter();
    let shown = shown.map(|property| (property.name, (property.condition)(model, state)));
    let after = model.next_states(state).into_iter().map(|after| (*after.control(), after));
    (shown.collect(), after.collect())
}
