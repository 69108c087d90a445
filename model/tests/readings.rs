//! `READINGS.md` says what the readings cost now.
//!
//! The file is what `adsdv verify --readings` prints, of every combination, and a nightly job holds it to that. Here are the
//! combinations of up to three answers that are not the default, from which the same follows.

use std::thread;

use adsdv_model::{PROPERTIES, sweep};
use adsdv_spec::{Choices, Readings};

/// So many answers that are not the default come together.
const TOGETHER: usize = 3;

/// The text without how many combinations and steps there were.
fn without_counts(text: &str) -> Vec<&str> {
    let counts = |line: &&str| line.contains(" combinations, ") && line.contains(" steps, ");
    assert_eq!(text.lines().filter(counts).count(), 1, "one line says how many");
    text.lines().filter(|line| !counts(line)).collect()
}

#[test]
fn the_costs_of_the_readings_are_as_written_down() {
    let threads = thread::available_parallelism().map_or(1, usize::from);
    let swept = sweep(TOGETHER, threads, |_, _| {});
    assert!(swept.complete);
    // What is broken is shown: a run for each property, and the properties hold under the defaults.
    for cost in swept.costs.iter().filter(|cost| PROPERTIES.iter().any(|property| property.name == cost.name))
    {
        assert!(cost.run.as_ref().is_some_and(|run| !run.is_empty()), "{} has no run", cost.name);
        assert!(!cost.choices.is_empty(), "{} fails under the defaults", cost.name);
        assert!(cost.choices.intersection(Readings::DEFAULT.choices()).is_empty(), "{}", cost.name);
    }
    // Every other answer costs something: otherwise it would be no question.
    let costly = swept.costs.iter().fold(Choices::NONE, |all, cost| all.union(cost.choices));
    assert_eq!(costly, Choices::ALL.difference(Readings::DEFAULT.choices()));

    let found = swept.to_string();
    let [written, found] = [include_str!("../READINGS.md"), &found].map(without_counts);
    assert_eq!(found, written, "`adsdv verify --readings > model/READINGS.md` writes it anew");
}
