//! The step for 64 input vectors at once: [`Machine::react`](adsdv_spec::Machine::react) as a boolean network over machine words.
//!
//! Each atom and each fault is a [plane](Planes): a word with a bit, a *lane*, for each of 64 vectors. From one control state a
//! few hundred instructions then find, for all of them, which arrow is taken first, what the handshake answers, what the memory
//! takes up and which fault is the cause.
//!
//! ```text
//! Planes --guarded--> Guarded --arrows--> which row is taken first --groups--> lanes that come to the same, by Key
//!                        what the AI Computer is heard to say ------^   ^------ what is kept, and the cause
//! ```
//!
//! Nothing of the document is written here. The guards are the terms of the table; what the control state decides,
//! what is heard and what is kept come from the factors of a step, which `adsdv-spec` has as functions: those of few inputs
//! are tabulated ([`Machine::hear`](adsdv_spec::Machine::hear)), those that are conditions are evaluated as such
//! ([`Machine::kept`](adsdv_spec::Machine::kept)). And no control state is made here: lanes that
//! come to the same have one [`Key`], so that one call of `react`, for one of them, has the control state for all.
//!
//! | to read about | look in |
//! |---|---|
//! | 64 observations, as words | [`Planes`] |
//! | the gates of a machine, and what a control state decides | [`Network`], [`Wired`] |
//! | the conditions as the guards see them | [`Guarded`] |
//! | which arrow is taken first | [`Wired::arrows`] |
//! | which lanes come to the same control state | [`Wired::groups`] |
//!
//! ```
//! use adsdv_network::{Network, Planes};
//! use adsdv_spec::{Atom, Atoms, AsState, Control, Faults, Machine, Observation};
//!
//! let vcu = Machine::REFERENCE;
//! let due = Atoms::of(&[Atom::Asms, Atom::Tsms, Atom::AmiSelected, Atom::MissionSelected, Atom::EbsArmed]);
//! let seen = [Atoms::NONE, due].map(|atoms| Observation::new(atoms, Faults::NONE));
//! let network = Network::new(&vcu);
//! network.at(&Control::INITIAL, 10).groups(&Planes::of(&seen), |key, lanes| {
//!     let expected = if key.to() == AsState::Ready { 0b10 } else { 0b01 };
//!     assert_eq!(lanes, expected);
//! });
//! ```
//!
//! That the network is `react` is a theorem of `proofs/src/network.rs`, lane by lane, and tried in `tests/` for every edition, its
//! readings and the mutants of its table.

#![no_std]
#![forbid(unsafe_code)]
// Places in small tables; every such cast is of less than 64.
#![allow(clippy::cast_possible_truncation)]

#[cfg(feature = "arbitrary")]
extern crate std;

mod arrows;
mod groups;
mod guarded;
mod heard;
mod network;
mod planes;

pub use groups::Key;
pub use guarded::Guarded;
pub use network::{Gate, Network, Wired};
pub use planes::{LANES, Planes};
