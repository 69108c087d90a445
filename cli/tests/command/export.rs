//! `adsdv export`: the Promela model is the model's own, and has every row of the table.

use adsdv_model::{Promela, Vectors};
use adsdv_spec::{Choice, Edition, Machine, Readings};

use crate::run::run;

/// What is printed for these options behind `--format promela`.
fn promela(options: &[&str]) -> String {
    let outcome = run(&[&["export", "--format", "promela"], options].concat());
    assert_eq!((outcome.status, outcome.stderr.as_str()), (Some(0), ""), "{options:?}");
    // Behind the line that says the edition.
    outcome.stdout.split_once('\n').map_or_else(String::new, |(_, model)| model.to_owned())
}

fn model(readings: Readings, vectors: Vectors) -> String {
    let machine = Machine::new(*Edition::DEFAULT, readings);
    Promela { machine: &machine, document: Edition::DEFAULT.rules.timing, vectors }.to_string()
}

#[test]
fn every_row_is_in_the_model() {
    let printed = promela(&[]);
    assert_eq!(printed, model(Readings::DEFAULT, Vectors::Read));
    for row in Edition::DEFAULT.rules.table.rows() {
        let target = format!("-> next = {}", row.to);
        let words = format!("/* {}: ", row.section);
        let mut options = printed.split(words.as_str()).skip(1);
        // What stands behind the words of the row, up to the next option.
        let taken = options.any(|text| text.split("/* ").next().is_some_and(|text| text.contains(&target)));
        assert!(taken, "{}: {target} is missing: {printed}", row.section);
    }
}

#[test]
fn a_reading_changes_the_model() {
    let printed = promela(&["--reading", "comms-lost=no-arrow", "--reading", "go-edge=edge"]);
    let readings = Readings::DEFAULT.with(Choice::CommsNoArrow).with(Choice::GoEdgeEnough);
    assert_eq!(printed, model(readings, Vectors::Read));
    assert_ne!(printed, promela(&[]));
    assert!(printed.lines().take(4).any(|line| line.contains("comms-lost=no-arrow")), "{printed}");
}

#[test]
fn the_inputs_that_are_tried_change_the_model() {
    let printed = promela(&["--vectors", "every"]);
    assert_eq!(printed, model(Readings::DEFAULT, Vectors::Every));
    assert_ne!(printed, promela(&["--vectors", "read"]));
}
