//! The AI Computer under test: is its car, its operator and its judge, in one scenario after the other.
//!
//! ```text
//! scenarios.rs --operator, disturbances--> session.rs <---frames of 10 ms---> Stack (a program, or the reference)
//!                                             |
//!                       expectations.rs <-----+-----> the judge of adsdv-oracle
//!                              |                           |
//!                              +----> findings.rs <--------+
//!                                          |
//!                                       exam.rs ---> report.rs: a verdict for each requirement (catalogue.rs)
//! ```
//!
//! The scenario language, the car and the VCU are those of `adsdv-can`, and what the judge finds is said in its words: `adsdv check`
//! says the same of a log. What only an exam can see, that something was not done which was to be done, is an expectation of a
//! scenario, beside its requirement. Nothing passes by silence: what no scenario has exercised is not passed, and says why.
//!
//! Beside the scenarios that are written there are [those by chance](random_scenarios) and [those of files](ExamScenario::read), and
//! what is wrong in one has a [shortest scenario](shortest) that shows it.
//!
//! What is examined in simulated time is a [`Stack`]: it is asked for the frames of a step of 10 ms, whatever is behind it. In real
//! time it is any program on a bus of SocketCAN ([`exam_live`]).

#![forbid(unsafe_code)]

mod about;
mod catalogue;
mod course;
mod disturbance;
mod exam;
mod expectation;
mod expectations;
mod findings;
mod json;
mod length;
mod live;
mod log;
mod look;
mod program;
mod program_error;
mod random;
mod report;
mod scenario;
mod scenario_text;
mod scenarios;
mod seconds;
mod serve;
mod session;
mod shrink;
mod stack;
mod tally;
mod words;

pub use catalogue::{Requirement, requirements};
pub use disturbance::{Disturbance, Effect, Onset, Sensors};
pub use exam::{ExamOptions, ExamProgress, exam};
pub use expectation::{Condition, Expectation, Kind, Within};
pub use json::ExamForm;
pub use length::{BESIDE, estimate};
pub use live::{
    LiveBus, LiveError, LiveOptions, LiveProgram, LiveProgress, LiveReport, exam_live, prepare_namespaces,
};
pub use log::write_log;
pub use look::Look;
pub use program::{MAX_FRAMES, StdioStack};
pub use program_error::{Failure, StackError, StackErrorKind, StackErrorPlace};
pub use random::{SEED, random_scenarios};
pub use report::{ExamFinding, ExamReport, Examined, FoundBy, Outcome, ScenarioOutcome};
pub use scenario::ExamScenario;
pub use scenarios::{NoScenario, chosen, scenarios};
pub use serve::serve;
pub use session::{Change, Sent};
pub use shrink::{FINDINGS, Shorter, Shortest, shorter, shortest};
pub use stack::{Reference, Stack};
pub use words::{FRAMES, Pieces};

/// The examples of the README.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct Readme;
