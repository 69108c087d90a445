//! Every combination of readings: which properties fail under which, and the shortest run that shows it.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

use adsdv_spec::{AsState, Choice, Choices, Control, Edition, Machine, Reading, Readings, Timing};

use crate::action::Action;
use crate::closed::{Closed, ClosedProperty, Operator};
use crate::document::{DEFAULT, is_default};
use crate::look::Engine;
use crate::property::{Harm, Property};
use crate::run::Run;
use crate::vectors::Vectors;
use crate::verify::{Exploration, Options, explore_quietly, runs_for};

/// Timers with which all combinations are explored: longer than the handshake's by enough that everything that can
/// happen while the real ones run can happen while these do. The lemma `short-timers` says so.
pub const SHORT_TIMERS: Timing = short_timers(DEFAULT);

/// The [`SHORT_TIMERS`] of an edition.
pub const fn short_timers(edition: &Edition) -> Timing {
    let timer_ms = edition.rules.timing.handshake_ms + 3 * edition.rules.timing.cycle_ms;
    Timing { ready_dwell_ms: timer_ms, ebs_timer_ms: timer_ms, ..edition.rules.timing }
}

/// Choices that together fail something, which fewer of them do not.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Cost {
    /// The edition whose readings they are.
    pub edition: &'static Edition,
    /// The property or goal that fails, by name.
    pub name: &'static str,
    /// The choices, none of them the default; none at all: it fails under the defaults.
    pub choices: Choices,
    /// The choices of which each undoes the failure when it is made as well.
    pub undone_by: Choices,
    /// The shortest run that breaks the property, under these choices and the defaults; none for a goal.
    pub run: Option<Vec<Action>>,
}

impl Cost {
    /// The machine that fails.
    pub fn machine(&self) -> Machine {
        machine_with(self.edition, self.choices)
    }

    /// What the shortest run costs: that of the property, but a vehicle that has left AS_DRIVING does not drive on.
    pub fn harm(&self, property: &Property) -> Harm {
        let (machine, run) = (self.machine(), self.run.as_deref().unwrap_or_default());
        let end = run.iter().fold(Control::INITIAL, |control, action| action.apply(&machine, &control));
        if property.harm == Harm::DrivesOn && end.state != AsState::Driving {
            Harm::NotBraked
        } else {
            property.harm
        }
    }
}

/// The machine with these choices, and the default for every other question.
fn machine_with(edition: &Edition, choices: Choices) -> Machine {
    Machine::new(*edition, choices.iter().fold(edition.readings, Readings::with))
}

/// What the readings cost.
#[derive(Clone, Debug)]
pub struct Sweep {
    /// The edition whose readings they are.
    pub edition: &'static Edition,
    /// How many combinations there are.
    pub combinations: usize,
    /// How many steps were made in all.
    pub transitions: u64,
    /// Whether every exploration was complete.
    pub complete: bool,
    /// What fails.
    pub costs: Vec<Cost>,
    /// What fails in the closed models: with a conforming AI Computer.
    pub closed: Vec<ClosedCost>,
}

/// A choice that fails something in the closed model, all other readings being the default.
#[derive(Clone, Debug)]
pub struct ClosedCost {
    /// The property that fails.
    pub property: &'static ClosedProperty,
    /// The choice.
    pub choice: Choice,
    /// The shortest run that breaks it, with the real times.
    pub run: Run,
}

/// Each answer that is not the default, alone, with each operator: the closed models that [`sweep`] can explore.
///
/// With any operator, answers that the default edition has are left to that edition: these models take longest.
pub fn closed_models(edition: &Edition) -> impl Iterator<Item = (Choice, Operator)> {
    let elsewhere = if is_default(edition) { Choices::NONE } else { DEFAULT.choices };
    let operators = [Operator::WellBehaved, Operator::Any];
    let models =
        edition.alternatives().iter().flat_map(move |choice| operators.map(|operator| (choice, operator)));
    models.filter(move |(choice, operator)| *operator == Operator::WellBehaved || !elsewhere.has(*choice))
}

/// How many answers that are not the default come together in `model/READINGS.md`: as many as there are in the default edition,
/// and two in the others, whose questions are more.
pub fn together(edition: &Edition) -> usize {
    if is_default(edition) { usize::MAX } else { 2 }
}

