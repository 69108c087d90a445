//! Tests across the crates of adsdv: the tests are in `tests/`, recorded logs in `logs/`, golden files in `golden/`.

pub mod world;
