//! Tests across the crates of adsdv: the tests are in `tests/`, recorded logs in `logs/`.

pub mod bus;
pub mod examples;
pub mod fuzzed;
pub mod property;
pub mod world;

/// The README's examples compile and run.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
mod readme {}

/// So do those of the specification crate.
#[cfg(doctest)]
#[doc = include_str!("../../spec/README.md")]
mod spec_readme {}
