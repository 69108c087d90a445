//! Holds programs against the specification of the ADS-DV AI/VCU interface: whether a VCU under test does what the document says, where
//! it does not, and how it reads the document.
//!
//! ```text
//! specification --> suite --> conform <--> protocol <--> a program under test
//! ```
//!
//! - [`suite`]: tests, generated from the table;
//! - [`protocol`]: what is said to a program and by it, in lines of JSON;
//! - `conform/`: asks the program, and judges its answers. All that it offers is this crate's.
//!
//! ```
//! use adsdv_conform::{InProcess, ConformOptions, conform};
//! use adsdv_conform::suite;
//! use adsdv_spec::{Choice, Edition, Machine, Readings};
//!
//! // A program that takes a rising edge of "Go" for enough conforms: the document can be read so.
//! let vcu = Machine::new(*Edition::DEFAULT, Readings::DEFAULT.with(Choice::GoEdgeEnough));
//! let tests = suite::generate(Edition::DEFAULT);
//! let report = conform(&mut InProcess(vcu), &tests, &ConformOptions::default(), &mut |_| {})?;
//! assert!(report.conforms() && report.readings.is(Choice::GoEdgeEnough));
//! # Ok::<(), adsdv_conform::ProgramError>(())
//! ```

#![forbid(unsafe_code)]

mod conform;
pub mod protocol;
pub mod suite;

pub use conform::*;
