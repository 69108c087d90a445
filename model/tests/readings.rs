//! `READINGS.md` says what the readings cost now.
//!
//! The file is what `adsdv verify --readings` prints, of every combination and every closed model, and a nightly job holds it
//! to that. Here are the combinations of up to three answers that are not the default, from which the same follows, and the
//! closed models with an operator who follows the procedure.

use std::thread;

use adsdv_model::closed::Operator;
use adsdv_model::{closed_models, properties, sweep};
use adsdv_spec::{Choices, Edition, Readings};

/// So many answers that are not the default come together.
const TOGETHER: usize = 3;

/// The text without how many combinations and steps there were, and without what fails with an AI Computer that follows the
/// document.
fn checked_here(text: &str) -> Vec<&str> {
    let counts = |line: &&str| line.contains(" combinations, ") && line.contains(" steps, ");
    assert_eq!(text.lines().filter(counts).count(), 1, "one line says how many");
    let (mut lines, mut closed) = (Vec::new(), false);
    for line in text.lines().filter(|line| !counts(line)) {
        if line.starts_with("## ") {
            closed = line == "## With an AI Computer that follows the document";
        }
        if !closed {
            lines.push(line);
        }
    }
    lines
}

#[test]
fn the_costs_of_the_readings_are_as_written_down() {
    let threads = thread::available_parallelism().map_or(1, usize::from);
    let models: Vec<_> =
        closed_models(Edition::DEFAULT).filter(|(_, operator)| *operator == Operator::WellBehaved).collect();
    let swept = sweep(Edition::DEFAULT, TOGETHER, &models, threads, |_, _| {});
    assert!(swept.complete);
    assert!(swept.closed.is_empty(), "an operator who follows the procedure is never let down");
    // What is broken is shown: a run for each property, and the properties hold under the defaults.
    for cost in swept
        .costs
        .iter()
        .filter(|cost| properties(Edition::DEFAULT).any(|property| property.name == cost.name))
    {
        assert!(cost.run.as_ref().is_some_and(|run| !run.is_empty()), "{} has no run", cost.name);
        assert!(!cost.choices.is_empty(), "{} fails under the defaults", cost.name);
        assert!(cost.choices.intersection(Readings::DEFAULT.choices()).is_empty(), "{}", cost.name);
    }
    // Every other answer costs something: otherwise it would be no question.
    let costly = swept.costs.iter().fold(Choices::NONE, |all, cost| all.union(cost.choices));
    assert_eq!(costly, Edition::DEFAULT.alternatives());

    let found = swept.to_string();
    let [written, found] = [include_str!("../READINGS.md"), &found].map(checked_here);
    assert_eq!(found, written, "`adsdv verify --readings > model/READINGS.md` writes it anew");
}
