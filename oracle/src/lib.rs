//! The judge: holds recordings and live buses against the specification of the ADS-DV AI/VCU interface.

#![forbid(unsafe_code)]

pub mod candump;
pub mod chance;
pub mod compare;
pub mod excerpt;
pub mod judge;
pub mod log;
pub mod recognise;
pub mod remote;
pub mod requirements;
pub mod rules;
pub mod text;
pub mod why;
