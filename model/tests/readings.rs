//! `READINGS.md` says what the readings cost now. `UPDATE_EXPECT=1 cargo test -p adsdv-model --test readings` writes it anew.

use std::thread;

use adsdv_model::{PROPERTIES, sweep};
use adsdv_spec::{Choices, Readings};
use expect_test::expect_file;

#[test]
fn the_costs_of_the_readings_are_as_written_down() {
    let threads = thread::available_parallelism().map_or(1, usize::from);
    let swept = sweep(threads, |_, _| {});
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

    expect_file!["../READINGS.md"].assert_eq(&swept.to_string());
}
