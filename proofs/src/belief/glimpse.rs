//! What is known of an observation, and of its conditions under a reading.

use adsdv_spec::belief::{Glimpse, KnownFaults};
use adsdv_spec::{Atom, Atoms, Choice, Edition, Fault, Faults, Knowledge, Machine, Observation};

use super::{around, covers};
use crate::prelude::*;

/// What may be known when this is seen. Inputs have no say in the conditions and faults beyond an observation's: of those
/// anything may be said.
fn any_known_of(seen: Observation) -> (Knowledge, KnownFaults) {
    let (atoms, faults): (Atoms, Faults) = (kani::any(), kani::any());
    let atoms = seen.atoms().union(atoms.difference(Observation::SCOPE));
    let faults = seen.faults().union(faults.difference(Observation::FAULTS));
    (around::atoms(atoms), around::faults(faults))
}

/// A glimpse that allows this observation: one, or one of two.
fn any_glimpse_of(seen: Observation) -> Glimpse {
    let (atoms, faults) = any_known_of(seen);
    let glimpse = Glimpse::new(atoms, faults);
    if kani::any() { glimpse } else { glimpse.or(&any_other_glimpse()) }
}

fn any_other_glimpse() -> Glimpse {
    let (atoms, faults) = any_known_of(kani::any());
    Glimpse::new(atoms, faults)
}

/// **A glimpse allows every observation that what is known of its conditions and what is known of its faults both allow, and
/// forgets nothing of either.** With all known it is the observation.
///
/// Requirements: SM-1, RTE-1, D-17.
#[cfg_attr(kani, kani::proof, kani::unwind(2))]
pub fn a_glimpse_allows_what_was_seen() {
    let seen: Observation = kani::any();
    let (atoms, faults) = any_known_of(seen);
    let glimpse = subject().glimpse(atoms, faults);
    let found = glimpse.faults().present().difference(faults.present());
    kani::cover!(
        !found.intersection(Faults::OPENING.without(Fault::BmsFault)).is_empty(),
        "the one fault left"
    );
    kani::cover!(
        glimpse.atoms().on().has(Atom::SdcOpen) && !atoms.on().has(Atom::SdcOpen),
        "a fault tells of the circuit"
    );
    assert!(glimpse.allows(seen), "what was seen may be");
    let scope = Observation::SCOPE;
    assert!(atoms.on().intersection(scope).is_subset(glimpse.atoms().on()), "what is on stays known");
    assert!(atoms.off().intersection(scope).is_subset(glimpse.atoms().off()), "what is off stays known");
    let kept = faults.present().intersection(Observation::FAULTS);
    assert!(kept.is_subset(glimpse.faults().present()), "what is present stays known");
    let kept = faults.absent().intersection(Observation::FAULTS);
    assert!(kept.is_subset(glimpse.faults().absent()), "what is absent stays known");
    let all =
        atoms.on().union(atoms.off()) == Atoms::ALL && faults.present().union(faults.absent()) == Faults::ALL;
    assert!(!all || glimpse == Glimpse::exact(seen), "with all known it is the observation");
}

/// **Who knows less catches a glimpse of no more**, as long as what is known can be.
///
/// Requirements: SM-1.
#[cfg_attr(kani, kani::proof, kani::unwind(2))]
pub fn knowing_less_is_a_glimpse_of_no_more() {
    let (atoms, faults) = any_known_of(kani::any());
    let more = subject().glimpse(atoms, faults);
    let less = subject().glimpse(atoms.forget(kani::any()), around::less_of_faults(faults));
    kani::cover!(less != more, "less is known");
    assert!(less.covers(&more), "who knows less allows as much");
}

/// **One glimpse or another allows what either does**, and covers both; one covers the other exactly where joining them adds
/// nothing to it.
///
/// Requirements: SM-1.
#[cfg_attr(kani, kani::proof, kani::unwind(2))]
pub fn glimpses_are_joined() {
    let seen: Observation = kani::any();
    let one = any_glimpse_of(seen);
    let other = if kani::any() { one.or(&any_other_glimpse()) } else { any_other_glimpse() };
    let either = subject().join_glimpses(&one, &other);
    kani::cover!(other.covers(&one) && one != other, "the other covers it");
    assert!(either.allows(seen), "what one allows");
    assert!(either.covers(&one) && either.covers(&other), "what either allows");
    assert!(other.covers(&one) == (either == other), "covered is what adds nothing");
    assert!(!other.covers(&one) || other.allows(seen), "what covers it allows what it does");
}

/// What is known of the conditions of a machine when this is known of the observation.
fn known_atoms_of(machine: &Machine) {
    let seen: Observation = kani::any();
    let glimpse = any_glimpse_of(seen);
    let known = subject().known_atoms_of(machine, &glimpse);
    let atoms = machine.atoms_of(seen);
    kani::cover!(known != Knowledge::exact(atoms) && glimpse != Glimpse::exact(seen), "not all is known");
    kani::cover!(glimpse == Glimpse::exact(seen) && atoms.has(Atom::SdcOpen), "all is known");
    assert!(known.allows(atoms), "what is so may be");
    assert!(glimpse != Glimpse::exact(seen) || known == Knowledge::exact(atoms), "all stays known");
    let less = subject().known_atoms_of(machine, &glimpse.or(&any_other_glimpse()));
    assert!(covers(less, known), "who knows less allows as much");
}

/// **What is known of the conditions under the default readings allows those that there are**; with all known it is them, and
/// who knows less knows no more of them.
///
/// Requirements: SM-1.
#[cfg_attr(kani, kani::proof, kani::unwind(2))]
pub fn conditions_are_known_from_a_glimpse() {
    known_atoms_of(subject().machine());
}

/// Version 4.0, where a fault of the battery alone brakes in AS_DRIVING only.
const BMS_DRIVING: &Machine = &Machine::new(Edition::V4_0, Edition::V4_0.readings.with(Choice::BmsDriving));

/// **What is known of the conditions of version 4.0 allows those that there are, also where a fault of the battery alone does not
/// count as an open circuit**; with all known it is them, and who knows less knows no more of them.
///
/// Requirements: SM-1, D-54.
#[cfg_attr(kani, kani::proof, kani::unwind(2))]
pub fn conditions_are_known_from_a_glimpse_where_the_battery_does_not_open_the_circuit_in_4_0() {
    known_atoms_of(BMS_DRIVING);
}

theorems![
    a_glimpse_allows_what_was_seen,
    knowing_less_is_a_glimpse_of_no_more,
    glimpses_are_joined,
    conditions_are_known_from_a_glimpse,
    conditions_are_known_from_a_glimpse_where_the_battery_does_not_open_the_circuit_in_4_0,
];
