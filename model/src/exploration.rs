//! An exploration of the open model: it tries every step of every control state, and remembers what any of them breaks or reaches.

use std::collections::BTreeSet;
use std::sync::atomic::Ordering;
use std::thread;
use std::time::{Duration, Instant};

use adsdv_spec::{Machine, Timing};
use stateright::{Checker, HasDiscoveries, Model as _};

use crate::document::{DEFAULT, Document};
use crate::goals::{Goal, goals};
use crate::look::Engine;
use crate::open::{Open, Seen};
use crate::parts::Part;
use crate::properties::PROPERTIES;
use crate::property::Property;
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
    /// How many more conditions are varied that no step of the state depends on, as far as there are so many: what a document
    /// with more conditions would cost. They show nothing else, and so nothing needs them but a measurement.
    pub further: usize,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            vectors: Vectors::Every,
            threads: thread::available_parallelism().map_or(1, usize::from),
            document: DEFAULT.rules.timing,
            engine: Engine::default(),
            further: 0,
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
    (usize::from(timing.ready_dwell_ms) + usize::from(timing.ebs_timer_ms))
        / usize::from(timing.cycle_ms.max(1))
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
pub(crate) fn checker(model: Open, threads: usize, until: BTreeSet<&'static str>) -> impl Checker<Open> {
    model.checker().threads(threads).finish_when(HasDiscoveries::AllOf(until)).spawn_bfs()
}

/// The name of no property: a search for it goes to the end.
pub(crate) const NOTHING: &str = "no property";

impl Open {
    fn of(machine: &Machine, options: &Options) -> Self {
        Self::new(*machine, options.document, options.vectors)
            .with_engine(options.engine)
            .with_further(options.further)
    }
}

#[cfg(test)]
mod tests {
    use adsdv_spec::{Edition, Readings};

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
