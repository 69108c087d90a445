//! The estimator: what may be so of the VCU, given what the sampler has.
//!
//! `base.rs` holds what is known, now and in the recent past; `status.rs` and `samples.rs` learn it from 520h and from all other
//! messages. What a state may do next, under every reading that is open, is for `readings.rs`, by the proven steps of
//! [`adsdv_spec::belief`].
//!
//! What is written by hand all the same, and why the proven step on what may be does not do it:
//!
//! - `watch.rs`, the handshake: within a window each side changes its bit several times, so that nothing is known of the bits throughout.
//!   Which frame came after which tells.
//! - `silences.rs`, missed messages: the VCU counts what it does not get, and a recording has what the recorder got.
//! - the changes in `status.rs` ("Go", FINISHED, NEUTRAL): a change counts in one step, and the bus does not show which.
//! - `remote.rs`: no document says which level of the E-stop's bit is that of a button which is pressed.

pub(super) mod base;
pub(super) mod history;
pub(super) mod readings;
pub(super) mod remote;
mod samples;
pub(super) mod silences;
pub(super) mod status;
pub(super) mod watch;
