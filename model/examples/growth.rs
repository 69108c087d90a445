//! What the exploration of the open model costs as cycles get shorter, and as conditions are added: the tables of `README.md`.
//!
//! ```text
//! cargo run --release -p adsdv-model --example growth
//! ```
//!
//! A VCU of shorter cycles is one whose timers are that many cycles longer, so that is what is explored. Times have 16 bits, which
//! is what ends the table: with cycles of 2.5 ms the EBS timer takes 60,000 of 65,535.

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
        for times in [1, 2, 4] {
            let found = explored(edition, |ms| ms.saturating_mul(times), 0);
            println!(
                "| {} | {} ms | {} |",
                edition.version,
                f64::from(edition.rules.timing.cycle_ms) / f64::from(times),
                cells(&found),
            );
        }
    }
}

/// Of cycles so long that there are few control states: it is the steps of each that grow.
fn further_conditions() {
    const LONGER: u16 = 5;
    println!(
        "\n| edition | further conditions | control states | steps | seconds | ns for 64 steps |\n|---|---|---|---|---|---|"
    );
    for edition in Edition::ALL {
        for further in 0..=10 {
            let found = explored(edition, |ms| ms / LONGER, further);
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

/// The open model with every input vector, on one core, of timers that take other times, and so many further conditions.
fn explored(edition: &Edition, time: impl Fn(u16) -> u16, further: usize) -> Exploration {
    let Timing { ready_dwell_ms, ebs_timer_ms, handshake_ms, cycle_ms } = edition.rules.timing;
    let document = Timing {
        ready_dwell_ms: time(ready_dwell_ms),
        ebs_timer_ms: time(ebs_timer_ms),
        handshake_ms: time(handshake_ms),
        cycle_ms,
    };
    let machine = Machine::new(edition.with_timing(document), edition.readings);
    explore(machine, Options { threads: 1, document, further, ..Options::default() }, |_| {})
}

/// With a comma after each thousand.
fn thousands(number: u64) -> String {
    let digits = number.to_string();
    let parts: Vec<&[u8]> = digits.as_bytes().rchunks(3).rev().collect();
    parts.iter().map(|part| String::from_utf8_lossy(part)).collect::<Vec<_>>().join(",")
}
