//! What may be known of something that is so: each function draws anything that allows it, and often it and nothing else.
//!
//! Something drawn by itself would hardly ever allow what is so, and a theorem would speak of nothing.

use adsdv_spec::belief::{Causes, Handshakes, KnownFaults, Memory, Span};
use adsdv_spec::messages::ShutdownCause;
use adsdv_spec::{Atoms, Control, Faults, Handshake, Knowledge, Truth};

#[cfg(not(kani))]
use crate::kani;

/// A span with this time in it.
pub(super) fn span(ms: u16) -> Span {
    if kani::any() { Span::exact(ms) } else { wider(Span::exact(ms)) }
}

/// A span with all that is in this one.
pub(super) fn wider(span: Span) -> Span {
    let (before, after): (u16, u16) = (kani::any(), kani::any());
    Span::between(span.least_ms().saturating_sub(before), span.most_ms().saturating_add(after))
}

/// What may be known of a fact.
pub(super) fn truth(fact: bool) -> Truth {
    less(fact.into())
}

/// As much as this claim says, or less.
pub(super) fn less(claim: Truth) -> Truth {
    if kani::any() { Truth::Unknown } else { claim }
}

/// What may be known when exactly these atoms are on.
pub(super) fn atoms(on: Atoms) -> Knowledge {
    let exact = Knowledge::exact(on);
    if kani::any() { exact } else { exact.forget(kani::any()) }
}

/// What may be known when exactly these faults are present.
pub(super) fn faults(present: Faults) -> KnownFaults {
    let exact = KnownFaults::exact(present);
    if kani::any() { exact } else { less_of_faults(exact) }
}

/// As much of the faults, or less.
pub(super) fn less_of_faults(known: KnownFaults) -> KnownFaults {
    let unseen = if kani::any() { kani::any() } else { Faults::NONE.with(kani::any()) };
    KnownFaults::new(known.present().difference(unseen), known.absent().difference(unseen))
}

/// Causes with this one among them.
pub(super) fn causes(cause: ShutdownCause) -> Causes {
    let exact = Causes::exact(cause);
    if kani::any() { exact } else { more_causes(exact) }
}

/// These causes and any others.
pub(super) fn more_causes(causes: Causes) -> Causes {
    let (none, faults): (bool, Faults) = (kani::any(), kani::any());
    Causes { none: causes.none || none, faults: causes.faults.union(faults) }
}

/// Any handshake that a step can leave: one that rests has nothing else to say.
pub(super) fn any_handshake() -> Handshake {
    kani::any_where(|drawn: &Handshake| drawn.active || *drawn == Handshake::IDLE)
}

/// Handshakes with this one among them.
pub(super) fn handshakes(handshake: Handshake) -> Handshakes {
    let exact = Handshakes::exact(handshake);
    if kani::any() { exact } else { more_handshakes(exact) }
}

/// These handshakes and any others.
pub(super) fn more_handshakes(handshakes: Handshakes) -> Handshakes {
    let idle: bool = kani::any();
    Handshakes {
        idle: handshakes.idle || idle,
        low: wider_or_new(handshakes.low),
        high: wider_or_new(handshakes.high),
    }
}

fn wider_or_new(span: Option<Span>) -> Option<Span> {
    match span {
        Some(span) => Some(wider(span)),
        None if kani::any() => Some(Span::between(kani::any(), kani::any())),
        None => None,
    }
}

/// Any control state with a handshake that a step can leave.
pub(super) fn any_control() -> Control {
    Control { handshake: any_handshake(), ..kani::any() }
}

/// Memories with that of this control state among them.
pub(super) fn memory(control: &Control) -> Memory {
    let exact = Memory::exact(control);
    if kani::any() { exact } else { more_memories(exact) }
}

/// These memories and any others.
pub(super) fn more_memories(memory: Memory) -> Memory {
    Memory {
        in_state: wider(memory.in_state),
        go_seen_low: less(memory.go_seen_low),
        was_running: less(memory.was_running),
        was_forward: less(memory.was_forward),
        handshake: more_handshakes(memory.handshake),
        power_cycle_needed: less(memory.power_cycle_needed),
        shutdown_cause: more_causes(memory.shutdown_cause),
    }
}
