//! The arrow that is taken.
//!
//! A harness for each AS state, so that the arrows that it looks at are known: it goes from one to the next, as
//! [`Machine::outcomes`] does.

use adsdv_spec::belief::{Look, Outcome};
use adsdv_spec::messages::AsState;
use adsdv_spec::{Atoms, Knowledge, Machine};

use super::{around, covers};
use crate::prelude::*;

/// Everything that is claimed of the arrows out of a state.
fn the_arrow_is_among_the_outcomes(machine: &Machine, from: AsState) {
    let subject = subject();
    let atoms: Atoms = kani::any();
    let known = around::atoms(atoms);
    let exact = known == Knowledge::exact(atoms);
    let taken = machine.first_arrow(from, atoms);
    let (mut rest, mut rest_of_less) = (Some(known), Some(known.forget(kani::any())));
    let (mut place, mut count, mut found) = (0, 0, false);
    while let Some(known) = rest {
        let look = subject.look(machine, from, place, known);
        let of_less = match rest_of_less {
            Some(less) => subject.look(machine, from, place, less),
            None => Look { outcome: None, rest: None },
        };
        if let Some(outcome) = look.outcome {
            count += 1;
            found |= outcome.taken == taken && outcome.known.allows(atoms);
            assert!(is_among(outcome, of_less), "who knows less has each outcome");
            assert!(!exact || outcome.known == Knowledge::exact(atoms), "all stays known");
        }
        (rest, rest_of_less) = (look.rest, of_less.rest);
        place += 1;
    }
    kani::cover!(taken.is_some() && count > 1, "an arrow is taken, and another may be");
    kani::cover!(taken.is_none() && !exact, "the state stays, and not all is known");
    assert!(found, "the arrow that is taken may be, and what is so may be then");
    assert!(!exact || count == 1, "with all known there is one outcome");
}

/// Whether what is said of an arrow by who knows less allows an outcome.
fn is_among(outcome: Outcome, of_less: Look) -> bool {
    match of_less.outcome {
        Some(less) => less.taken == outcome.taken && covers(less.known, outcome.known),
        None => false,
    }
}

/// **The arrow that is taken out of AS_OFF is among the outcomes, for whatever conditions are allowed, and what is known then allows
/// them.** With all known it is the only one, and who knows less has no fewer.
///
/// Requirements: SM-1, SM-18.
#[cfg_attr(kani, kani::proof, kani::unwind(14))]
pub fn the_way_out_of_off_is_among_the_outcomes() {
    the_arrow_is_among_the_outcomes(subject().machine(), AsState::Off);
}

/// **The arrow that is taken out of AS_READY is among the outcomes**, and the rest as above.
///
/// Requirements: SM-1, SM-18.
#[cfg_attr(kani, kani::proof, kani::unwind(14))]
pub fn the_way_out_of_ready_is_among_the_outcomes() {
    the_arrow_is_among_the_outcomes(subject().machine(), AsState::Ready);
}

/// **The arrow that is taken out of AS_DRIVING is among the outcomes**, and the rest as above.
///
/// Requirements: SM-1, SM-18.
#[cfg_attr(kani, kani::proof, kani::unwind(14))]
pub fn the_way_out_of_driving_is_among_the_outcomes() {
    the_arrow_is_among_the_outcomes(subject().machine(), AsState::Driving);
}

/// **The arrow that is taken out of EMERGENCY_BRAKE is among the outcomes**, and the rest as above.
///
/// Requirements: SM-1, SM-18.
#[cfg_attr(kani, kani::proof, kani::unwind(14))]
pub fn the_way_out_of_emergency_brake_is_among_the_outcomes() {
    the_arrow_is_among_the_outcomes(subject().machine(), AsState::EmergencyBrake);
}

/// **The arrow that is taken out of AS_FINISHED is among the outcomes**, and the rest as above.
///
/// Requirements: SM-1, SM-18.
#[cfg_attr(kani, kani::proof, kani::unwind(14))]
pub fn the_way_out_of_finished_is_among_the_outcomes() {
    the_arrow_is_among_the_outcomes(subject().machine(), AsState::Finished);
}

/// **The arrow that is taken out of AS_OFF of version 4.0 is among the outcomes**, and the rest as above.
///
/// Requirements: SM-1, SM-18.
#[cfg_attr(kani, kani::proof, kani::unwind(14))]
pub fn the_way_out_of_off_is_among_the_outcomes_in_4_0() {
    the_arrow_is_among_the_outcomes(subject().machine_of_4_0(), AsState::Off);
}

/// **The arrow that is taken out of AS_READY of version 4.0 is among the outcomes**, and the rest as above.
///
/// Requirements: SM-1, SM-18.
#[cfg_attr(kani, kani::proof, kani::unwind(14))]
pub fn the_way_out_of_ready_is_among_the_outcomes_in_4_0() {
    the_arrow_is_among_the_outcomes(subject().machine_of_4_0(), AsState::Ready);
}

/// **The arrow that is taken out of AS_DRIVING of version 4.0 is among the outcomes**, and the rest as above.
///
/// Requirements: SM-1, SM-18.
#[cfg_attr(kani, kani::proof, kani::unwind(14))]
pub fn the_way_out_of_driving_is_among_the_outcomes_in_4_0() {
    the_arrow_is_among_the_outcomes(subject().machine_of_4_0(), AsState::Driving);
}

/// **The arrow that is taken out of EMERGENCY_BRAKE of version 4.0 is among the outcomes**, and the rest as above.
///
/// Requirements: SM-1, SM-18.
#[cfg_attr(kani, kani::proof, kani::unwind(14))]
pub fn the_way_out_of_emergency_brake_is_among_the_outcomes_in_4_0() {
    the_arrow_is_among_the_outcomes(subject().machine_of_4_0(), AsState::EmergencyBrake);
}

/// **The arrow that is taken out of AS_FINISHED of version 4.0 is among the outcomes**, and the rest as above.
///
/// Requirements: SM-1, SM-18.
#[cfg_attr(kani, kani::proof, kani::unwind(14))]
pub fn the_way_out_of_finished_is_among_the_outcomes_in_4_0() {
    the_arrow_is_among_the_outcomes(subject().machine_of_4_0(), AsState::Finished);
}

theorems![
    the_way_out_of_off_is_among_the_outcomes,
    the_way_out_of_ready_is_among_the_outcomes,
    the_way_out_of_driving_is_among_the_outcomes,
    the_way_out_of_emergency_brake_is_among_the_outcomes,
    the_way_out_of_finished_is_among_the_outcomes,
    the_way_out_of_off_is_among_the_outcomes_in_4_0,
    the_way_out_of_ready_is_among_the_outcomes_in_4_0,
    the_way_out_of_driving_is_among_the_outcomes_in_4_0,
    the_way_out_of_emergency_brake_is_among_the_outcomes_in_4_0,
    the_way_out_of_finished_is_among_the_outcomes_in_4_0,
];
