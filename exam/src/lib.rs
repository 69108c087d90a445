//! The AI Computer under test: is its car, its operator and its judge, in one scenario after the other.
//!
//! ```text
//! scenarios.rs --operator, disturbances--> session.rs <---frames of 10 ms---> Stack (a program, or the reference)
//!                                             |
//!                       expectations.rs <-----+-----> the judge of adsdv-oracle
//!                              |                           |
//!                              +------> exam.rs <----------+   a verdict for each requirement (catalogue.rs)
//! ```
//!
//! The scenario language, the car and the VCU are those of `adsdv-can`, and what the judge finds is said in its words: `adsdv check`
//! says the same of a log. What only an exam can see, that something was not done which was to be done, is an expectation of a
//! scenario, beside its requirement. Nothing passes by silence: what no scenario has exercised is not passed, and says why.
//!
//! What is examined in simulated time is a [`Stack`]: it is asked for the frames of a step of 10 ms, whatever is behind it. In real
//! time it is any program on a bus of SocketCAN ([`exam_live`]).

#![forbid(unsafe_code)]

mod catalogue;
mod disturbance;
mod exam;
mod expectation;
mod expectations;
mod length;
mod live;
mod look;
mod program;
mod program_error;
mod scenario;
mod scenarios;
mod serve;
mod session;
mod stack;
mod tally;

pub use disturbance::{Disturbance, What};
pub use exam::{
    ExamFinding, ExamOptions, ExamProgress, ExamReport, Examined, FoundBy, Outcome, ScenarioOutcome, exam,
};
pub use expectation::{Condition, Expectation, Kind, Within};
pub use length::{BESIDE, estimate};
pub use live::{
    LiveBus, LiveError, LiveOptions, LiveProgram, LiveProgress, LiveReport, exam_live, prepare_namespaces,
};
pub use look::Look;
pub use program::{MAX_FRAMES, StdioStack};
pub use program_error::{StackError, StackErrorKind, StackErrorPlace};
pub use scenario::ExamScenario;
pub use scenarios::scenarios;
pub use serve::serve;
pub use session::{Change, Sent};
pub use stack::{Reference, Stack};

/// The examples of the README.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct Readme;
