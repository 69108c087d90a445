//! The messages, byte by byte (sections 2.1 to 2.3).
//!
//! For each message there is one theorem, about any data of any length. It cuts the signals out of the bytes by hand, as
//! the CAN database has them, and says which values the document allows, in numbers. Then the message is read if and
//! only if all of it is there and allowed, with exactly these values; and what was read is written as the same bits. Any
//! message at all is written so that it is read as itself.
//!
//! - [`ai`]: what the AI Computer sends, 510h to 514h;
//! - [`vcu`]: what the VCU sends, 520h to 526h;
//! - [`log`]: what both send for the data logger, 500h to 502h;
//! - [`v4_0`]: the messages and identifiers of version 4.0; those that name no version are about 3.0;
//! - [`v2026`]: what the CAN database of 2026 has otherwise than version 4.0;
//! - [`devices`]: the messages of the devices in that database;
//! - [`any`]: frames of which it is not known what they are;
//! - [`table`]: the table of all signals, and the lenient reading that goes by it;
//! - [`quantities`]: numbers that have a range;
//! - [`reserved`]: the identifiers that are not the AI Computer's.
//!
//! `data.rs` draws data, reads it and writes it again; `names.rs` has the numbers that stand for a name.
//!
//! That nothing panics, overflows or reads out of bounds, whatever the identifier, the length and the bytes are, is in
//! all of these: Kani checks it in every line that a harness reaches.

pub mod ai;
pub mod any;
mod data;
pub mod devices;
pub mod log;
mod names;
pub mod quantities;
pub mod reserved;
pub mod table;
pub mod v2026;
pub mod v4_0;
pub mod vcu;
