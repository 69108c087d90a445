//! The ADS-DV on a CAN bus: what the specification says, sent and received.
//!
//! ```text
//! scenario --actions--> Car <---frames--- bus <---frames--- Ai
//!  (or keys)             |  ---frames-->  |  ---frames-->  (or a team's own AI stack)
//!                        |                |
//!           the VCU of adsdv-spec         +--> log of candump --> the judge of adsdv-oracle
//!           and a simple vehicle
//! ```
//!
//! Nothing is decided here that the specification could decide: the car asks [`adsdv_spec::Machine`] once a cycle and sends
//! what it says.
//!
//! | to read about | look in |
//! |---|---|
//! | the VCU with its operator and its vehicle | [`car`] |
//! | the file that says what the operator does | [`scenario`] |
//! | a small AI Computer that drives one mission | [`ai`] |
//! | a whole mission without any CAN | [`demo`] |
//! | cycles of real time | [`clock`] |
//! | SocketCAN, with all that can go wrong | [`socket`] |
//! | the car and the AI on a real bus | [`live`] |
//!
//! The car, the AI, the scenario and the demo know neither a clock nor a socket: the caller gives them the time.

#![forbid(unsafe_code)]

pub mod ai;
pub mod bus;
pub mod car;
pub mod clock;
pub mod demo;
pub mod live;
pub mod scenario;
pub mod socket;
pub mod status;

/// The bit rate of the bus, in bits per second (section 1).
pub const BITRATE: u32 = 500_000;

/// The examples of the README.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct Readme;
