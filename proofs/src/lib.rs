//! Theorems about the ADS-DV interface: proven with Kani, and run as tests and by a fuzzer.
//!
//! Each theorem is one harness: a function without arguments that draws any values there are, assumes what the theorem
//! assumes, and asserts what it claims. Kani proves it for all of these values at once (`cargo kani -p adsdv-proofs`).
//! Without Kani the same function runs on thousands of concrete values, or on all of a small domain (`cargo test -p
//! adsdv-proofs`), by way of a stand-in for the few functions of Kani that are used.
//!
//! A harness says in its documentation what it claims, in plain words, and which requirements that covers. It has a
//! `kani::cover!` for the interesting case, so that it cannot hold for want of one, and the tests have a mutant of the
//! specification that it catches.
//!
//! | theorems | file |
//! |---|---|
//! | nothing panics, overflows or reads out of bounds | [`totality`] |
//! | what always holds of the control state | [`invariant`] |
//! | the safety properties that the model checks, for every input and every time | [`safety`] |
//! | the whole step is what the document's words say; each arrow of Figure 2, both ways | [`figure2`] |
//! | the whole step under each choice of a reading | [`readings`] |
//! | how time counts | [`time`] |
//! | what a step can depend on | [`factoring`], [`independence`] |
//! | 64 steps at once are the steps one by one | [`network`] |
//! | the handshake | [`handshake`] |
//! | messages: each byte by byte, the whole table, reserved identifiers | [`codec`] |
//! | what the VCU sends and what reaches the actuators | [`outputs`], [`outputs_of_4_0`], [`outputs_of_2026`] |
//! | what a judge may say who does not see everything | [`truth`] |
//! | what a VCU may be in that is not seen whole | [`belief`] |
//!
//! [`words`] restates the document in plain `if`s, for the theorems to hold the specification against. [`subject`] is
//! the specification as the theorems see it, which a test can replace. `seed` is what the stand-in for Kani draws random
//! values from.

#![forbid(unsafe_code)]
// A harness is an assertion: that it panics where it does not hold is what it is for.
#![allow(clippy::missing_panics_doc)]

pub mod belief;
pub mod codec;
mod coded;
mod document;
pub mod factoring;
pub mod figure2;
pub mod handshake;
pub mod independence;
pub mod invariant;
#[cfg(not(kani))]
pub mod kani;
pub mod network;
pub mod outputs;
pub mod outputs_of_2026;
pub mod outputs_of_4_0;
mod prelude;
pub mod readings;
pub mod safety;
#[cfg(not(kani))]
pub mod seed;
pub mod steps;
pub mod subject;
#[cfg(not(kani))]
pub mod theorems;
pub mod time;
pub mod totality;
pub mod truth;
pub mod words;
