//! Verification: the open model, explored to its end, and the shortest runs that show what came of it.
//!
//! [`explore`] decides: it tries every step of every control state, and remembers what any of them breaks or reaches.
//! [`verify`] also finds a shortest run for each of these, with stateright's own search for examples and
//! counterexamples.

use std::collections::{BTreeSet, HashMap};
use std::sync::atomic::Ordering;
use std::thread;
use std::time::{Duration, Instant};

use adsdv_spec::{AsState, Choice, Control, Machine, Observation, Timing};
use stateright::{Checker, HasDiscoveries, Model, Path};

use crate::action::Action;
use crate::document::{DEFAULT, Document};
use crate::goals::{Goal, goals};
use crate::look::Engine;
use crate::moot::moot;
use crate::open::{Open, Seen, State};
use crate::parts::Part;
use crate::properties::PROPERTIES;
use crate::property::{Harm, Property};
use crate::step::{CYCLE_MS, Step};
use crate::vectors::Vectors;

/// How to explore.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Options {
    /// Which input vectors are tried.
    pub vectors: Vectors,
    /// How many threads explore.
    pub threads: usize,
    /// The times that the properties speak of: the document's, but for a model with other timers.
    pub document: Timing,
    /// How steps are made: both engines find the same.
    pub engine: Engine,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            vectors: Vectors::Every,
            threads: thread::available_parallelism().map_or(1, usize::from),
            document: DEFAULT.rules.timing,
            engine: Engine::default(),
        }
    }
}

/// How far an exploration has come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// Control states that were looked at.
    pub states: u64,
    /// Steps that were made.
    pub steps: u64,
    /// How many steps away from the power cycle the farthest of them is.
    pub depth: usize,
    /// How far away the farthest of all is expected to be: both timers, one after the other.
    pub expected_depth: usize,
}

/// What an exploration showed.
#[derive(Clone, Debug)]
pub struct Exploration {
    /// How many control states can be reached.
    pub states: u64,
    /// How many steps lead out of them, one for each input vector.
    pub transitions: u64,
    /// How many steps away from the power cycle the farthest of them is, by the paths that were found: with one thread,
    /// shortest ones.
    pub depth: usize,
    /// How long it took.
    pub time: Duration,
    /// Whether every step out of every control state was made. Without this, nothing is verified.
    pub complete: bool,
    /// The properties that some step breaks.
    pub broken: Vec<&'static Property>,
    /// What must be reachable and is not.
    pub missed: Vec<Goal>,
    /// The parts of the table, and whether each decides some step.
    pub parts: Vec<(Part, bool)>,
}

impl Exploration {
    /// Whether all properties hold, all goals are reached, and no part of the table is dead, for certain.
    pub fn holds(&self) -> bool {
        self.complete
            && self.broken.is_empty()
            && self.missed.is_empty()
            && self.parts.iter().all(|(_, decides)| *decides)
    }
}

/// An exploration, and the runs that show what it found.
#[derive(Clone, Debug)]
pub struct Report {
    /// The exploration.
    pub exploration: Exploration,
    /// The shortest run that breaks each property that is broken, and that reaches each goal that is reached, by name.
    pub runs: HashMap<&'static str, Vec<Action>>,
    /// The parts of the table that decide no step, and would if one question were answered otherwise: the first such
    /// answer.
    pub moot: Vec<(Part, Choice)>,
}

/// Explores the open model of a machine to its end, and finds the runs that show what it found.
pub fn verify(machine: Machine, options: Options, progress: impl FnMut(Progress)) -> Report {
    let exploration = explore(machine, options, progress);
    let dead = exploration.parts.iter().filter(|(_, decides)| !decides);
    let dead: Vec<Part> = dead.map(|(part, _)| part.clone()).collect();
    let moot = moot(&machine, &dead, options.threads, options.engine);
    Report { exploration, runs: runs(&machine, options.document, options.engine), moot }
}

/// Explores the open model of a machine to its end.
pub fn explore(machine: Machine, options: Options, mut progress: impl FnMut(Progress)) -> Exploration {
    /// Between two looks at how far it has come: short beside the shortest exploration.
    const PACE: Duration = Duration::from_millis(2);
    let expected_depth = expected_depth(&machine.edition().rules.timing);
    let model = Open::of(&machine, &options).with_parts();
    to_the_end(model, options.threads, |depth, seen| {
        while let Some(depth) = depth() {
            progress(Progress {
                states: seen.states.load(Ordering::Relaxed),
                steps: seen.steps.load(Ordering::Relaxed),
                depth,
                expected_depth,
            });
            thread::sleep(PACE);
        }
    })
}

