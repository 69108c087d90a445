//! The whole suite, as `tests.txt` has it, and what no test is for, as `untested.txt` has it: a change of either shows as a
//! change of a file that people read.
//!
//! `UPDATE_EXPECT=1 cargo test -p adsdv-oracle --test suite written` writes them anew.

use std::fmt::Write as _;

use adsdv_oracle::protocol::InputsAsJson;
use adsdv_oracle::suite::{self, Test};
use adsdv_spec::{Inputs, Machine};
use expect_test::expect_file;

use crate::tests;

/// The test with its steps: how long each takes, what changes of the inputs, and which state it leads to.
fn written(test: &Test) -> String {
    let Test { name, kind, about, section, requirements, reading, scenario } = test;
    let mut written =
        format!("{name}, {kind}: {about}\n  of section {section}: {}\n", requirements.join(", "));
    if let Some(reading) = reading {
        let _ = writeln!(written, "  asks which {reading} it is");
    }
    let mut before = Inputs::default();
    let states = scenario.run(&Machine::REFERENCE).map(|(control, _)| control.state);
    for (step, state) in scenario.steps.iter().zip(states) {
        let inputs =
            if step.inputs == before { "the same".to_owned() } else { InputsAsJson(step.inputs).to_string() };
        let _ = writeln!(written, "  {} ms, {inputs} -> {state}", step.dt_ms);
        before = step.inputs;
    }
    written
}

#[test]
fn every_test_is_as_written() {
    let all: Vec<String> = tests().iter().map(written).collect();
    expect_file!["tests.txt"].assert_eq(&all.join("\n"));
}

#[test]
fn every_requirement_without_a_test_has_a_reason() {
    let untested: String = suite::untested().fold(String::new(), |mut all, untested| {
        let _ = writeln!(all, "{:9} {}", untested.id, untested.reason);
        all
    });
    expect_file!["untested.txt"].assert_eq(&untested);
}