/// Checks an edition of the interface under every combination of readings in which at most so many are not the default,
/// and in these closed models; `engine` makes the steps of the open ones. `progress` gets how much is done, and of how much.
pub fn sweep(
    edition: &'static Edition,
    together: usize,
    models: &[(Choice, Operator)],
    threads: usize,
    engine: Engine,
    progress: impl Fn(usize, usize) + Sync,
) -> Sweep {
    let mut all = combinations(edition);
    all.retain(|readings| others(edition, *readings).iter().count() <= together);
    let work = Work { open: all.len(), closed: models.len(), done: AtomicUsize::new(0) };
    let done = |by| {
        let (done, all) = work.add(by);
        progress(done, all);
    };
    let mut explored = explored(edition, &all, threads, engine, || done(1));
    for &(choice, operator) in models {
        explored.add_closed(edition, choice, operator, threads);
        done(work.closed_each());
    }
    let Explored { transitions, complete, failing, closed } = explored;
    let combinations: BTreeSet<Choices> = all.iter().map(|readings| others(edition, *readings)).collect();
    let mut costs = minimal(edition, failing, &combinations);
    add_runs(&mut costs, edition, engine);
    Sweep { edition, combinations: all.len(), transitions, complete, costs, closed }
}

/// How much there is to do, as explorations of the open model.
struct Work {
    open: usize,
    closed: usize,
    done: AtomicUsize,
}

impl Work {
    /// An exploration of a closed model takes about a tenth of the time of all those of the open one.
    const fn closed_each(&self) -> usize {
        self.open / 10
    }

    /// How much is done when this much more is, and of how much.
    fn add(&self, by: usize) -> (usize, usize) {
        let done = self.done.fetch_add(by, Ordering::Relaxed) + by;
        (done, self.open + self.closed * self.closed_each())
    }
}

/// What the explorations have shown.
struct Explored {
    transitions: u64,
    complete: bool,
    /// By the name of what fails in the open model, the choices under which it does.
    failing: BTreeMap<&'static str, BTreeSet<Choices>>,
    closed: Vec<ClosedCost>,
}

impl Explored {
    const NOTHING: Self =
        Self { transitions: 0, complete: true, failing: BTreeMap::new(), closed: Vec::new() };

    fn add(&mut self, others: Choices, report: &Exploration) {
        self.transitions += report.transitions;
        self.complete &= report.complete;
        for name in failed(report) {
            self.failing.entry(name).or_default().insert(others);
        }
    }

    /// Explores the closed model of an operator under a choice and otherwise the default readings.
    fn add_closed(&mut self, edition: &Edition, choice: Choice, operator: Operator, threads: usize) {
        let readings = edition.readings.with(choice);
        let model = Closed::scaled(*edition, readings, operator);
        let exploration = model.clone().explore(threads);
        self.transitions += exploration.transitions as u64;
        self.complete &= exploration.complete;
        for found in exploration.results.into_iter().filter(|found| !found.holds) {
            let machine = Machine::new(*edition, readings);
            // Shortest runs come from one thread.
            let run = model.clone().run_for(found.property.name).or(found.run);
            let inputs = run.map_or_else(Vec::new, |run| model.inputs_for(&machine, &run));
            self.closed.push(ClosedCost {
                property: found.property,
                choice,
                run: Run::seeing(&machine, inputs),
            });
        }
    }
}

/// Explores the open model under these combinations, with the short timers.
fn explored(
    edition: &Edition,
    all: &[Readings],
    threads: usize,
    engine: Engine,
    done: impl Fn() + Sync,
) -> Explored {
    let short = edition.with_timing(short_timers(edition));
    let next = AtomicUsize::new(0);
    let explored = Mutex::new(Explored::NOTHING);
    thread::scope(|scope| {
        for _ in 0..threads.max(1) {
            scope.spawn(|| {
                while let Some(readings) = all.get(next.fetch_add(1, Ordering::Relaxed)) {
                    let report = explore_quietly(&Machine::new(short, *readings), &options(edition, engine));
                    let mut explored = explored.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
                    explored.add(others(edition, *readings), &report);
                    drop(explored);
                    done();
                }
            });
        }
    });
    explored.into_inner().unwrap_or_else(std::sync::PoisonError::into_inner)
}

/// Adds the shortest runs to the properties that fail. What is shown comes from the real timers.
fn add_runs(costs: &mut [Cost], edition: &Edition, engine: Engine) {
    // A goal that is missed has no run.
    let mut broken: BTreeMap<Choices, BTreeSet<&'static str>> = BTreeMap::new();
    for cost in costs.iter().filter(|cost| Property::find(cost.name).is_some()) {
        broken.entry(cost.choices).or_default().insert(cost.name);
    }
    for (choices, names) in broken {
        let runs = runs_for(&machine_with(edition, choices), edition.rules.timing, engine, names.clone());
        for cost in costs.iter_mut().filter(|cost| cost.choices == choices && names.contains(cost.name)) {
            cost.run = runs.get(cost.name).cloned();
        }
    }
}

