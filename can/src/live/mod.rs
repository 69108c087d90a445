//! The car and the AI Computer on a bus, in real time.
//!
//! ```text
//! Handle (a thread) --> Vcu, AiComputer: one turn() a cycle --> Line: bus, clock, what happened
//!   status() <------------- Status <----------------------------'
//! ```
//!
//! A turn receives frames until the cycle is due, lets the operator act, makes the step and sends its frames. What goes wrong on
//! the bus is reported and never ends a turn: a car does not stop being a car because a plug was pulled.
//!
//! Any [`Bus`](crate::bus::Bus) will do, and the time is the bus's: tests run on one on which everything goes wrong, in no time.

mod ai;
mod handle;
mod line;
mod note;
mod partner;
mod traffic;
mod vcu;
mod watch;

pub use ai::AiComputer;
pub use handle::{Handle, Panicked, Runner};
pub use traffic::{Outage, Traffic};
pub use vcu::Vcu;
pub use watch::Watch;
