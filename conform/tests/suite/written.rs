//! The whole suite, as `tests.txt` has it, and what no test is for, as `untested.txt` has it, each for 3.0, and in a folder for
//! each other edition: a change of any shows as a change of a file that people read.
//!
//! `UPDATE_EXPECT=1 cargo test -p adsdv-conform --test suite written` writes them anew.

use std::fmt::Write as _;

use adsdv_conform::protocol::{InputsAsJson, Protocol};
use adsdv_conform::suite::{self, Test};
use adsdv_spec::{Edition, Inputs, Machine};
use expect_test::{ExpectFile, expect_file};

/// A file of an edition.
fn file(edition: &Edition, name: &str) -> ExpectFile {
    if edition.version == Edition::V3_0.version {
        return expect_file![name];
    }
    let folder = format!("v{}", edition.version.replace('.', "_"));
    if std::env::var_os("UPDATE_EXPECT").is_some() {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/suite/").to_owned() + &folder;
        std::fs::create_dir_all(&folder).unwrap_or_else(|error| panic!("{folder}: {error}"));
    }
    expect_file![format!("{folder}/{name}")]
}

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
    for edition in Edition::ALL {
        let all: Vec<String> = suite::generate(edition).iter().map(|test| written(edition, test)).collect();
        file(edition, "tests.txt").assert_eq(&all.join("\n"));
    }
}

#[test]
fn every_requirement_without_a_test_has_a_reason() {
    for edition in Edition::ALL {
        let untested: String = suite::untested(edition).fold(String::new(), |mut all, untested| {
            let _ = writeln!(all, "{:9} {}", untested.id, untested.reason);
            all
        });
        file(edition, "untested.txt").assert_eq(&untested);
    }
}
