//! Programs under test: that the reference conforms, that every reading is recognised, that mutants fail where they are
//! broken, and that no program, however it misbehaves, is waited for longer than it may take.

#![forbid(unsafe_code)]

mod about;
mod blame;
mod edition;
mod erring;
#[path = "../../../tests/src/examples.rs"]
#[expect(unreachable_pub)] // It is public where all other tests have it from.
mod examples;
mod late;
mod misconduct;
mod mutants;
mod observed;
mod programs;
mod random;
mod readings;
mod v2026;
mod v4_0;
mod written;
