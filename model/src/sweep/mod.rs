//! Every combination of readings: which properties fail under which, and the shortest run that shows it.
//!
//! ```text
//! combinations --explored--> what fails under which --fewest--> Cost, with its shortest run
//! ```

mod combinations;
mod costs;
mod explored;
mod fewest;
#[cfg(test)]
mod tests;

use std::collections::{BTreeMap, BTreeSet};
use std::sync::atomic::AtomicUsize;

use adsdv_spec::{Choice, Choices, Edition};

use crate::closed::{MEMBERS, Operator};
use crate::document::{DEFAULT, is_default};
use crate::look::Engine;
use crate::property::Property;
use crate::verify::runs_for;
use combinations::{combinations, others};
use costs::machine_with;
pub use costs::{ClosedCost, Cost};
use explored::{Explored, Work, explored};
use fewest::minimal;

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

/// Each answer that is not the default, alone, with each operator: the closed models that [`sweep`] can explore.
///
/// With any operator, answers that the default edition has are left to that edition: these models take longest.
pub fn closed_models(edition: &Edition) -> impl Iterator<Item = (Choice, Operator)> {
    let elsewhere = if is_default(edition) { Choices::NONE } else { DEFAULT.choices };
    let operators = [Operator::WellBehaved, Operator::Any];
    let models = operators
        .into_iter()
        .flat_map(|operator| edition.alternatives().iter().map(move |choice| (choice, operator)));
    models.filter(move |(choice, operator)| *operator == Operator::WellBehaved || !elsewhere.has(*choice))
}

/// How many answers that are not the default come together in `model/READINGS.md`: as many as there are in the default edition,
/// and two in the others, whose questions are more.
pub fn together(edition: &Edition) -> usize {
    if is_default(edition) { usize::MAX } else { 2 }
}

/// Checks an edition of the interface under every combination of readings in which at most so many are not the default,
/// and in these closed models. `engine` makes the steps of the open ones; by [`Engine::Words`] the closed ones of an operator are explored
/// together, by [`Engine::Single`] one after the other. `progress` gets how much is done, and of how much.
pub fn sweep(
    edition: &'static Edition,
    together: usize,
    models: &[(Choice, Operator)],
    threads: usize,
    engine: Engine,
    progress: impl Fn(usize, usize) + Sync,
) -> Sweep {
    let mut all = combinations(edition);
    all.retain(|readings| others(edition, *readings).len() <= together);
    let work = Work { open: all.len(), closed: models.len(), done: AtomicUsize::new(0) };
    let done = |by| {
        let (done, all) = work.add(by);
        progress(done, all);
    };
    let mut explored = explored(edition, &all, threads, engine, || done(1));
    for models in models.chunk_by(|(_, one), (_, other)| one == other).flat_map(|all| all.chunks(MEMBERS)) {
        explored.add_closed(edition, models, threads, engine);
        done(models.len() * work.closed_each());
    }
    explored.closed.sort_by_key(|cost| cost.choice);
    let Explored { transitions, complete, failing, closed } = explored;
    let combinations: BTreeSet<Choices> = all.iter().map(|readings| others(edition, *readings)).collect();
    let mut costs = minimal(edition, failing, &combinations);
    add_runs(&mut costs, edition, engine);
    Sweep { edition, combinations: all.len(), transitions, complete, costs, closed }
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
