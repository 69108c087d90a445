//! What is remembered after a step, and the faults that 520h shows.
//!
//! A harness for each AS state, so that the arrows that it looks at are known. Of version 4.0 only AS_DRIVING has another: the
//! other rows are those of 3.0.

use adsdv_spec::belief::{Handshakes, KnownFaults, Memory, Now, Possible, Span};
use adsdv_spec::messages::AsState;
use adsdv_spec::{Atom, Atoms, Control, Faults, Knowledge, Machine, Noticed, Observation};

use super::around;
use crate::prelude::*;

/// Anything that a step can notice: where the circuit counts as open, a fault opens it.
fn any_noticed() -> Noticed {
    let seen: Observation = kani::any();
    let atoms: Atoms = kani::any();
    let open = !seen.faults().intersection(Faults::OPENING).is_empty();
    let (in_state_ms, comms_lost): (u16, bool) = (kani::any(), kani::any());
    Noticed {
        atoms: if open { atoms } else { atoms.without(Atom::SdcOpen) },
        faults: seen.faults(),
        in_state_ms,
        handshake: around::any_handshake(),
        comms_lost,
    }
}

/// What may be known of it.
fn known_of(noticed: &Noticed) -> Now {
    Now {
        atoms: around::atoms(noticed.atoms),
        faults: around::faults(noticed.faults),
        in_state: around::span(noticed.in_state_ms),
        handshake: around::handshakes(noticed.handshake),
        comms_lost: noticed.comms_lost,
    }
}

/// What is known when all is.
fn all_of(noticed: &Noticed) -> Now {
    Now {
        atoms: Knowledge::exact(noticed.atoms),
        faults: KnownFaults::exact(noticed.faults),
        in_state: Span::exact(noticed.in_state_ms),
        handshake: Handshakes::exact(noticed.handshake),
        comms_lost: noticed.comms_lost,
    }
}

/// As much of it, or less.
fn less_of(now: &Now) -> Now {
    Now {
        atoms: now.atoms.forget(kani::any()),
        faults: around::less_of_faults(now.faults),
        in_state: around::wider(now.in_state),
        handshake: around::more_handshakes(now.handshake),
        comms_lost: now.comms_lost,
    }
}

/// Everything that is claimed of what is remembered after a step from a state.
fn what_is_remembered_may_be(machine: &Machine, from: AsState) {
    let subject = subject();
    // Written down, so that the proof knows it as a constant.
    let control = Control { state: from, ..around::any_control() };
    let noticed = any_noticed();
    let taken = machine.first_arrow(from, noticed.atoms);
    let after = machine.remember(&control, &noticed, taken);

    let all = kani::any();
    let (memory, now) = if all {
        (Memory::exact(&control), all_of(&noticed))
    } else {
        (around::memory(&control), known_of(&noticed))
    };
    let Possible { memory: remembered, faults } = subject.remember_known(machine, from, &memory, &now, taken);
    kani::cover!(!all && taken.is_some(), "an arrow is taken, and not all is known");
    kani::cover!(all && taken.is_none(), "the state stays, and all is known");
    assert!(remembered.allows(&after.control), "what is remembered may be");
    assert!(faults.allows(after.faults), "the faults that are shown may be");
    if all {
        assert!(remembered == Memory::exact(&after.control), "all that is remembered is known");
        assert!(faults == KnownFaults::exact(after.faults), "all faults are known");
    }
    let less = subject.remember_known(machine, from, &around::more_memories(memory), &less_of(&now), taken);
    assert!(less.memory.covers(&remembered), "who knows less allows as much of the memory");
    assert!(less.faults.covers(faults), "who knows less allows as much of the faults");
}

/// **What a step from AS_OFF remembers, and the faults that it shows, are of what may be**, whatever was remembered and noticed of
/// what was allowed. With all known they are known, and who knows less knows no more of them.
///
/// Requirements: SM-1, D-15, D-16, D-17.
#[cfg_attr(kani, kani::proof, kani::unwind(14))]
pub fn what_is_remembered_after_off_may_be() {
    what_is_remembered_may_be(subject().machine(), AsState::Off);
}

/// **What a step from AS_READY remembers, and the faults that it shows, are of what may be**, and the rest as above.
///
/// Requirements: SM-1, D-15, D-16, D-17.
#[cfg_attr(kani, kani::proof, kani::unwind(14))]
pub fn what_is_remembered_after_ready_may_be() {
    what_is_remembered_may_be(subject().machine(), AsState::Ready);
}

/// **What a step from AS_DRIVING remembers, and the faults that it shows, are of what may be**, and the rest as above.
///
/// Requirements: SM-1, D-15, D-16, D-17.
#[cfg_attr(kani, kani::proof, kani::unwind(14))]
pub fn what_is_remembered_after_driving_may_be() {
    what_is_remembered_may_be(subject().machine(), AsState::Driving);
}

/// **What a step from EMERGENCY_BRAKE remembers, and the faults that it shows, are of what may be**, and the rest as above.
///
/// Requirements: SM-1, D-15, D-16, D-17.
#[cfg_attr(kani, kani::proof, kani::unwind(14))]
pub fn what_is_remembered_after_emergency_brake_may_be() {
    what_is_remembered_may_be(subject().machine(), AsState::EmergencyBrake);
}

/// **What a step from AS_FINISHED remembers, and the faults that it shows, are of what may be**, and the rest as above.
///
/// Requirements: SM-1, D-15, D-16, D-17.
#[cfg_attr(kani, kani::proof, kani::unwind(14))]
pub fn what_is_remembered_after_finished_may_be() {
    what_is_remembered_may_be(subject().machine(), AsState::Finished);
}

/// **What a step from AS_DRIVING of version 4.0 remembers, and the faults that it shows, are of what may be**, and the rest as above.
///
/// Requirements: SM-1, D-15, D-16, D-17.
#[cfg_attr(kani, kani::proof, kani::unwind(14))]
pub fn what_is_remembered_after_driving_may_be_in_4_0() {
    what_is_remembered_may_be(subject().machine_of_4_0(), AsState::Driving);
}

theorems![
    what_is_remembered_after_off_may_be,
    what_is_remembered_after_ready_may_be,
    what_is_remembered_after_driving_may_be,
    what_is_remembered_after_emergency_brake_may_be,
    what_is_remembered_after_finished_may_be,
    what_is_remembered_after_driving_may_be_in_4_0,
];
