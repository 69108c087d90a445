//! What the models tell people and other tools, against the files beside this one: pictures, steps in words, stories, logs,
//! the Promela model, and what readings cost (`readings.rs`). A change of what they tell shows as a change of a file that people
//! read. `closed.rs` and `open.rs` are the two models in numbers.
//!
//! `UPDATE_EXPECT=1 cargo test -p adsdv-model --test printed` writes the files anew.

#[path = "../chance/mod.rs"]
mod chance;
mod closed;
mod open;
mod readings;

use std::fmt::Write as _;

use adsdv_model::closed::{Closed, ClosedAction, ClosedState, Expectation, Operator};
use adsdv_model::{
    Options, Promela, Report, Run, SHORT_TIMERS, StoryLine, Vectors, properties, state_machines, story,
    story_of, verify,
};
use adsdv_spec::{Edition, Machine, Mutation, Readings};
use expect_test::expect_file;
use stateright::{Model as _, Path};

const SHORTENED: Edition = Edition::DEFAULT.with_timing(SHORT_TIMERS);
const SHORT: Machine = Machine::new(SHORTENED, Readings::DEFAULT);

fn verified(machine: &Machine) -> Report {
    verify(
        *machine,
        Options { vectors: Vectors::Read, threads: 1, document: SHORT_TIMERS, ..Options::default() },
        |_| {},
    )
}

/// The lines of a story, indented.
fn lines(story: Vec<StoryLine>) -> String {
    story.into_iter().fold(String::new(), |mut all, StoryLine { ms, text }| {
        let _ = writeln!(all, "  {ms:5} ms  {text}");
        all
    })
}

/// The shortest run to everything that is to be possible, and a short one to an emergency.
fn closed_runs() -> Vec<(&'static str, Closed, Path<ClosedState, ClosedAction>)> {
    const EMERGENCY: &str = "emergency-can-happen";
    let scaled = |operator| Closed::scaled(*Edition::DEFAULT, Readings::DEFAULT, operator);
    let anybody = scaled(Operator::Any);
    let emergency = anybody.clone().run_for(EMERGENCY).expect("it is possible");
    let model = scaled(Operator::WellBehaved);
    let found = model.clone().explore(1).results.into_iter();
    let possible = found.filter(|found| found.property.expectation == Expectation::Sometimes);
    let possible = possible
        .map(|found| (found.property.name, model.clone(), found.run.expect("what is possible has a run")));
    std::iter::once((EMERGENCY, anybody, emergency)).chain(possible).collect()
}

#[test]
fn a_run_as_a_picture() {
    for (name, model, path) in closed_runs() {
        let svg = model.as_svg(path).expect("a run has a picture");
        // A line for each element, so that a change can be read.
        expect_file![format!("{name}.svg")].assert_eq(&svg.replace("><", ">\n<"));
    }
}

#[test]
fn a_run_in_words() {
    for (name, model, path) in closed_runs() {
        let mut printed = String::new();
        for (state, action) in path.into_vec() {
            let Some(action) = action else { continue };
            let step = model.format_step(&state, action).expect("a step is printed");
            let _ = writeln!(printed, "# {action}\n{step}\n");
        }
        expect_file![format!("{name}.txt")].assert_eq(&printed);
    }
}

/// The shortest run to each goal, with what happens in it.
#[test]
fn the_goals() {
    let Report { exploration, runs, .. } = verified(&SHORT);
    let mut printed = format!(
        "{} states, {} transitions, depth {}\n",
        exploration.states, exploration.transitions, exploration.depth
    );
    for goal in adsdv_model::goals(Edition::DEFAULT) {
        let run = runs.get(goal.name).expect("each goal is reached");
        let _ = write!(printed, "\n{} ({}): {}\n", goal.name, goal.requirement, goal.statement);
        printed += &lines(story(&SHORT, run, None));
        printed += &lines(story_of(&Run::new(&SHORT, run.iter().copied())));
    }
    for (part, decides) in &exploration.parts {
        let _ = write!(printed, "\n{part}: {}", if *decides { "decides" } else { "is dead" });
    }
    expect_file!["goals.txt"].assert_eq(&(printed + "\n"));
}

/// For each property that some mutants break, the first of them and the run that shows it.
#[test]
fn the_properties() {
    let mut printed = String::new();
    let mut left: Vec<_> = properties(Edition::DEFAULT).collect();
    for mutation in Mutation::all(&SHORTENED).step_by(9) {
        let machine = Machine::new(mutation.apply(&SHORTENED), Readings::DEFAULT);
        let Report { exploration, runs, .. } = verified(&machine);
        let (broken, others): (Vec<_>, Vec<_>) = left
            .into_iter()
            .partition(|&property| exploration.broken.iter().any(|other| other.name == property.name));
        left = others;
        for property in broken {
            let _ = write!(
                printed,
                "{} ({}), {}: {}\n{mutation}\n",
                property.name,
                property.requirements_in(Edition::DEFAULT).join(", "),
                property.harm.text(),
                property.statement_in(Edition::DEFAULT)
            );
            printed += &lines(story(&machine, &runs[property.name], Some(property)));
            printed.push('\n');
        }
    }
    for property in left {
        let _ = writeln!(printed, "{}: none of these mutants breaks it", property.name);
    }
    expect_file!["properties.txt"].assert_eq(&printed);
}

/// A run as it would be recorded.
#[test]
fn a_run_as_a_log() {
    let runs = verified(&SHORT).runs;
    let mut log = String::new();
    for name in ["arrow-3.7", "arrow-3.9"] {
        let run = runs.get(name).unwrap_or_else(|| panic!("{name} is one of {:?}", runs.keys()));
        let run = Run::new(&SHORT, run.iter().copied()).persisting(10);
        let _ = writeln!(log, "# {name}");
        for (t_ns, frame) in run.frames() {
            let _ = writeln!(log, "{:6} us {frame}", t_ns / 1000);
        }
    }
    expect_file!["log.txt"].assert_eq(&log);
}

#[test]
fn the_same_machine_for_spin() {
    let promela = |machine: &Machine, vectors| {
        Promela { machine, document: machine.edition().rules.timing, vectors }.to_string()
    };
    expect_file!["read.pml"].assert_eq(&promela(&Machine::REFERENCE, Vectors::Read));
    expect_file!["few.pml"].assert_eq(&promela(&SHORT, Vectors::Few));
    for edition in state_machines().filter(|edition| edition.version != Edition::DEFAULT.version) {
        let file = format!("read-{}.pml", edition.version);
        let machine = Machine::new(*edition, edition.readings);
        expect_file![file].assert_eq(&promela(&machine, Vectors::Read));
    }
    let others = Edition::DEFAULT.alternatives();
    // Of each other reading alone, when which inputs are read.
    let mut printed = String::new();
    for choice in others.iter() {
        let text = promela(&Machine::new(SHORTENED, Readings::DEFAULT.with(choice)), Vectors::Few);
        let _ = writeln!(printed, "{choice}");
        for line in
            text.lines().filter(|line| line.trim_start().starts_with("state == ") && line.ends_with("->"))
        {
            let _ = writeln!(printed, "  {}", line.trim());
        }
    }
    expect_file!["cycles.txt"].assert_eq(&printed);
    let other = Machine::new(SHORTENED, others.iter().fold(Readings::DEFAULT, Readings::with));
    expect_file!["every-other-reading.pml"].assert_eq(&promela(&other, Vectors::Every));
}
