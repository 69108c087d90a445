//! What the explorations showed, model by model and property by property.

use std::time::Duration;

use adsdv_model::closed::{Closed, Expectation, Operator};
use adsdv_model::{Goal, Options, Part, Property, Report, Run, goals, properties, verify};
use adsdv_spec::{Choice, Machine};

use crate::args::Models;
use crate::layout::counted;
use crate::progress::ProgressLine;

/// Everything that was explored.
#[derive(Debug)]
pub(super) struct Outcome {
    /// The machine that was explored.
    pub(super) machine: Machine,
    /// The models.
    pub(super) models: Vec<Explored>,
    /// The parts of the table, and what each is there for.
    pub(super) parts: Vec<(Part, Role)>,
}

/// What a part of the table is there for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Role {
    /// It decides a step.
    Decides,
    /// It decides none, and would if a question were answered like this.
    Moot(Choice),
    /// It decides none.
    Dead,
}

/// One model.
#[derive(Debug)]
pub(super) struct Explored {
    /// Its name.
    pub(super) name: &'static str,
    /// What can happen in it.
    pub(super) about: &'static str,
    /// How many states there are.
    pub(super) states: u64,
    /// How many steps lead out of them.
    pub(super) transitions: u64,
    /// How many steps the farthest is away.
    pub(super) depth: usize,
    /// How long it took.
    pub(super) time: Duration,
    /// Whether every step was tried.
    pub(super) complete: bool,
    /// What came of its properties.
    pub(super) results: Vec<Checked>,
}

/// One property.
#[derive(Debug)]
pub(super) struct Checked {
    /// Its name.
    pub(super) name: &'static str,
    /// What it says.
    pub(super) statement: String,
    /// The requirements, or the section, that it covers.
    pub(super) requirements: Vec<&'static str>,
    /// What is claimed.
    pub(super) claim: Claim,
    /// Whether it is so.
    pub(super) holds: bool,
    /// How long the run is that shows it: in actions of the model.
    pub(super) steps: Option<usize>,
    /// The run that shows that it is not so.
    pub(super) counterexample: Option<Run>,
}

/// What a property claims of all runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Claim {
    /// It is so at every step.
    Always,
    /// It is so in the end.
    Eventually,
    /// Some run gets there.
    Sometimes,
}

impl Outcome {
    /// Whether everything holds, for certain.
    pub(super) fn holds(&self) -> bool {
        let model = |model: &Explored| model.complete && model.results.iter().all(|result| result.holds);
        self.models.iter().all(model) && self.dead().next().is_none()
    }
}

impl Outcome {
    /// The parts of the table that decide nothing.
    pub(super) fn dead(&self) -> impl Iterator<Item = &Part> {
        self.parts.iter().filter(|(_, role)| *role == Role::Dead).map(|(part, _)| part)
    }

    /// The parts of the table that decide nothing under these readings, and the answer under which they would.
    pub(super) fn moot(&self) -> impl Iterator<Item = (&Part, Choice)> {
        self.parts.iter().filter_map(|(part, role)| match role {
            Role::Moot(choice) => Some((part, *choice)),
            Role::Decides | Role::Dead => None,
        })
    }
}

/// Explores the models: the open one as the options say, the closed ones with as many threads.
pub(super) fn explore(machine: &Machine, which: Models, options: Options) -> Outcome {
    let mut line = ProgressLine::new();
    let mut outcome = Outcome { machine: *machine, models: Vec::new(), parts: Vec::new() };
    if which != Models::Closed {
        let report = verify(*machine, options, |progress| {
            let states = counted(progress.states, "state");
            let text = format!("open model: {states}, {}", counted(progress.steps, "step"));
            line.show_bar(progress.depth, progress.expected_depth, text);
        });
        outcome.parts = parts(&report);
        outcome.models.push(open(machine, report));
    }
    if which != Models::Open {
        line.show("closed model, with a well-behaved operator");
        outcome.models.push(well_behaved(machine, options.threads));
        line.show("closed model, with any operator and a fault");
        outcome.models.push(any_operator(machine, options.threads));
    }
    outcome
}