/// About how many cycles away from the power cycle the farthest state is: both timers behind one another.
fn expected_depth(timing: &Timing) -> usize {
    (usize::from(timing.ready_dwell_ms) + usize::from(timing.ebs_timer_ms)) / CYCLE_MS as usize
}

/// The same without progress, and without a look at the parts of the table: it reports none.
pub fn explore_quietly(machine: &Machine, options: &Options) -> Exploration {
    to_the_end(Open::of(machine, options), options.threads, |_, _| {})
}

/// Explores to the end; `wait` may ask, meanwhile, how deep it is, which is `None` once it is done.
fn to_the_end(
    model: Open,
    threads: usize,
    wait: impl FnOnce(&dyn Fn() -> Option<usize>, &Seen),
) -> Exploration {
    let begin = Instant::now();
    let goals = goals(Document::of_machine(model.machine()).edition);
    let seen = model.seen();
    let checker = checker(model.unasked(), threads, [NOTHING].into());
    wait(&|| (!checker.is_done()).then(|| checker.max_depth()), &seen);
    let checker = checker.join();
    let time = begin.elapsed();
    let (broken, reached) = (seen.broken.load(Ordering::Relaxed), seen.reached.load(Ordering::Relaxed));
    let states = checker.unique_state_count() as u64;
    Exploration {
        states,
        transitions: seen.steps.load(Ordering::Relaxed),
        depth: checker.max_depth(),
        time,
        complete: seen.expanded.load(Ordering::Relaxed) == states,
        broken: at(PROPERTIES.iter(), |place| broken >> place & 1 == 1),
        missed: at(goals.iter().copied(), |place| reached >> place & 1 == 0),
        parts: checker.model().parts().map_or_else(Vec::new, |parts| parts.all().collect()),
    }
}

/// Those whose place in a list is as asked for.
fn at<T>(all: impl Iterator<Item = T>, place: impl Fn(usize) -> bool) -> Vec<T> {
    all.enumerate().filter(|(index, _)| place(*index)).map(|(_, item)| item).collect()
}

/// A breadth-first search that ends when it has found all of these, or, with a name that nothing has, when there is nothing
/// left.
fn checker(model: Open, threads: usize, until: BTreeSet<&'static str>) -> impl Checker<Open> {
    model.checker().threads(threads).finish_when(HasDiscoveries::AllOf(until)).spawn_bfs()
}

/// The name of no property: a search for it goes to the end.
const NOTHING: &str = "no property";

/// The shortest run that breaks each property that is broken, and that reaches each goal that is reached.
pub(crate) fn runs(
    machine: &Machine,
    document: Timing,
    engine: Engine,
) -> HashMap<&'static str, Vec<Action>> {
    runs_for(machine, document, engine, [NOTHING].into())
}

/// The same, of a search that ends when it has those for all of these names.
pub(crate) fn runs_for(
    machine: &Machine,
    document: Timing,
    engine: Engine,
    names: BTreeSet<&'static str>,
) -> HashMap<&'static str, Vec<Action>> {
    // With one thread, the first path to a state is a shortest one.
    let model = Open::new(*machine, document, Vectors::Read).with_engine(engine);
    let checker = checker(model, 1, names).join();
    let model = checker.model();
    let found = checker.discoveries().into_iter();
    found.map(|(name, path)| (name, model.run(path, name))).collect()
}

impl Open {
    fn of(machine: &Machine, options: &Options) -> Self {
        Self::new(*machine, options.document, options.vectors).with_engine(options.engine)
    }

    /// The way to a state, and a step out of it that breaks the property or reaches the goal of this name.
    fn run(&self, path: Path<State, Action>, name: &str) -> Vec<Action> {
        if let Some(property) = Property::find(name) {
            let breaks = |control: &Control, seen| {
                !property.holds(self.machine(), &Step::of(self.machine(), self.document(), *control, seen))
            };
            let run = self.run_to(path, breaks);
            return if property.harm == Harm::SetsOff { self.setting_off(run) } else { run };
        }
        let goal = goals(Document::of_machine(self.machine()).edition).iter().find(|goal| goal.name == name);
        let after = |control: &Control, seen| self.machine().react(control, seen, CYCLE_MS).control;
        self.run_to(path, |control, seen| {
            goal.is_some_and(|goal| goal.is_reached(control, &after(control, seen)))
        })
    }

