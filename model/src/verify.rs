//! Verification: the open model, explored to its end, and the shortest runs that show what came of it.
//!
//! [`explore`] decides. [`verify`] also finds a shortest run for each property that is broken and each goal that is reached, with
//! stateright's own search for examples and counterexamples.

use std::collections::{BTreeSet, HashMap};

use adsdv_spec::{AsState, Choice, Control, Machine, Observation, Timing};
use stateright::{Checker, Path};

use crate::action::Action;
use crate::cycle::cycle_ms;
use crate::document::Document;
use crate::exploration::{Exploration, NOTHING, Options, Progress, checker, explore};
use crate::goals::goals;
use crate::look::Engine;
use crate::moot::moot;
use crate::open::{Open, State};
use crate::parts::Part;
use crate::property::{Harm, Property};
use crate::step::Step;
use crate::vectors::Vectors;

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
        let after =
            |control: &Control, seen| self.machine().react(control, seen, cycle_ms(self.machine())).control;
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
    use adsdv_spec::{Atom, Atoms, Fault, Faults};

    use super::*;

    #[test]
    fn each_difference_counts() {
        let seen = |atoms: &[Atom], faults| Observation::new(Atoms::of(atoms), faults);
        let (one, other) =
            (seen(&[Atom::Asms, Atom::Tsms], Faults::NONE), seen(&[Atom::Asms, Atom::GoOn], FAULT));
        // Tsms, GoOn, the fault, and that the circuit is open.
        assert_eq!((distance(one, other), distance(one, one), distance(other, other)), (4, 0, 0));
    }

    const FAULT: Faults = Faults::NONE.with(Fault::HvilOpenFault);
}
