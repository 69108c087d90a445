//! The explorations: the open model under each combination, and families of closed ones.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::thread;

use adsdv_spec::{Choice, Choices, Edition, Machine, Readings};

use super::combinations::others;
use super::costs::ClosedCost;
use crate::closed::{Closed, Operator, explore_family};
use crate::exploration::{Exploration, Options, explore_quietly};
use crate::look::Engine;
use crate::run::Run;
use crate::short_timers::short_timers;
use crate::vectors::Vectors;

/// How much there is to do, as explorations of the open model.
pub(super) struct Work {
    pub(super) open: usize,
    pub(super) closed: usize,
    pub(super) done: AtomicUsize,
}

impl Work {
    /// What one closed model counts for: a guess, for it hangs on the engine, the operator and the edition how long it takes.
    pub(super) const fn closed_each(&self) -> usize {
        self.open / 10
    }

    /// How much is done when this much more is, and of how much.
    pub(super) fn add(&self, by: usize) -> (usize, usize) {
        let done = self.done.fetch_add(by, Ordering::Relaxed) + by;
        (done, self.open + self.closed * self.closed_each())
    }
}

/// What the explorations have shown.
pub(super) struct Explored {
    pub(super) transitions: u64,
    pub(super) complete: bool,
    /// By the name of what fails in the open model, the choices under which it does.
    pub(super) failing: BTreeMap<&'static str, BTreeSet<Choices>>,
    pub(super) closed: Vec<ClosedCost>,
}

impl Explored {
    pub(super) const NOTHING: Self =
        Self { transitions: 0, complete: true, failing: BTreeMap::new(), closed: Vec::new() };

    pub(super) fn add(&mut self, others: Choices, report: &Exploration) {
        self.transitions += report.transitions;
        self.complete &= report.complete;
        for name in failed(report) {
            self.failing.entry(name).or_default().insert(others);
        }
    }

    /// Explores the closed models of one operator under each of these choices and otherwise the default readings.
    pub(super) fn add_closed(
        &mut self,
        edition: &Edition,
        models: &[(Choice, Operator)],
        threads: usize,
        engine: Engine,
    ) {
        let members: Vec<Closed> = models
            .iter()
            .map(|(choice, operator)| Closed::scaled(*edition, edition.readings.with(*choice), *operator))
            .collect();
        let failed = match engine {
            Engine::Words => {
                let found = explore_family(&members, threads);
                self.transitions += found.transitions;
                self.complete &= found.complete;
                found.failed
            }
            Engine::Single => {
                let mut failed = Vec::new();
                for (place, model) in members.iter().enumerate() {
                    let found = model.clone().explore(threads);
                    self.transitions += found.transitions as u64;
                    self.complete &= found.complete;
                    let fails = found.results.iter().filter(|found| !found.holds);
                    failed.extend(fails.map(|found| (found.property, place)));
                }
                failed
            }
        };
        for (property, place) in failed {
            let (Some(model), Some(&(choice, _))) = (members.get(place), models.get(place)) else { continue };
            // Shortest runs come from one thread.
            let run = model.clone().run_for(property.name);
            let machine = Machine::new(*edition, edition.readings.with(choice));
            let inputs = run.map_or_else(Vec::new, |run| model.inputs_for(&machine, &run));
            self.closed.push(ClosedCost { property, choice, run: Run::seeing(&machine, inputs) });
        }
    }
}

/// Explores the open model under these combinations, with the short timers.
pub(super) fn explored(
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
                    let mut explored = explored.lock().unwrap_or_else(PoisonError::into_inner);
                    explored.add(others(edition, *readings), &report);
                    drop(explored);
                    done();
                }
            });
        }
    });
    explored.into_inner().unwrap_or_else(PoisonError::into_inner)
}

/// Each exploration has one thread: there are enough explorations for all.
pub(super) const fn options(edition: &Edition, engine: Engine) -> Options {
    Options { vectors: Vectors::Few, threads: 1, document: short_timers(edition), engine, further: 0 }
}

/// The names of what fails.
pub(super) fn failed(exploration: &Exploration) -> impl Iterator<Item = &'static str> {
    let broken = exploration.broken.iter().map(|property| property.name);
    broken.chain(exploration.missed.iter().map(|goal| goal.name))
}
