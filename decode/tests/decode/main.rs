//! Whole recordings, decoded.

#![forbid(unsafe_code)]

mod cantools;
mod dbc;
mod formats;
mod frames;
#[cfg(feature = "mcap")]
mod mcap;
mod python;
