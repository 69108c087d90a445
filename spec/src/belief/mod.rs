//! What may be so of a VCU that is not seen whole, and the step on it.
//!
//! Who watches a bus sees some conditions, late and between gaps, and nothing of what the VCU remembers. A [`Belief`] is all
//! that its memory may be; [`Machine::react_known`](crate::Machine::react_known) takes it one step on, given what is known of
//! the inputs ([`Glimpse`]) and of the time. It is sound: whatever the VCU's memory was of what the belief allows, whatever it
//! saw of what the glimpse allows, and whatever time of the range has passed, what it remembers then is of what the new belief
//! allows. So where a bus shows something that no belief allows, the VCU is not the specification.
//!
//! ```text
//! Belief  --- for each AS state that may be: Memory
//! Memory  --- each timer a Span, each memory a Truth, Handshakes, Causes
//! Glimpse --- Knowledge of the atoms, KnownFaults
//! ```
//!
//! The step is made of the same factors as [`Machine::react`](crate::Machine::react), each with a twin here: timers
//! ([`Span::counted_up`]), the handshake ([`Handshakes::step`]), the conditions that memory decides, the first arrow, and what is
//! remembered afterwards. `adsdv_proofs::belief` proves each twin sound by itself, and says why that is enough for the whole.

mod causes;
mod glimpse;
mod handshakes;
mod known_faults;
mod memory;
mod outcomes;
mod react;
mod span;

pub use causes::Causes;
pub use glimpse::Glimpse;
pub use handshakes::Handshakes;
pub use known_faults::KnownFaults;
pub use memory::{Belief, Memory};
pub use outcomes::{Look, Outcome, Outcomes};
pub use react::{Now, Outlook, Possible};
pub use span::Span;