/// Every combination of the readings that can matter to each other. `go-signal` changes what 520h tells and no control
/// state, so that its choices need no company.
fn combinations(edition: &Edition) -> Vec<Readings> {
    let together: Vec<Reading> =
        Reading::ALL.iter().copied().filter(|reading| *reading != Reading::GoSignal).collect();
    let alone = edition.alternatives().of_reading(Reading::GoSignal);
    let alone = alone.map(|choice| edition.readings.with(choice));
    // The answer to `go-signal` is the default in all of these.
    let any = edition.choices.pin(edition.readings.choice(Reading::GoSignal));
    alone.chain(any.combinations(&together)).collect()
}

/// Each exploration has one thread: there are enough explorations for all.
const fn options(edition: &Edition, engine: Engine) -> Options {
    Options { vectors: Vectors::Few, threads: 1, document: short_timers(edition), engine }
}

/// Of all combinations under which something fails, those that fail it with fewest choices.
fn minimal(
    edition: &'static Edition,
    failing: BTreeMap<&'static str, BTreeSet<Choices>>,
    explored: &BTreeSet<Choices>,
) -> Vec<Cost> {
    let mut costs = Vec::new();
    for (name, sets) in failing {
        // Of causes that differ in their number alone, one is tried.
        let by_lemma = Property::find(name).is_none() && sets.contains(&Choices::NONE);
        for &choices in sets.iter().filter(|_| !by_lemma) {
            if !sets.iter().any(|fewer| *fewer != choices && fewer.is_subset(choices)) {
                let undone_by = undone_by(choices, &sets, explored);
                costs.push(Cost { edition, name, choices, undone_by, run: None });
            }
        }
    }
    costs
}

/// The names of what fails.
fn failed(exploration: &Exploration) -> impl Iterator<Item = &'static str> {
    let broken = exploration.broken.iter().map(|property| property.name);
    broken.chain(exploration.missed.iter().map(|goal| goal.name))
}

/// The choices that are not the default.
fn others(edition: &Edition, readings: Readings) -> Choices {
    readings.choices().difference(edition.readings.choices())
}

/// The choices that, made as well, undo a failure.
fn undone_by(choices: Choices, failing: &BTreeSet<Choices>, explored: &BTreeSet<Choices>) -> Choices {
    let undoing = Choices::ALL.iter().filter(|&choice| {
        let more = choices.with(choice);
        more != choices && explored.contains(&more) && !failing.contains(&more)
    });
    undoing.fold(Choices::NONE, Choices::with)
}

#[cfg(test)]
mod tests {
    use adsdv_spec::{Atom, Atoms, Faults, Observation};

    use super::*;
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
        let listed: Vec<(Choices, Choices)> =
            costs.iter().map(|cost| (cost.choices, cost.undone_by)).collect();
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
            assert!(!go_signal || others(EDITION, *readings).iter().count() == 1, "{readings:?}");
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
        let few: Vec<Readings> = combinations(EDITION)
            .into_iter()
            .filter(|readings| others(EDITION, *readings).iter().count() < 2)
            .collect();
        let (times, short) = (AtomicUsize::new(0), EDITION.with_timing(SHORT_TIMERS));
        let found = explored(EDITION, &few, 2, Engine::default(), || {
            times.fetch_add(1, Ordering::Relaxed);
        });
        assert_eq!(times.into_inner(), few.len());
        let mut failing = BTreeMap::<_, BTreeSet<Choices>>::new();
        let (mut steps, mut complete) = (0, Vec::new());
        for readings in few {
            let report =
                explore_quietly(&Machine::new(short, readings), &options(EDITION, Engine::default()));
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
        assert!(
            names.contains(&"conforming-ai-causes-no-emergency") && none.is_empty(),
            "{names:?}, {none:?}"
        );
        let mut all = Explored::NOTHING;
        all.add_closed(&hasty, choice, operator, 1);
        assert!(all.complete);
        all.complete = false;
        all.add_closed(Edition::DEFAULT, choice, operator, 1);
        assert!(!all.complete, "one of them was not");
        assert_eq!(all.transitions, steps + more);
        assert_eq!(all.closed.iter().map(|cost| cost.property.name).collect::<Vec<_>>(), names);
        assert!(all.closed.iter().all(|cost| cost.choice == choice));
        // What fails because it cannot happen has no run that shows it.
        assert!(all.closed.iter().any(|cost| !cost.run.cycles().is_empty()));
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
        let options =
            Options { vectors: Vectors::Few, threads: 1, document: SHORT_TIMERS, ..Options::default() };
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
}
