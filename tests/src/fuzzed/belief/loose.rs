//! What allows all that something does, and often more.

use std::ops::RangeInclusive;

use adsdv_spec::belief::{Belief, Causes, Glimpse, Handshakes, KnownFaults, Memory, Span};
use adsdv_spec::messages::AsState;
use adsdv_spec::{Atom, Atoms, Edition, Fault, Faults, Observation, Truth};

use crate::fuzzed::Bytes;
use crate::world::Chance;

/// Mostly some milliseconds, and now and then any number of them.
fn some_ms(bytes: &mut Bytes<'_>) -> u16 {
    match bytes.below(4) {
        0 => 0,
        1 => bytes.any(),
        _ => u16::from(bytes.any::<u8>()),
    }
}

/// The times from some before it to some after it.
pub(super) fn time(bytes: &mut Bytes<'_>, dt_ms: &RangeInclusive<u32>) -> RangeInclusive<u32> {
    let (before, after) = (some_ms(bytes), some_ms(bytes));
    dt_ms.start().saturating_sub(before.into())..=dt_ms.end().saturating_add(after.into())
}

fn span(bytes: &mut Bytes<'_>, span: Span) -> Span {
    let (before, after) = (some_ms(bytes), some_ms(bytes));
    Span::between(span.least_ms().saturating_sub(before), span.most_ms().saturating_add(after))
}

fn waits(bytes: &mut Bytes<'_>, waits: Option<Span>) -> Option<Span> {
    match waits {
        Some(waits) => Some(span(bytes, waits)),
        None if bytes.one_in(3) => Some(Span::between(some_ms(bytes), some_ms(bytes))),
        None => None,
    }
}

fn truth(bytes: &mut Bytes<'_>, truth: Truth) -> Truth {
    if bytes.one_in(3) { Truth::Unknown } else { truth }
}

/// Some atoms: a few, or any.
fn some_atoms(bytes: &mut Bytes<'_>) -> Atoms {
    if bytes.one_in(4) {
        return bytes.any();
    }
    (0..bytes.below(4)).fold(Atoms::NONE, |some, _| some.with(bytes.pick(Atom::ALL)))
}

/// Some faults: a few, or any.
fn some_faults(bytes: &mut Bytes<'_>) -> Faults {
    if bytes.one_in(4) {
        return bytes.any();
    }
    (0..bytes.below(4)).fold(Faults::NONE, |some, _| some.with(bytes.pick(Fault::ALL)))
}

/// A glimpse of what else may be seen, too, or of less.
pub(super) fn glimpse(bytes: &mut Bytes<'_>, glimpse: &Glimpse) -> Glimpse {
    if bytes.one_in(4) {
        return glimpse.or(&Glimpse::exact(bytes.any::<Observation>()));
    }
    let unseen = some_faults(bytes);
    let known = glimpse.faults();
    let faults = KnownFaults::new(known.present().difference(unseen), known.absent().difference(unseen));
    // What is known of the conditions and of the faults tells of each other.
    let unseen = if bytes.one_in(2) { unseen_with(unseen) } else { Atoms::NONE };
    Glimpse::new(glimpse.atoms().forget(some_atoms(bytes).union(unseen)), faults)
}

/// The conditions that tell of these faults.
fn unseen_with(faults: Faults) -> Atoms {
    Atoms::when(Atom::SdcOpen, !faults.intersection(Faults::OPENING).is_empty())
        .union(Atoms::when(Atom::AiEstop, faults.has(Fault::AiComputerRequest)))
        .union(Atoms::when(Atom::BmsFault, faults.has(Fault::BmsFault)))
}

fn memory(bytes: &mut Bytes<'_>, memory: &Memory) -> Memory {
    let Memory { handshake, shutdown_cause, .. } = *memory;
    Memory {
        in_state: span(bytes, memory.in_state),
        go_seen_low: truth(bytes, memory.go_seen_low),
        was_running: truth(bytes, memory.was_running),
        was_forward: truth(bytes, memory.was_forward),
        handshake: if bytes.one_in(2) {
            handshake
        } else {
            Handshakes {
                idle: handshake.idle || bytes.one_in(3),
                low: waits(bytes, handshake.low),
                high: waits(bytes, handshake.high),
            }
        },
        power_cycle_needed: truth(bytes, memory.power_cycle_needed),
        shutdown_cause: Causes {
            none: shutdown_cause.none || bytes.one_in(3),
            faults: shutdown_cause.faults.union(some_faults(bytes)),
        },
    }
}

/// What else may be remembered, and now and then anything in another AS state.
pub(super) fn belief(bytes: &mut Bytes<'_>, belief: &Belief) -> Belief {
    let mut more = *belief;
    for state in AsState::ALL {
        if let Some(remembered) = belief.memory(state) {
            more = more.with(state, memory(bytes, remembered));
        } else if bytes.one_in(8) {
            let timing = bytes.pick(Edition::ALL).rules.timing;
            more = more.with(state, Memory::anything(state, &timing));
        }
    }
    more
}
