//! The closed model in numbers: how many states there are, and how many ways lead to them. What
//! changes which action is possible when, what it does, or when two states are the same changes a number.

use std::collections::HashSet;
use std::fmt::Write as _;

use adsdv_model::closed::{Closed, ClosedAction, ClosedState, Conduct, Found, Operator};
use adsdv_spec::{Edition, Machine, Readings, Timing};
use expect_test::expect_file;
use stateright::{Model as _, Path};

const EDITION: Edition = *Edition::DEFAULT;
const CONDUCTS: [Conduct; 4] = [Conduct::Reference, Conduct::Mute, Conduct::Hasty, Conduct::Coasting];

fn scaled(operator: Operator) -> Closed {
    Closed::scaled(EDITION, Readings::DEFAULT, operator)
}

/// A model explored to its end: its size, and what was found of each property.
fn explored(model: Closed) -> String {
    let found = model.explore(1);
    let complete = if found.complete { "complete" } else { "NOT COMPLETE" };
    let mut text = format!(
        "{} states, {} transitions, depth {}, {complete}\n",
        found.states, found.transitions, found.depth
    );
    for Found { property, holds, run } in found.results {
        let holds = if holds { "holds" } else { "fails" };
        let steps = run.map_or(String::new(), |run| format!(", a run of {} steps", run.into_actions().len()));
        let _ = writeln!(text, "  {}: {holds}{steps}", property.name);
    }
    text
}

#[test]
fn every_state_with_a_well_behaved_operator() {
    let model = || scaled(Operator::WellBehaved);
    let mut text = String::new();
    for conduct in CONDUCTS {
        let _ = writeln!(text, "{conduct:?}: {}", explored(model().with_conduct(conduct)));
    }
    for handshake_ms in [20, 40, 100] {
        let edition = EDITION.with_timing(Timing { handshake_ms, ..EDITION.rules.timing });
        let impatient = Closed::scaled(edition, Readings::DEFAULT, Operator::WellBehaved);
        let _ = writeln!(text, "{handshake_ms} ms to answer: {}", explored(impatient));
    }
    let real = Closed::new(Machine::REFERENCE, Operator::WellBehaved);
    let _ = writeln!(text, "the times of the document: {}", explored(real));
    expect_file!["explored.txt"].assert_eq(&text);
}

/// All that can happen within some actions from a state: how many states, and how many ways.
fn around(model: &Closed, begin: ClosedState, depth: usize) -> String {
    let mut known = HashSet::from([begin.clone()]);
    let (mut now, mut ways) = (vec![begin], 0);
    for _ in 0..depth {
        let mut next = Vec::new();
        for state in now {
            let mut actions = Vec::new();
            model.actions(&state, &mut actions);
            for action in actions {
                ways += 1;
                next.extend(model.next_state(&state, action).filter(|state| known.insert(state.clone())));
            }
        }
        now = next;
    }
    format!("{} states, {ways} ways", known.len())
}

fn run(name: &'static str, operator: Operator) -> Path<ClosedState, ClosedAction> {
    scaled(operator).run_for(name).expect("it is possible")
}

/// What can happen next along a mission and along a way to an emergency.
#[test]
fn what_can_happen_next() {
    let runs = [
        ("mission-can-be-finished", run("mission-can-be-finished", Operator::WellBehaved)),
        ("emergency-can-happen", run("emergency-can-happen", Operator::Any)),
    ];
    let people = Closed::explorer(Machine::REFERENCE);
    let models = vec![
        ("a well-behaved operator", scaled(Operator::WellBehaved), 4),
        ("any operator", scaled(Operator::Any), 3),
        ("any operator, and no answers", scaled(Operator::Any).with_conduct(Conduct::Mute), 3),
        ("people", people, 2),
    ];
    let mut text = String::new();
    for (whose, run) in runs {
        let states = run.into_states();
        for (who, model, depth) in &models {
            let _ = writeln!(text, "# {whose}, with {who}");
            for (place, state) in states.iter().enumerate() {
                let _ = writeln!(text, "{place:3}: {}", around(model, state.clone(), *depth));
            }
        }
    }
    expect_file!["next.txt"].assert_eq(&text);
}
