//! What the exploration of the open model costs as cycles get shorter, and as conditions are added: the tables of `README.md`.
//!
//! ```text
//! cargo run --release -p adsdv-model --example growth
//! ```
//!
//! Cycles of a millisecond end the table, for the specification counts in milliseconds.

#![allow(clippy::cast_precision_loss, reason = "a few digits are printed")]

use adsdv_model::{Exploration, Options, explore};
use adsdv_spec::{Edition, Machine, Timing};

fn main() {
    shorter_cycles();
    further_conditions();
}

fn shorter_cycles() {
    println!(
        "| edition | cycle | control states | steps | seconds | ns for 64 steps |\n|---|---|---|---|---|---|"
    );
    for edition in Edition::ALL {
        for cycle_ms in [10, 5, 2, 1] {
            let found = explored(edition, Timing { cycle_ms, ..edition.rules.timing }, 0);
            println!("| {} | {cycle_ms} ms | {} |", edition.version, cells(&found));
        }
    }
}

/// Of cycles so long that there are few control states: it is the steps of each that grow.
fn further_conditions() {
    const LONG_MS: u16 = 50;
    println!(
        "\n| edition | further conditions | control states | steps | seconds | ns for 64 steps |\n|---|---|---|---|---|---|"
    );
    for edition in Edition::ALL {
        for further in 0..=10 {
            let timing = Timing { cycle_ms: LONG_MS, ..edition.rules.timing };
            let found = explored(edition, timing, further);
            println!("| {} | {further} | {} |", edition.version, cells(&found));
        }
    }
}

fn cells(found: &Exploration) -> String {
    assert!(found.complete && found.broken.is_empty(), "{:?}", found.broken);
    let (seconds, steps) = (found.time.as_secs_f64(), found.transitions);
    format!(
        "{} | {} | {seconds:.1} | {:.0}",
        thousands(found.states),
        thousands(steps),
        seconds * 1e9 / (steps as f64 / 64.0),
    )
}

/// The open model with every input vector, on one core, of a VCU with these times, and so many further conditions.
fn explored(edition: &Edition, timing: Timing, further: usize) -> Exploration {
    let machine = Machine::new(edition.with_timing(timing), edition.readings);
    explore(machine, Options { threads: 1, document: timing, further, ..Options::default() }, |_| {})
}

/// With a comma after each thousand.
fn thousands(number: u64) -> String {
    let digits = number.to_string();
    let parts: Vec<&[u8]> = digits.as_bytes().rchunks(3).rev().collect();
    parts.iter().map(|part| String::from_utf8_lossy(part)).collect::<Vec<_>>().join(",")
}
