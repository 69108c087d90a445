//! `READINGS.md` says what the readings cost now.
//!
//! The file is what `adsdv verify --readings` prints, and a nightly job holds it to that. Here are, of the default edition, the
//! combinations of up to three answers that are not the default, from which the same follows; of each other edition, each answer
//! alone; and the closed models with an operator who follows the
//! procedure.

use std::thread;

use adsdv_model::closed::Operator;
use adsdv_model::{Engine, READINGS_HEAD, Sweep, closed_models, properties, state_machines, sweep};
use adsdv_spec::{Choices, Edition};

const WRITTEN: &str = include_str!("../READINGS.md");

/// What to do where that is another.
const ANEW: &str = "`cargo run --release -- verify --readings > model/READINGS.md` writes it anew";

/// Of the default edition, so many answers that are not the default come together.
const TOGETHER: usize = 3;

/// The section of an edition.
fn section(edition: &Edition) -> &'static str {
    let heading = format!("\n## Edition {}\n", edition.version);
    let (_, section) =
        WRITTEN.split_once(&heading).unwrap_or_else(|| panic!("no section of {}: {ANEW}", edition.version));
    section.split("\n## Edition ").next().unwrap_or_default()
}

/// The text without how many combinations and steps there were, and without what fails with an AI Computer that follows the
/// document.
fn checked_here(text: &str) -> Vec<&str> {
    let counts = |line: &&str| line.contains(" combinations, ") && line.contains(" steps, ");
    assert_eq!(text.lines().filter(counts).count(), 1, "one line says how many");
    let (mut lines, mut closed) = (Vec::new(), false);
    for line in text.lines().filter(|line| !counts(line)) {
        if line.starts_with("### ") {
            closed = line == "### With an AI Computer that follows the document";
        }
        if !closed {
            lines.push(line);
        }
    }
    lines
}

fn swept(edition: &'static Edition, together: usize) -> Sweep {
    let threads = thread::available_parallelism().map_or(1, usize::from);
    let follows = |(_, operator): &(_, Operator)| *operator == Operator::WellBehaved;
    let models: Vec<_> = closed_models(edition).filter(follows).collect();
    let swept = sweep(edition, together, &models, threads, Engine::default(), |_, _| {});
    assert!(swept.complete);
    assert!(swept.closed.is_empty(), "an operator who follows the procedure is never let down");
    // What is broken is shown: a run for each property, and the properties hold under the defaults.
    let is_property = |name| properties(edition).any(|property| property.name == name);
    for cost in swept.costs.iter().filter(|cost| is_property(cost.name)) {
        assert!(cost.run.as_ref().is_some_and(|run| !run.is_empty()), "{} has no run", cost.name);
        assert!(!cost.choices.is_empty(), "{} fails under the defaults", cost.name);
        assert!(cost.choices.intersection(edition.readings.choices()).is_empty(), "{}", cost.name);
    }
    // Every other answer costs something: otherwise it would be no question.
    let costly = swept.costs.iter().fold(Choices::NONE, |all, cost| all.union(cost.choices));
    let free = edition.alternatives().difference(costly);
    let free: Vec<String> = free.iter().map(|choice| choice.to_string()).collect();
    assert_eq!(
        costly,
        edition.alternatives(),
        "{}: no property of properties.rs fails under {free:?}",
        edition.version
    );
    swept
}

#[test]
fn the_costs_of_the_readings_are_as_written_down() {
    let swept = swept(Edition::DEFAULT, TOGETHER);
    let found = swept.to_string();
    let (_, found) = found.split_once('\n').expect("a heading");
    let [written, found] = [section(Edition::DEFAULT), found].map(checked_here);
    assert_eq!(found, written, "{ANEW}");
}

/// A line without the answers that undo a failure: they show only where two come together.
fn alone(line: &str) -> String {
    let Some((fails, undone)) = line.split_once(", but not with ") else { return line.to_owned() };
    let harm = undone.split_once(": ").map_or(String::new(), |(_, harm)| format!(": {harm}"));
    format!("{fails}{harm}")
}

/// The table gives what one answer costs alone in the same words.
#[test]
fn the_costs_of_single_readings_in_other_editions_are_as_written_down() {
    for edition in state_machines().filter(|edition| edition.version != Edition::DEFAULT.version) {
        let found = swept(edition, 1).to_string();
        let (_, found) = found.split_once('\n').expect("a heading");
        let [written, found] = [section(edition), found].map(checked_here);
        let [written, found] = [written, found].map(|lines| lines.into_iter().map(alone).collect::<Vec<_>>());
        assert_eq!(found, written, "{ANEW}");
    }
}

#[test]
fn each_state_machine_has_its_section_behind_the_head() {
    assert!(WRITTEN.starts_with(READINGS_HEAD));
    let sections = WRITTEN.lines().filter_map(|line| line.strip_prefix("## Edition "));
    let expected = state_machines().map(|edition| edition.version);
    assert_eq!(sections.collect::<Vec<_>>(), expected.collect::<Vec<_>>(), "{ANEW}");
}
