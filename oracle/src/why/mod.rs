//! Why the VCU stayed: of every state that a bus shows, the arrows that were not taken, and what blocked each, over time.
//!
//! ```text
//! the judge: state, what is known --> Why --> Stay: from when to when
//!                                              Untaken: an arrow of the state
//!                                                Blocked: from when to when, which conditions failed
//! ```
//!
//! A verdict counts nothing that is not certain. An explanation may go by what was shown last: a frame that is a little late says
//! nothing else in all likelihood. So a condition stays here as it was shown for half a second, and the verdict is not touched by
//! what this says.

mod arrows;
mod blocked;
mod go;
mod mover;
mod shown;
mod stays;

pub use blocked::{Blocked, Condition, Stay, Untaken};
pub use go::GoPress;
pub use mover::{Mover, Place, next_of_mission, place_of};

pub(crate) use shown::EDGES;
pub(crate) use stays::StayRecorder;
