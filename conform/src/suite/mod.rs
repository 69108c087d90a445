//! The test suite: scenarios with the outputs that are expected, generated from the table.
//!
//! - `scenario.rs`: steps of a VCU from power-on, and what a machine shows in each;
//! - `test.rs`: a scenario with a name and the requirements that it checks;
//! - `lines.rs`: the tests as JSON Lines, written and read; `steps.rs`: their steps as a person writes them;
//! - `generate/`: the tests, made from the table; `walk.rs` gets a machine to where a test begins, and `requirements.rs` says
//!   which requirements a condition and two rows stand for; `untested.rs` has those that no test is for;
//! - `prove.rs`: whether they tell every mutation of the specification from it.
//!
//! # How the suite grows
//!
//! Each alternative of a row is one test, and each of its conditions one more; two rows of a state that can hold at once are
//! one for each pair of their alternatives; each threshold and time is three for each place it is measured at; each fault is
//! one for each state in which it counts; and each state has one for what reaches the actuators, and up to three for what it
//! has no arrow for. So with `r` rows of `t` alternatives of `c` conditions, `s` states and `f` faults the suite has in the
//! order of `r t (c + t) + s f` tests. One of them has at most as many steps as it takes to get to a state, and one more for
//! each condition that needs a time, each state to which there is no arrow, or each value of an enumeration: it grows with
//! the conditions that a row names, and not with the number of their combinations.

mod generate;
mod lines;
mod prove;
mod requirements;
mod scenario;
mod steps;
mod test;
mod untested;
mod walk;

use adsdv_spec::Edition;

pub use lines::{BadTest, MAX_BAD, MAX_LINE, MAX_STEPS, ReadSuite, SCHEMA, read};
pub use prove::{Proof, prove};
pub use scenario::{Scenario, Step};
pub use test::{Kind, Test};
pub use untested::{Reason, Untested, about_the_vcu, untested};

/// The tests of an edition of the interface.
///
/// What is expected in each is what the specification shows under the readings that are asked of a program: by default
/// the default ones.
pub fn generate(edition: &Edition) -> Vec<Test> {
    generate::all(edition)
}
