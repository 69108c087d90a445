//! The open model: complete, the same whichever way it is explored, and what its abstractions rest on.

#[path = "../chance/mod.rs"]
mod chance;
mod lemmas;
mod raw;
mod whole;

use std::collections::HashSet;

use adsdv_model::{Options, SHORT_TIMERS as SHORT, Vectors};
use adsdv_spec::{Control, Edition, Machine, Readings, Timing};

/// The default readings, and each other choice alone.
fn each_choice_alone() -> impl Iterator<Item = Readings> {
    let alone = Edition::DEFAULT.alternatives().iter().map(|choice| Readings::DEFAULT.with(choice));
    std::iter::once(Readings::DEFAULT).chain(alone)
}

fn machine(timing: Timing, readings: Readings) -> Machine {
    Machine::new(Edition::DEFAULT.with_timing(timing), readings)
}

fn options(vectors: Vectors, document: Timing) -> Options {
    Options { vectors, threads: 1, document }
}

/// Every control state that can be reached.
fn reachable(machine: &Machine, vectors: Vectors) -> HashSet<Control> {
    adsdv_model::reachable(machine, machine.edition().rules.timing, vectors)
}
