//! Whole recordings, decoded.

#![forbid(unsafe_code)]

mod cantools;
mod dbc;
mod formats;
mod frames;
#[cfg(feature = "mcap")]
mod mcap;
#[cfg(feature = "parquet")]
mod parquet;
mod python;
#[cfg(feature = "parquet")]
mod tables;
#[cfg(not(feature = "parquet"))]
mod without_parquet;
