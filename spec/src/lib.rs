//! The ADS-DV Software Interface Specification, versions 3.0 and 4.0 and the CAN database of 2026, as an executable specification.
//!
//! Formula Student AI teams share one car, the ADS-DV. Their AI Computer talks over CAN to a Vehicle Control Unit (VCU)
//! that runs the Autonomous System state machine. This crate is that interface as data, pure functions and a codec:
//! no `std`, no allocation, no unsafe code, no dependencies, no panics.
//!
//! # Where things are
//!
//! | to read about | look in |
//! |---|---|
//! | the arrows of Figure 2 | [`table`], [`Rules::table`] |
//! | the conditions that they name | [`Atom`], [`Inputs::observe`] |
//! | one step of the VCU | [`Machine::step`] |
//! | what the VCU remembers | [`Control`] |
//! | what a step can depend on | [`Machine::reads`] |
//! | inputs that show a condition or a fault | [`Inputs::show`], [`Inputs::showing`] |
//! | the handshake (section 2.4, Figure 1) | [`Handshake`] |
//! | fault flags and `SHUTDOWN_CAUSE` | [`Fault`], [`Faults`] |
//! | the editions, their times and thresholds | [`Edition`], [`editions`] |
//! | what the document leaves open | [`readings`] |
//! | an edition with one thing changed | [`mutation`] |
//! | the messages and their signals (section 2) | [`messages`] |
//! | how an edition lays them out, and the reserved identifiers (section 2.3) | [`Bus`] |
//! | what reaches the actuators; every VCU frame | [`Outputs`] |
//! | the CAN database and the diagram, printed | [`export`] |
//! | what is known when not everything is seen | [`Knowledge`], [`Truth`] |
//! | what the VCU may be in then, and the step on that | [`belief`], [`Machine::react_known`] |
//!
//! `REQUIREMENTS.md`, beside this crate's sources, numbers every requirement of the document; `DISCREPANCIES.md` lists
//! where its text, its figures and the CAN database disagree.
//!
//! # One step
//!
//! ```
//! use adsdv_spec::{AsState, Control, Inputs, Machine};
//!
//! let vcu = Machine::REFERENCE;
//! let (control, outputs) = vcu.step(&Control::INITIAL, &Inputs::default(), 10);
//! assert_eq!(control.state, AsState::Off); // nothing is switched on
//! assert!(outputs.taken.is_none());
//! ```

#![no_std]
#![forbid(unsafe_code)]
// Sets are bit sets and tables are indexed by small integers; every such cast is of a constant or a bool.
#![allow(clippy::cast_possible_truncation)]

// The generators of random values are for tests on a host, and need its standard library.
#[cfg(any(feature = "arbitrary", feature = "proptest"))]
extern crate std;

mod alias;
#[cfg(feature = "serde")]
mod answers_map;
mod assi;
mod atom_text;
mod atoms;
pub mod belief;
mod bus;
mod conditions;
mod control;
mod derives;
mod edition;
pub mod editions;
pub mod export;
#[cfg(test)]
mod factors;
mod faults;
mod handshake;
mod inputs;
mod kept;
mod limits;
mod machine;
mod masks;
pub mod messages;
pub mod mutation;
mod named;
mod observation;
mod outputs;
pub mod readings;
mod reads;
mod requirements;
mod set;
mod show;
mod silence;
mod step;
pub mod table;
mod truth;
mod unknown_name;

pub use assi::Assi;
pub use atom_text::AtomText;
pub use atoms::{Atom, Atoms};
pub use bus::{Bus, Reserved};
pub use control::Control;
pub use edition::{Edition, Rules};
pub use faults::{Fault, Faults};
pub use handshake::Handshake;
pub use inputs::{AiMessages, Inputs, Reports, ShutdownCircuit, Vehicle};
pub use kept::{Kept, Literals};
pub use limits::{Thresholds, Timing};
pub use machine::{Machine, Noticed, Reaction, Taken};
pub use messages::AsState;
pub use mutation::Mutation;
pub use observation::Observation;
pub use outputs::{Actuation, Outputs, VcuMessages};
pub use readings::{Choice, Choices, Reading, Readings};
pub use reads::Reads;
pub use requirements::{Numbers, Replaced, Requirements, requirement};
pub use silence::AiSilence;
pub use table::{Row, Table, Term};
pub use truth::{Knowledge, Truth};
pub use unknown_name::UnknownName;
