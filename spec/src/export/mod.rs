//! The tables, printed: for the tools of a CAN bus, and for people.
//!
//! Nothing is said here that is not in a table. Each export is a [`Display`](core::fmt::Display) adapter over
//! one, so it needs no allocation, and `to_string` or `write!` decides where the text goes:
//!
//! | export | of | format |
//! |---|---|---|
//! | [`Dbc`] | [`Bus::messages`](crate::Bus::messages) | CAN database (DBC) |
//! | [`Figure2`] | [`table`](crate::table) | Markdown table |
//! | [`Mermaid`] | [`table`](crate::table) | Mermaid `stateDiagram-v2` |
//! | [`Dot`] | [`table`](crate::table) | Graphviz digraph |
//!
//! The last three print Figure 2 as a [`Machine`](crate::Machine) reads it: with the terms that its
//! [`Readings`](crate::Readings) have and no others, an arrow being left out when it has no term at all. Where an
//! alternative of a guard comes from another section than its arrow does, that section stands behind it.
//!
//! A [`Drawing`] draws the state machine of somebody else in the same way, with what differs marked; as [`AsSvg`] it needs no other
//! tool. Where its boxes stand and how its arrows run ([`place`], [`Line`]), and what colours the lights have ([`Paint`]), holds
//! for the pages as well.
//!
//! ```
//! use adsdv_spec::export::{Dbc, Figure2, Mermaid};
//! use adsdv_spec::{Choice, Edition, Machine, Readings};
//!
//! let dbc = Dbc(&Edition::V3_0).to_string();
//! assert!(dbc.contains("\nBO_ 1312 VCU2AI_Status: 8 VCU\n"));
//!
//! let table = Figure2(&Machine::REFERENCE).to_string();
//! assert!(table.contains("| AS_READY | AS_OFF | 3.6 | AS master switch OFF |\n"));
//! assert!(table.contains("or AI_COMMS_LOST (2.4)"));
//!
//! let figure_alone = Machine::new(Edition::V3_0, Readings::DEFAULT.with(Choice::CommsNoArrow));
//! assert!(!Mermaid(&figure_alone).to_string().contains("AI_COMMS_LOST"));
//! ```

mod arrows;
mod dbc;
mod dot;
mod drawing;
mod escape;
mod light;
mod mark;
mod markdown;
mod mermaid;
mod places;
mod svg;

pub use dbc::Dbc;
pub use dot::Dot;
pub use drawing::{AsDot, AsMermaid, Drawing, DrawnArrow};
pub use light::{Background, Paint};
pub use mark::Mark;
pub use markdown::Figure2;
pub use mermaid::Mermaid;
pub use places::{BOX, Line, Point, SIZE, place};
pub use svg::AsSvg;