    /// The way to a state, and a step out of it that shows what was looked for: of all such steps the one that differs
    /// least from the step before, so that nothing else happens in it.
    fn run_to(
        &self,
        path: Path<State, Action>,
        shows: impl Fn(&Control, Observation) -> bool,
    ) -> Vec<Action> {
        let last = *path.last_state().control();
        let mut actions = path.into_actions();
        let before = actions.iter().rev().find_map(|action| match action {
            Action::Step(seen) => Some(*seen),
            Action::PowerCycle => None,
        });
        let steps = self.steps(&last);
        let showing = steps.iter().copied().filter(|&seen| shows(&last, seen));
        let nearest = showing.min_by_key(|&seen| distance(seen, before.unwrap_or_default()));
        actions.extend(nearest.map(Action::Step));
        actions
    }

    /// A run that ends in AS_READY, with the step that sets off if one can follow: what the run is about is seen there.
    fn setting_off(&self, mut run: Vec<Action>) -> Vec<Action> {
        let apply = |control, action: &Action| action.apply(self.machine(), &control);
        let end = run.iter().fold(Control::INITIAL, apply);
        if end.state == AsState::Ready {
            let sets_off = |action: &Action| action.apply(self.machine(), &end).state == AsState::Driving;
            run.extend(self.steps(&end).iter().copied().map(Action::Step).find(sets_off));
        }
        run
    }
}

/// How many conditions and faults differ.
fn distance(a: Observation, b: Observation) -> u32 {
    let atoms = u32::from(a.atoms()) ^ u32::from(b.atoms());
    let faults = u16::from(a.faults()) ^ u16::from(b.faults());
    atoms.count_ones() + faults.count_ones()
}

#[cfg(test)]
mod tests {
    use adsdv_spec::{Atom, Atoms, Edition, Fault, Faults, Readings};

    use super::*;
    use crate::short_timers::SHORT_TIMERS;

    fn explored() -> Exploration {
        let machine = Machine::new(Edition::DEFAULT.with_timing(SHORT_TIMERS), Readings::DEFAULT);
        let options =
            Options { vectors: Vectors::Read, threads: 1, document: SHORT_TIMERS, ..Options::default() };
        explore(machine, options, |progress| assert_eq!(progress.expected_depth, 16))
    }

    #[test]
    fn it_holds_if_all_of_it_was_seen_and_nothing_failed() {
        let found = explored();
        assert!(found.holds(), "{found:?}");
        let incomplete = Exploration { complete: false, ..found.clone() };
        let broken = Exploration { broken: PROPERTIES.iter().take(1).collect(), ..found.clone() };
        let missed = Exploration {
            missed: goals(Edition::DEFAULT).iter().copied().take(1).collect(),
            ..found.clone()
        };
        let parts = found.parts.iter().take(1).map(|(part, _)| (part.clone(), false)).collect();
        let dead = Exploration { parts, ..found };
        assert!([incomplete, broken, missed, dead].iter().all(|found| !found.holds()));
    }

    #[test]
    fn each_difference_counts() {
        let seen = |atoms: &[Atom], faults| Observation::new(Atoms::of(atoms), faults);
        let (one, other) =
            (seen(&[Atom::Asms, Atom::Tsms], Faults::NONE), seen(&[Atom::Asms, Atom::GoOn], FAULT));
        // Tsms, GoOn, the fault, and that the circuit is open.
        assert_eq!((distance(one, other), distance(one, one), distance(other, other)), (4, 0, 0));
    }

    const FAULT: Faults = Faults::NONE.with(Fault::HvilOpenFault);

    /// Who waits can ask until the last state has been seen.
    #[test]
    fn how_deep_it_is_can_be_asked_to_the_end() {
        let machine = Machine::new(Edition::DEFAULT.with_timing(SHORT_TIMERS), Readings::DEFAULT);
        let mut expanded = 0;
        let found = to_the_end(Open::new(machine, SHORT_TIMERS, Vectors::Few), 1, |depth, seen| {
            while depth().is_some() {
                std::thread::yield_now();
            }
            expanded = seen.expanded.load(Ordering::Relaxed);
        });
        assert_eq!(expanded, found.states);
    }

    #[test]
    fn the_timers_make_it_as_deep_as_it_is() {
        assert_eq!(expected_depth(&Edition::DEFAULT.rules.timing), 2000);
        let (expected, depth) = (expected_depth(&SHORT_TIMERS), explored().depth);
        assert!((expected..expected + 20).contains(&depth), "{depth}");
    }
}
