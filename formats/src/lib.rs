//! Recordings of CAN traffic as tools write them, for a program that wants frames: recognised by their content, read in one pass and in memory
//! that does not grow with them.
//!
//! ```text
//! source --> unpack --> Format::of --> a reader of that format --> Entries: frames, losses, and what could not be read
//!            gzip, zstd, UTF-16        candump: adsdv_oracle::candump; all others: a module of that name here
//!                                      (MCAP with the feature `mcap`)
//! ```
//!
//! [`open`] does all of it, [`find`] says which files there are, and [`each`] works on many at once. What a reader hands out is what that of candump hands out, an [`Entry`] after the other: what cannot be read costs
//! itself and nothing else, has its place, and is counted.
//!
//! ```
//! use std::io::Cursor;
//!
//! use adsdv_formats::{Format, open};
//! use adsdv_oracle::log::{LogOptions, judge_entries};
//!
//! let log = open(Cursor::new("(1.000000) can0 520#0000010000000000\n"))?;
//! assert_eq!(log.format(), Format::Candump);
//! let (report, _) = judge_entries(log, &LogOptions::default(), |_| {})?;
//! assert_eq!(report.frames, 1);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod ahead;
mod asc;
mod blf;
mod bytes;
mod csv;
mod foreign;
mod format;
mod head;
mod lines;
mod log;
mod many;
#[cfg(feature = "mcap")]
mod mcap;
mod open_error;
mod savvycan;
mod text;
mod trc;
mod unpack;
mod utf16;
mod watch;

pub use adsdv_oracle::candump::{Entries, Entry};
pub use foreign::Foreign;
pub use format::Format;
pub use log::{Log, open, open_watched};
pub use many::{FindError, Found, Step, each, find, is_several};
pub use open_error::OpenError;

/// Where bytes come from, once they are unpacked.
pub(crate) type Source = Box<dyn std::io::Read + Send>;
