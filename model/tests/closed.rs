//! The closed model: its properties hold for the reference, and none of them holds for the wrong reason.

use adsdv_model::closed::{Closed, ClosedExploration, Conduct, Operator, Stage};
use adsdv_model::state_machines;
use adsdv_spec::messages::AsState;
use adsdv_spec::table::{Row, Table, Term};
use adsdv_spec::{Atom, Edition, Fault, Machine, Readings, Timing};
use stateright::Path;

const EDITION: Edition = *Edition::DEFAULT;

fn scaled(edition: &Edition, operator: Operator) -> Closed {
    Closed::scaled(*edition, Readings::DEFAULT, operator)
}

#[track_caller]
fn assert_all_hold(exploration: &ClosedExploration) {
    for found in &exploration.results {
        assert!(found.holds, "{}: {:#?}", found.property.name, found.run.clone().map(Path::into_actions));
    }
}

//= RDY-7, RDY-8, DRV-13, FIN-1, FIN-3, HS-13
#[test]
fn a_conforming_ai_computer_with_a_well_behaved_operator() {
    let exploration = scaled(&EDITION, Operator::WellBehaved).explore(2);
    assert_all_hold(&exploration);
    assert_eq!(exploration.results.len(), 8);
    let real = Closed::new(Machine::REFERENCE, Operator::WellBehaved).explore(2);
    assert_all_hold(&real);
    assert!(real.states > exploration.states);
}

#[test]
fn a_conforming_ai_computer_with_any_operator_and_faults() {
    let exploration = scaled(&EDITION, Operator::Any).explore(2);
    assert_all_hold(&exploration);
    assert_eq!(exploration.results.len(), 5);
    // So many states can only be counted when nothing ended the exploration early.
    assert!(exploration.states > 3_000_000, "{}", exploration.states);
}

#[test]
fn the_number_of_threads_does_not_matter() {
    let [one, two] = [1, 2].map(|threads| scaled(&EDITION, Operator::WellBehaved).explore(threads));
    assert_eq!((one.states, one.transitions), (two.states, two.transitions));
}

/// The specification with one row changed.
fn row(from: AsState, to: AsState, change: impl Fn(&mut Vec<Term>)) -> Edition {
    let rows: Vec<Row> = EDITION
        .rules
        .table
        .rows()
        .iter()
        .map(|row| {
            let mut terms = row.terms().to_vec();
            if (row.from, row.to) == (from, to) {
                change(&mut terms);
                assert_ne!(terms, row.terms(), "the row has changed");
            }
            Row::new(row.from, row.to, row.section, &terms)
        })
        .collect();
    EDITION.with_table(Table::new(&rows))
}

/// Without a condition in the terms that are reported as a fault.
fn without(fault: Fault, atom: Atom) -> Edition {
    row(AsState::Driving, AsState::EmergencyBrake, |terms| {
        for term in terms.iter_mut().filter(|term| term.fault == Some(fault)) {
            term.on = term.on.without(atom);
        }
    })
}

fn dropped(from: AsState, to: AsState) -> Edition {
    row(from, to, Vec::clear)
}

fn handshake(handshake_ms: u16) -> Edition {
    let mut edition = EDITION;
    edition.rules.timing.handshake_ms = handshake_ms;
    edition
}

/// The shortest run that violates a property.
fn violates(edition: &Edition, operator: Operator, property: &'static str) -> bool {
    scaled(edition, operator).run_for(property).is_some()
}

use AsState::{Driving, EmergencyBrake, Finished, Off, Ready};
use Operator::{Any, WellBehaved};

#[test]
fn mutants_keep_a_conforming_ai_from_finishing() {
    let name = "conforming-ai-always-finishes";
    assert!(!violates(&EDITION, WellBehaved, name));
    for (from, to) in [(Off, Ready), (Ready, Driving), (Driving, Finished), (Finished, Off)] {
        assert!(violates(&dropped(from, to), WellBehaved, name), "{from} to {to} dropped");
    }
    // "Go" is then accepted only once RUNNING, which comes after it.
    let never = row(Ready, Driving, |terms| terms[0].on = terms[0].on.with(Atom::MissionRunning));
    assert!(violates(&never, WellBehaved, name));
    let flipped = row(Driving, Finished, |terms| {
        terms[0].on = terms[0].on.without(Atom::AtRest);
        terms[0].off = terms[0].off.with(Atom::AtRest);
    });
    assert!(violates(&flipped, WellBehaved, name));
}

#[test]
fn mutants_brake_for_no_reason() {
    let name = "no-emergency-without-a-reason";
    assert!(!violates(&EDITION, WellBehaved, name));
    let go = row(Driving, EmergencyBrake, |terms| {
        let go = terms.iter_mut().find(|term| term.off.has(Atom::GoOn)).expect("the term on \"Go\"");
        (go.on, go.off) = (go.off, go.on);
    });
    assert!(violates(&go, WellBehaved, name), "\"Go\" on instead of off");
    assert!(violates(&without(Fault::AutonomousBrakingFault, Atom::Moving), WellBehaved, name));
}

