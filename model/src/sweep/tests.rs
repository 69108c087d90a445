//! What is explored adds up, and of what fails the fewest choices are told.

use std::sync::atomic::{AtomicUsize, Ordering};

use adsdv_spec::{AsState, Atom, Atoms, Control, Faults, Machine, Observation, Reading, Readings, Timing};

use super::explored::{failed, options};
use super::fewest::undone_by;
use super::*;
use crate::action::Action;
use crate::closed::Closed;
use crate::exploration::{Options, explore_quietly};
use crate::property::Harm;
use crate::short_timers::SHORT_TIMERS;
use crate::vectors::Vectors;
use crate::verify::runs;

const EDITION: &Edition = Edition::DEFAULT;

/// The sets of choices that have these places among all that are not the default.
fn sets(places: &[&[usize]]) -> BTreeSet<Choices> {
    let all: Vec<Choice> = EDITION.alternatives().iter().collect();
    let set = |places: &&[usize]| {
        places.iter().filter_map(|&place| all.get(place).copied()).fold(Choices::NONE, Choices::with)
    };
    places.iter().map(set).collect()
}

fn one(places: &[usize]) -> Choices {
    sets(&[places]).into_iter().next().expect("a set")
}

#[test]
fn the_fewest_choices_that_fail_and_what_undoes_it() {
    let explored = sets(&[&[], &[0], &[2], &[4], &[0, 2], &[0, 4], &[2, 4], &[0, 2, 4]]);
    // 0 fails alone, unless 4 is chosen as well; 2 and 4 fail only together, and with 0.
    let failing = sets(&[&[0], &[0, 2], &[2, 4], &[0, 2, 4]]);
    let costs = minimal(EDITION, BTreeMap::from([("ready-asms", failing.clone())]), &explored);
    let listed: Vec<(Choices, Choices)> = costs.iter().map(|cost| (cost.choices, cost.undone_by)).collect();
    assert_eq!(listed.len(), 2);
    assert!(listed.contains(&(one(&[0]), one(&[4]))), "{listed:?}");
    assert!(listed.contains(&(one(&[2, 4]), Choices::NONE)), "{listed:?}");
    // What was not explored undoes nothing.
    assert_eq!(undone_by(one(&[0]), &failing, &sets(&[&[0], &[0, 2]])), Choices::NONE);
}

/// A goal that is missed under the defaults, and a property that is broken under them.
#[test]
fn what_fails_anyway() {
    let explored = sets(&[&[], &[0]]);
    let fail = |name| minimal(EDITION, BTreeMap::from([(name, explored.clone())]), &explored);
    assert_eq!(fail("cause-3"), [], "fewer causes are tried: the lemma `which-fault`");
    let cost = Cost {
        edition: EDITION,
        name: "ready-asms",
        choices: Choices::NONE,
        undone_by: Choices::NONE,
        run: None,
    };
    assert_eq!(fail("ready-asms"), [cost]);
    let lost = BTreeMap::from([("arrow-3.1", sets(&[&[0]]))]);
    assert_eq!(minimal(EDITION, lost, &explored).len(), 1, "a goal that only another reading misses");
}

#[test]
fn every_combination_that_can_matter_comes_once() {
    let all = combinations(EDITION);
    let different: BTreeSet<Choices> = all.iter().map(|readings| others(EDITION, *readings)).collect();
    assert_eq!(all.len(), different.len());
    assert!(different.contains(&Choices::NONE));
    for readings in &all {
        let go_signal = !readings.is(Readings::DEFAULT.choice(Reading::GoSignal));
        assert!(!go_signal || others(EDITION, *readings).len() == 1, "{readings:?}");
    }
    let questions = EDITION.questions().filter(|reading| *reading != Reading::GoSignal);
    let together: usize = questions.map(|reading| EDITION.choices.of_reading(reading).count()).product();
    assert_eq!(all.len(), together + Reading::GoSignal.choices().len() - 1);
}

#[test]
fn what_is_done_adds_up() {
    let work = Work { open: 36, closed: 4, done: AtomicUsize::new(0) };
    assert_eq!(work.closed_each(), 3);
    assert_eq!((work.add(1), work.add(35), work.add(3)), ((1, 48), (36, 48), (39, 48)));
}

#[test]
fn what_is_explored_adds_up() {
    let few: Vec<Readings> =
        combinations(EDITION).into_iter().filter(|readings| others(EDITION, *readings).len() < 2).collect();
    let (times, short) = (AtomicUsize::new(0), EDITION.with_timing(SHORT_TIMERS));
    let found = explored(EDITION, &few, 2, Engine::default(), || {
        times.fetch_add(1, Ordering::Relaxed);
    });
    assert_eq!(times.into_inner(), few.len());
    let mut failing = BTreeMap::<_, BTreeSet<Choices>>::new();
    let (mut steps, mut complete) = (0, Vec::new());
    for readings in few {
        let report = explore_quietly(&Machine::new(short, readings), &options(EDITION, Engine::default()));
        for name in failed(&report) {
            failing.entry(name).or_default().insert(others(EDITION, readings));
        }
        steps += report.transitions;
        complete.push(report);
    }
    assert!(failing.len() > 5 && !failing.contains_key("ready-switches"), "{failing:?}");
    assert!(found.complete && found.closed.is_empty());
    assert_eq!((found.transitions, &found.failing), (steps, &failing));

    let (mut all, mut report) = (found, complete.swap_remove(0));
    report.complete = false;
    all.add(Choices::NONE, &report);
    assert!(!all.complete, "one of them was not");
    report.complete = true;
    all.add(Choices::NONE, &report);
    assert!(!all.complete, "and another does not help");
}

