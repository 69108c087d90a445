//! The judge: holds logs and programs under test against the specification of the ADS-DV AI/VCU interface.

#![forbid(unsafe_code)]

pub mod candump;
pub mod chance;
pub mod compare;
pub mod conform;
pub mod excerpt;
pub mod judge;
pub mod log;
pub mod protocol;
pub mod recognise;
pub mod remote;
pub mod rules;
pub mod suite;
pub mod text;
pub mod why;
