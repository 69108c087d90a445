//! The specification's state machine, explored to its end.
//!
//! The model is no second description: every step is one of [`adsdv_spec::Machine`]. There are two of them.
//!
//! - [`Open`]: any AI Computer, any driver, any fault. Its states are the control states of the VCU, with the real times of
//!   the document; at every cycle every input vector is tried. [`explore`] goes to its end and decides every property;
//!   [`verify`] adds the shortest runs that show what it decided; [`sweep`] does so for every combination of readings.
//! - [`closed::Closed`]: the VCU with an AI Computer that follows the document, over real CAN frames, an operator, a fault and
//!   the vehicle, each acting one change at a time. It says what a team may rely on, and it is what people walk through in
//!   the Explorer ([`serve`]).
//!
//! # Where things are
//!
//! | to read about | look in |
//! |---|---|
//! | the properties, as data | [`PROPERTIES`], [`goals`](goals()), [`closed::CLOSED_PROPERTIES`] |
//! | which inputs are tried, and by which lemmas fewer would do | [`Vectors`] |
//! | the open model as stateright sees it | [`Open`] |
//! | which parts of the table decide a step | [`Part`] |
//! | a path as a vehicle's run: raw inputs, frames on the bus | [`Run`] |
//! | a path in words | [`story()`] |
//! | the same state machine for Spin | [`Promela`] |
//!
//! `README.md`, beside this crate's sources, lists the lemmas; `READINGS.md` says what each reading of the document costs.
//!
//! # One exploration
//!
//! ```
//! use adsdv_model::{Options, Vectors, explore};
//! use adsdv_spec::Machine;
//!
//! let quickly = Options { vectors: Vectors::Few, ..Options::default() };
//! let exploration = explore(Machine::REFERENCE, quickly, |_| {});
//! assert!(exploration.complete && exploration.broken.is_empty());
//! ```

#![forbid(unsafe_code)]

mod action;
pub mod closed;
mod cycle;
mod document;
mod exploration;
mod explore;
mod goals;
mod in_edition;
mod listed;
mod look;
mod moot;
mod open;
mod parts;
mod planes;
mod promela;
mod properties;
mod property;
mod ranking;
mod reachable;
mod readings_text;
mod run;
mod search;
mod short_timers;
mod step;
mod steps;
mod story;
mod sweep;
mod vectors;
mod verify;

pub use action::Action;
pub use closed::Closed;
pub use document::{have_the_same_state_machine, state_machines};
pub use exploration::{Exploration, Options, Progress, explore, explore_quietly};
pub use explore::serve;
pub use goals::{Goal, goals};
pub use listed::properties;
pub use look::Engine;
pub use open::{Open, State};
pub use parts::Part;
pub use promela::Promela;
pub use properties::PROPERTIES;
pub use property::{Claim, Harm, Property, When};
pub use ranking::Ranked;
pub use reachable::reachable;
pub use readings_text::READINGS_HEAD;
pub use run::{Cycle, Phase, Run};
pub use short_timers::{SHORT_TIMERS, short_timers};
pub use step::Step;
pub use steps::{Steps, every_one};
pub use story::{StoryLine, story, story_of};
pub use sweep::{ClosedCost, Cost, Sweep, closed_models, sweep, together};
pub use vectors::Vectors;
pub use verify::{Report, verify};
