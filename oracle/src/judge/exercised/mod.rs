//! What the recording exercised: which requirements it could show, and what it tells of each.
//!
//! `cited.rs` lists the requirements that a log can show, from what cites them: the rows and alternatives of Figure 2, the faults,
//! the handshake, and what reaches the actuators. `tally.rs` marks them while the bus goes on, and `notice.rs` is where the judge
//! tells it what it has seen. `standing.rs` is what comes of it, and `required.rs` what somebody wants a recording to show.
//!
//! The requirements of an arrow count when the arrow was seen, those of a fault when its flag was, those of the handshake when an
//! edge was answered or lost. One arrow that is right says that its requirements held, whatever else is not certain; one that is
//! wrong says that they were violated. What reaches the actuators no message shows, so that it is never certain.

pub(super) mod cited;
mod notice;
mod required;
mod standing;
mod tally;

pub(super) use cited::{
    ANSWERS, BEGINS, FINISHES_AT_REST, HOLDS, MISSED, ONLY_ARROWS, UNANSWERED, of_edition,
};
pub(super) use notice::broken_by;
pub use required::{Required, RequiredError};
pub use standing::{Exercised, Lack, RequirementStanding, Standing};
pub(super) use tally::Tally;
