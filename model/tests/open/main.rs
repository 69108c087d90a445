//! The open model: complete, the same whichever way it is explored, and what its abstractions rest on.

#[path = "../chance/mod.rs"]
mod chance;
mod lemmas;
mod raw;
mod whole;

use std::collections::HashSet;

use adsdv_model::{Options, SHORT_TIMERS as SHORT, Vectors};
use adsdv_spec::{Control, Edition, Machine, Readings, Timing};

/// The default readings, and some other choices, each alone. That no choice makes anything matter that is not read is a theorem
/// (`what_is_not_read_in_off_does_not_matter` and its like in `proofs`); every fourth one is enough to see that the explorations go by it.
fn some_choices_alone() -> impl Iterator<Item = Readings> {
    let alone =
        Edition::DEFAULT.alternatives().iter().step_by(4).map(|choice| Readings::DEFAULT.with(choice));
    std::iter::once(Readings::DEFAULT).chain(alone)
}

fn machine(timing: Timing, readings: Readings) -> Machine {
    Machine::new(Edition::DEFAULT.with_timing(timing), readings)
}

fn options(vectors: Vectors, document: Timing) -> Options {
    Options { vectors, threads: 1, document, ..Options::default() }
}

/// Every control state that can be reached.
fn reachable(machine: &Machine, vectors: Vectors) -> HashSet<Control> {
    adsdv_model::reachable(machine, machine.edition().rules.timing, vectors)
}
