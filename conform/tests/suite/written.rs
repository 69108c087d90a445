//! The whole suite, as `tests.txt` has it, and what no test is for, as `untested.txt` has it, each for 3.0, and in a folder for
//! each other edition: a change of any shows as a change of a file that people read.
//!
//! `UPDATE_EXPECT=1 cargo test -p adsdv-oracle --test suite written` writes them anew.

use std::fmt::Write as _;

use adsdv_conform::protocol::{InputsAsJson, Protocol};
use adsdv_conform::suite::{self, Test};
use adsdv_spec::{Edition, Inputs, Machine};
use expect_test::expect_file;

/// The test with its steps: how long each takes, what changes of the inputs, and which state it leads to.
fn written(edition: &Edition, test: &Test) -> String {
    let Test { name, kind, about, section, requirements, reading, scenario } = test;
    let mut written =
        format!("{name}, {kind}: {about}\n  of section {section}: {}\n", requirements.join(", "));
    if let Some(reading) = reading {
        let _ = writeln!(written, "  asks which {reading} it is");
    }
    let mut before = Inputs::default();
    let (machine, protocol) = (Machine::new(*edition, edition.readings), Protocol::of(edition));
    let states = scenario.run(&machine).map(|(control, _)| control.state);
    for (step, state) in scenario.steps.iter().zip(states) {
        let inputs = if step.inputs == before {
            "the same".to_owned()
        } else {
            protocol.object(&InputsAsJson(step.inputs)).to_string()
        };
        let _ = writeln!(written, "  {} ms, {inputs} -> {state}", step.dt_ms);
        before = step.inputs;
    }
    written
}

#[test]
fn every_test_is_as_written() {
    for (edition, file) in [
        (&Edition::V3_0, expect_file!["tests.txt"]),
        (&Edition::V4_0, expect_file!["v4_0/tests.txt"]),
        (&Edition::V2026, expect_file!["v2026/tests.txt"]),
    ] {
        let all: Vec<String> = suite::generate(edition).iter().map(|test| written(edition, test)).collect();
        file.assert_eq(&all.join("\n"));
    }
}

#[test]
fn every_requirement_without_a_test_has_a_reason() {
    for (edition, file) in [
        (&Edition::V3_0, expect_file!["untested.txt"]),
        (&Edition::V4_0, expect_file!["v4_0/untested.txt"]),
        (&Edition::V2026, expect_file!["v2026/untested.txt"]),
    ] {
        let untested: String = suite::untested(edition).fold(String::new(), |mut all, untested| {
            let _ = writeln!(all, "{:9} {}", untested.id, untested.reason);
            all
        });
        file.assert_eq(&untested);
    }
}
