//! The estimator: what may be so of the VCU, given what the sampler has.
//!
//! `base.rs` holds what is known, now and in the recent past; `status.rs` and `samples.rs` learn it from 520h and from all other
//! messages. What a state may do next, under every reading that is open, is for `readings.rs`, by the proven steps of
//! [`adsdv_spec::belief`].

pub(super) mod base;
pub(super) mod history;
pub(super) mod readings;
pub(super) mod remote;
mod samples;
pub(super) mod silences;
pub(super) mod status;
pub(super) mod watch;