/// The closed model with an operator who follows the procedure.
pub(super) fn well_behaved(machine: &Machine, threads: usize) -> Explored {
    closed(
        "closed model, well-behaved operator",
        "an AI Computer that follows the document, over CAN frames; an operator who does; no fault",
        machine,
        &Closed::new(*machine, Operator::WellBehaved),
        threads,
    )
}

/// The closed model with any operator.
fn any_operator(machine: &Machine, threads: usize) -> Explored {
    closed(
        "closed model, any operator",
        "that AI Computer; any switch and the remote E-stop at any time; short timers",
        machine,
        &Closed::scaled(*machine.edition(), machine.readings(), Operator::Any),
        threads,
    )
}

fn parts(report: &Report) -> Vec<(Part, Role)> {
    let role = |part: &Part, decides: bool| {
        let moot = report.moot.iter().find(|(moot, _)| moot == part);
        match (decides, moot) {
            (true, _) => Role::Decides,
            (false, Some((_, choice))) => Role::Moot(*choice),
            (false, None) => Role::Dead,
        }
    };
    let parts = report.exploration.parts.iter();
    parts.map(|(part, decides)| (part.clone(), role(part, *decides))).collect()
}

fn open(machine: &Machine, report: Report) -> Explored {
    let counterexample = |path| Run::new(machine, path).persisting(Run::AFTERMATH_MS);
    let Report { exploration, mut runs, .. } = report;
    let mut checked = |name, statement, requirements, claim, holds: bool| {
        let run = runs.remove(name);
        let steps = run.as_ref().map(Vec::len);
        let counterexample = run.filter(|_| !holds).map(counterexample);
        Checked { name, statement, requirements, claim, holds, steps, counterexample }
    };
    let mut results = Vec::new();
    for property @ Property { name, .. } in properties(machine.edition()) {
        let holds = exploration.broken.iter().all(|broken| broken.name != *name);
        results.push(checked(
            name,
            property.statement_in(machine.edition()),
            property.requirements_in(machine.edition()),
            Claim::Always,
            holds,
        ));
    }
    for goal @ Goal { name, statement, requirement, .. } in goals(machine.edition()) {
        let holds = !exploration.missed.contains(goal);
        results.push(checked(name, (*statement).to_owned(), vec![*requirement], Claim::Sometimes, holds));
    }
    Explored {
        name: "open model",
        about: "any AI Computer, any driver, any fault, at every step of 10 ms",
        states: exploration.states,
        transitions: exploration.transitions,
        depth: exploration.depth,
        time: exploration.time,
        complete: exploration.complete,
        results,
    }
}

fn closed(
    name: &'static str,
    about: &'static str,
    machine: &Machine,
    model: &Closed,
    threads: usize,
) -> Explored {
    let exploration = model.clone().explore(threads);
    let results = exploration.results.into_iter().map(|found| {
        let property = found.property;
        let claim = match property.expectation {
            Expectation::Always => Claim::Always,
            Expectation::Eventually => Claim::Eventually,
            Expectation::Sometimes => Claim::Sometimes,
        };
        // With several threads, what was found is a run, but not always a shortest one.
        let run = (!found.holds).then(|| model.clone().run_for(property.name).or(found.run)).flatten();
        Checked {
            name: property.name,
            statement: property.statement_in(machine.edition()),
            requirements: property.requirements_in(machine.edition()),
            claim,
            holds: found.holds,
            steps: run.as_ref().map(|run| run.clone().into_actions().len()),
            counterexample: run.map(|run| {
                Run::seeing(machine, model.inputs_for(machine, &run)).persisting(Run::AFTERMATH_MS)
            }),
        }
    });
    Explored {
        name,
        about,
        states: exploration.states as u64,
        transitions: exploration.transitions as u64,
        depth: exploration.depth,
        time: exploration.time,
        complete: exploration.complete,
        results: results.collect(),
    }
}