#[test]
fn mutants_go_round_in_circles() {
    let name = "every-action-moves-on";
    assert!(!violates(&EDITION, WellBehaved, name));
    let flipped = row(Ready, Off, |terms| {
        (terms[0].on, terms[0].off) = (terms[0].off, terms[0].on);
    });
    assert!(violates(&flipped, WellBehaved, name), "AS_READY to AS_OFF and back");
}

#[test]
fn mutants_blame_a_conforming_ai() {
    let name = "conforming-ai-causes-no-emergency";
    let estop = row(Driving, EmergencyBrake, |terms| {
        for term in terms.iter_mut().filter(|term| term.fault == Some(Fault::AiComputerRequest)) {
            (term.on, term.off) = (term.off, term.on);
        }
    });
    let mutants = vec![
        ("1: ESTOP_REQUEST flipped", estop),
        ("6: 10 ms to answer", handshake(10)),
        ("7: NEUTRAL at rest", without(Fault::AutonomousBrakingFault, Atom::Moving)),
        ("8: FINISHED at rest", without(Fault::MissionStatusFault, Atom::Moving)),
    ];
    for (mutant, edition) in mutants {
        for operator in [WellBehaved, Any] {
            assert!(violates(&edition, operator, name), "{mutant}, {operator:?}");
        }
    }
}

#[test]
fn mutants_lose_a_conforming_ai() {
    let name = "conforming-ai-is-never-lost";
    for limit in [10, 20, 30, 40] {
        for operator in [WellBehaved, Any] {
            assert!(violates(&handshake(limit), operator, name), "{limit} ms, {operator:?}");
        }
    }
    assert!(!violates(&handshake(50), WellBehaved, name), "the bound is tight");
}

/// With the times of an edition: what is an answer in time in version 4.0 is late in version 3.0.
//= HS-13, HS-17
#[test]
fn every_edition_has_an_ai_computer_that_conforms_to_it() {
    for edition in state_machines().filter(|edition| edition.version != EDITION.version) {
        let model = |edition: &Edition| Closed::scaled(*edition, edition.readings, WellBehaved);
        assert_all_hold(&model(edition).explore(2));
        let machine = Machine::new(*edition, edition.readings);
        let real = Closed::new(machine, WellBehaved);
        assert_eq!(real.timing, edition.rules.timing);
        assert_all_hold(&real.explore(2));
        // The bound is tight.
        let timing = edition.rules.timing;
        let handshake_ms = timing.handshake_ms - timing.cycle_ms;
        let hasty = edition.with_timing(Timing { handshake_ms, ..timing });
        assert!(model(&hasty).run_for("conforming-ai-is-never-lost").is_some(), "{}", edition.version);
    }
}

#[test]
fn what_is_possible_is_not_possible_anyway() {
    let possible = |edition: &Edition, operator, name| scaled(edition, operator).run_for(name).is_some();
    for (from, to) in [(Off, Ready), (Ready, Driving), (Driving, Finished)] {
        assert!(
            !possible(&dropped(from, to), WellBehaved, "mission-can-be-finished"),
            "{from} to {to} dropped"
        );
    }
    for (from, to) in [(Off, Ready), (Ready, Driving)] {
        assert!(
            !possible(&dropped(from, to), WellBehaved, "vehicle-can-be-driven"),
            "{from} to {to} dropped"
        );
    }
    assert!(!possible(&dropped(Off, Ready), Any, "emergency-can-happen"));
    // The handshake is in no table: an AI Computer that does not answer keeps it from going round.
    let mute = scaled(&EDITION, WellBehaved).with_conduct(Conduct::Mute);
    assert!(mute.run_for("handshake-goes-round").is_none());
}

//= HS-5, FIN-3, IMP-2
#[test]
fn an_ai_computer_that_does_not_conform_is_blamed() {
    let with = |conduct, operator| scaled(&EDITION, operator).with_conduct(conduct);
    assert!(with(Conduct::Mute, Any).run_for("conforming-ai-is-never-lost").is_some());
    for (conduct, stage) in [(Conduct::Hasty, Stage::Finished), (Conduct::Coasting, Stage::Stopped)] {
        let run = with(conduct, WellBehaved).run_for("conforming-ai-causes-no-emergency").expect("a run");
        assert_eq!(run.last_state().ai.stage, stage);
        assert!(with(conduct, WellBehaved).run_for("conforming-ai-always-finishes").is_some());
    }
}

#[test]
fn what_is_no_property_has_no_run() {
    assert!(
        scaled(&EDITION, WellBehaved).run_for("emergency-can-happen").is_none(),
        "a property of the other operator"
    );
    assert!(scaled(&EDITION, Any).run_for("no such name").is_none());
}
