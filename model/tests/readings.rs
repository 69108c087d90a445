//! `READINGS.md` says what the readings cost now.

use std::path::Path;
use std::{env, fs, thread};

use adsdv_model::{PROPERTIES, sweep};
use adsdv_spec::{Choices, Readings};

/// Set to 1, it makes the test write the file instead of comparing it.
const BLESS: &str = "ADSDV_BLESS";

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

    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("READINGS.md");
    let now = swept.to_string();
    if env::var_os(BLESS).is_some_and(|value| value == "1") {
        fs::write(&path, now).unwrap_or_else(|error| panic!("cannot write READINGS.md: {error}"));
        return;
    }
    let renew = format!("to renew it: {BLESS}=1 cargo test -p adsdv-model --test readings");
    let written =
        fs::read_to_string(&path).unwrap_or_else(|error| panic!("cannot read READINGS.md: {error}; {renew}"));
    let first = written.lines().zip(now.lines()).find(|(written, now)| written != now);
    assert!(written == now, "READINGS.md is not what is found now; first difference: {first:#?}\n{renew}");
}
