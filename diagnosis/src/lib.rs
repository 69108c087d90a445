//! Which state machine a program has: Figure 2 as it does it, and every deviation from the document by itself.
//!
//! A program that is wrong in several places fails most tests for the first of them, and none tells of the others. So this does not
//! replay tests: it asks the program, explains its answers by deviations from the specification, and asks again with what it
//! has learnt, until nothing is left unexplained or nothing more can be explained.
//!
//! ```text
//! Deviations --> Model: the specification with them, a state machine as good as any
//!                  |
//!                  v
//!      Experiments: ways to every state by that model, and what is worth changing there
//!                  |
//!                  v
//! Program <--> Record: what was asked, and what it answered
//!                  |
//!                  v
//!               Fit: the deviations that explain the most answers; again from the start with these
//! ```
//!
//! A deviation is named only if taking it away explains less. Another deviation that explains as much stands beside it.
//!
//! - `subject.rs`: what is asked, step by step: a program, or a state machine in this process; `interface.rs`: the inputs and the
//!   outputs that it has, and `fixed.rs`: the conditions that these cannot change;
//! - `deviation.rs`: what a program may do otherwise (`named.rs`: by its id, `every.rs`: all of them); `words.rs`: what that is called, and `against.rs`: the
//!   requirements that it is against;
//! - `model.rs`: the state machine that does so, `rest.rs` with what is no change of Figure 2, `seen.rs` what of its
//!   inputs, and `causes.rs` what of an emergency; `running.rs`: as a program;
//! - `hop.rs`: what leads from one state to the next; `ways/mod.rs`: the ways to the states by a model, and `ways/search.rs` how they are found;
//!   `pilot.rs`: leads a program on them, `prepare.rs` up to an arrow, and `lead.rs` at once where the answers are foreseen; `dials.rs`: the inputs that can be changed;
//! - `experiments.rs`: what is tried in each state, `moments.rs` when a time is over, `seek.rs` for arrows that seem to be missing, and `walk.rs` by chance;
//! - `record.rs`: what was answered, `cycles.rs` where it is asked at a fixed cycle, and `stays.rs`: the same, state by state;
//! - `candidates.rs`: the deviations that may explain an answer; `turn.rs`: the time or the value at which the program turns;
//! - `fit.rs`: those that do, by some of the records (`sample.rs`), `sets.rs` several of them at once, `nearest.rs` the nearest of them, and `certain.rs` whether they
//!   are sure;
//! - `diagnose.rs`: all of it in turn, `found.rs` what comes of it, `again.rs` whether that is so each time, `in_the_way.rs` without outputs that nothing explains;
//! - `example.rs`: the shortest scenario that shows a deviation; `figure.rs`: Figure 2 as the program does it.
//!
//! ```
//! use adsdv_diagnosis::{Deviation, Model, diagnose};
//! use adsdv_spec::Edition;
//! use adsdv_spec::mutation::{Change, Time};
//!
//! // A VCU that takes the AI Computer for lost after 500 ms, and not after 50 ms.
//! let late = Deviation::Changed(Change::Time(Time::Handshake, 450));
//! let mut program = Model::new(&Edition::V3_0, &[late]).running();
//! let found = diagnose(&mut program, &Edition::V3_0)?;
//! assert_eq!(found.deviations, [late]);
//! assert!(found.unexplained.is_empty());
//! # Ok::<(), adsdv_conform::ProgramError>(())
//! ```
#![forbid(unsafe_code)]

mod again;
mod against;
mod candidates;
mod causes;
mod certain;
mod cycles;
mod deviation;
mod diagnose;
mod dials;
mod every;
mod example;
mod experiments;
mod figure;
mod fit;
mod fixed;
mod found;
mod hop;
mod in_the_way;
mod interface;
mod lead;
mod model;
mod moments;
mod named;
mod nearest;
mod pilot;
mod prepare;
mod record;
mod rest;
mod running;
mod sample;
mod seek;
mod seen;
mod sets;
mod stays;
mod subject;
mod turn;
mod walk;
mod ways;
mod words;

pub use deviation::{Deviation, Remembers, Wheels};
pub use diagnose::{diagnose, diagnose_within, records};
pub use example::{Example, examples};
pub use figure::{Arrow, figure};
pub use found::Diagnosis;
pub use interface::Interface;
pub use model::{Memory, Model};
pub use record::Record;
pub use running::Running;
pub use subject::Subject;
pub use walk::difference;