/// A VCU that waits too shortly for the answers of the AI Computer blames one that follows the document.
#[test]
fn what_fails_in_a_closed_model_adds_up() {
    let (hasty, choice, operator) = (
        EDITION.with_timing(Timing { handshake_ms: 10, ..Edition::DEFAULT.rules.timing }),
        Choice::GoRaw,
        Operator::WellBehaved,
    );
    let broken = |edition| {
        let found = Closed::scaled(edition, Readings::DEFAULT.with(choice), operator).explore(1);
        let broken = found.results.into_iter().filter(|found| !found.holds);
        (found.transitions as u64, broken.map(|found| found.property.name).collect::<Vec<_>>())
    };
    let [(steps, names), (more, none)] = [hasty, *Edition::DEFAULT].map(broken);
    assert!(names.contains(&"conforming-ai-causes-no-emergency") && none.is_empty(), "{names:?}, {none:?}");
    for engine in [Engine::Words, Engine::Single] {
        let mut all = Explored::NOTHING;
        all.add_closed(&hasty, &[(choice, operator)], 1, engine);
        assert!(all.complete);
        all.complete = false;
        all.add_closed(Edition::DEFAULT, &[(choice, operator)], 1, engine);
        assert!(!all.complete, "one of them was not");
        assert_eq!(all.transitions, steps + more);
        assert_eq!(all.closed.iter().map(|cost| cost.property.name).collect::<Vec<_>>(), names);
        assert!(all.closed.iter().all(|cost| cost.choice == choice));
        // What fails because it cannot happen has no run that shows it.
        assert!(all.closed.iter().any(|cost| !cost.run.cycles().is_empty()));
    }
}

/// Of short timers, as the real ones take long.
#[test]
fn properties_get_their_shortest_runs_and_goals_none() {
    let short = EDITION.with_timing(SHORT_TIMERS);
    let cost = |name, choice| Cost {
        edition: EDITION,
        name,
        choices: Choices::NONE.with(choice),
        undone_by: Choices::NONE,
        run: None,
    };
    let mut costs = [
        cost("driving-neutral", Choice::FaultEdge),
        cost("whole-mission", Choice::FaultEdge),
        cost("driving-estop", Choice::EstopEveryState),
        cost("ready-estop", Choice::EstopDriving),
    ];
    add_runs(&mut costs, &short, Engine::default());
    for cost in costs {
        let found = runs(&machine_with(&short, cost.choices), short.rules.timing, Engine::default())
            .remove(cost.name);
        assert_eq!(found.is_none(), cost.name == "driving-estop", "{}", cost.name);
        assert_eq!(cost.run, found.filter(|_| cost.name != "whole-mission"), "{}", cost.name);
    }
}

#[test]
fn what_fails_is_broken_or_missed() {
    let options = Options { vectors: Vectors::Few, threads: 1, document: SHORT_TIMERS, ..Options::default() };
    let without_rows = EDITION.with_timing(SHORT_TIMERS).with_table(adsdv_spec::table::Table::new(&[]));
    let found = explore_quietly(&Machine::new(without_rows, Readings::DEFAULT), &options);
    let names: Vec<&str> = failed(&found).collect();
    assert!(names.contains(&"whole-mission") && names.contains(&"ready-due"), "{names:?}");
    assert_eq!(names.len(), found.broken.len() + found.missed.len());
}

/// A vehicle that has left `AS_DRIVING` does not drive on, whatever it should have done in there.
#[test]
fn a_run_costs_what_its_end_allows() {
    let property = Property::find("driving-sdc").expect("it is one");
    assert_eq!(property.harm, Harm::DrivesOn);
    let cost = |run| Cost {
        edition: EDITION,
        name: property.name,
        choices: Choices::NONE,
        undone_by: Choices::NONE,
        run,
    };
    assert_eq!(cost(None).harm(property), Harm::NotBraked, "it ends in AS_OFF");
    // Into AS_READY, all answered for the dwell, and "Go".
    let ready = [Atom::Asms, Atom::Tsms, Atom::AmiSelected, Atom::MissionSelected, Atom::EbsArmed];
    let requests =
        [Atom::FrontTorqueZero, Atom::RearTorqueZero, Atom::SteerRequestZero, Atom::DirectionNeutral];
    let (mut control, mut run) = (Control::INITIAL, Vec::new());
    for cycle in 0..=502 {
        let atoms = Atoms::of(&ready)
            .union(Atoms::of(&requests).with(Atom::SteerStraight))
            .union(Atoms::when(Atom::AiHandshake, control.handshake.bit))
            .union(Atoms::when(Atom::GoOn, cycle == 502));
        let step = Action::Step(Observation::new(atoms, Faults::NONE));
        control = step.apply(&Machine::REFERENCE, &control);
        run.push(step);
    }
    assert_eq!(control.state, AsState::Driving, "{control:?}");
    let driving = Some(run);
    assert_eq!(cost(driving).harm(property), Harm::DrivesOn);
    let other = Property::find("ready-asms").expect("it is one");
    assert_eq!(cost(None).harm(other), other.harm);
}
