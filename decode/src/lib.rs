//! Recordings of the ADS-DV's CAN bus as signals: what was on the bus, with units and the names of values, in the formats that people's
//! tools read.
//!
//! ```text
//! adsdv_formats::open --> Recording::begin: which edition? --> Recording::decode --> a Sink
//!                         (as the judge recognises it)          |                    Text, Csv, JsonLines, VcdFile,
//!                                                               |                    mcap, parquet (each a feature)
//!                                                            Catalog
//!                                   the edition's own tables, and databases (DBC) of the user's own
//! ```
//!
//! A [`Catalog`] has every message that is known. Those of the document come from the tables of `adsdv-spec`, which are read and not
//! repeated, so that a further edition is decoded without a line here. A [`Database`] adds a team's own messages: extended identifiers,
//! multiplexers, both byte orders, floats. Where both have an identifier, the document's counts, and a note says so. What is decoded by a
//! database of the user's own is shown, and never judged.
//!
//! A [`Recording`] hands frame after frame to a [`Sink`], in memory that does not grow with the recording. Nothing readable is lost: a
//! frame that nothing knows goes out as bytes, one that is too short with the signals that it has, and what could not be read is
//! counted in the [`Summary`].
//!
//! ```
//! use adsdv_decode::{Catalog, Options, Recording, Text, TextLayout};
//! use adsdv_formats::open;
//!
//! let log = "(1.000000) can0 521#000000000000\n(1.010000) can0 523#00001B000000\n(1.020000) can0 7FF#01\n";
//! let recording = Recording::begin(open(log.as_bytes())?, &Options::default())?;
//! let catalog = Catalog::of(recording.recognised().edition);
//!
//! let mut text = Vec::new();
//! let mut sink = Text::new(&catalog, &mut text, TextLayout::SingleLine, false);
//! let summary = recording.decode(&catalog, &mut sink, |_| {})?;
//! drop(sink);
//!
//! assert_eq!((summary.frames, summary.unknown), (3, 1));
//! let text = String::from_utf8(text)?;
//! let steer = "VCU2AI_Steer(ANGLE: 0.0 deg, ANGLE_MAX: 2.7 deg, ANGLE_REQUEST: 0.0 deg)";
//! assert_eq!(text.lines().nth(1), Some(&*format!("(0000000001.010000) can0 523#00001B000000 :: {steer}")));
//! assert_eq!(text.lines().last(), Some("(0000000001.020000) can0 7FF#01 :: Unknown frame id 2047 (0x7ff)"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#![forbid(unsafe_code)]

mod arrows;
mod bus;
mod catalog;
mod csv;
mod dbc;
mod edition;
mod jsonl;
mod kept;
mod line;
mod mcap;
mod message;
mod not_built;
mod out;
mod parquet;
mod place;
mod recording;
mod signal;
mod sink;
mod text;
mod value;
mod vcd;
mod watch;

pub use catalog::Catalog;
pub use csv::Csv;
pub use dbc::{Database, DbcError, MAX_DBC};
pub use jsonl::JsonLines;
pub use mcap::{mcap, mcap_layout};
pub use message::{Message, Origin, Reading};
pub use not_built::NotBuilt;
pub use parquet::{Table, parquet, parquet_messages};
pub use place::{Coding, Order, Place};
pub use recording::{DecodeError, Options, Recording, Summary};
pub use signal::{Multiplexed, Scaling, Signal};
pub use sink::{BeginError, Frame, Sink, SinkError};
pub use text::{Text, TextLayout};
pub use value::Value;
pub use vcd::VcdFile;
