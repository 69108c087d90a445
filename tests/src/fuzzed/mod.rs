//! What is fuzzed: everything that reads or decides, each as a function of any bytes that panics where something is wrong.
//!
//! A body has no other input than its bytes, so that what a fuzzer finds fails again wherever the same bytes are run: in the
//! fuzzer, in the tests of this crate, which run all of `fuzz/corpus` and `fuzz/regressions`, and in a debugger.
//!
//! | body | what it reads or decides | what that is held against |
//! |---|---|---|
//! | [`codec`] | frames of any edition: any identifier, length and bytes | the table of signals; what is read is written again |
//! | [`step`] | any inputs, one step after the other, under any readings of any edition | the document's words as `if`s; the invariant |
//! | [`belief`] | what may be known of a step, under any readings of any edition | the step itself: allowed, exact where all is known |
//! | [`theorems`] | any theorem of `adsdv-proofs`, on any values | the theorem |
//! | [`candump`] | any bytes as a log | the same log in other pieces; the same log written again |
//! | [`recording`] | any bytes as a recording of any format, compressed or not | the same, byte by byte; what each entry promises |
//! | [`database`] | any bytes as a database (DBC) of a user's own | shorter frames have no more signals; what is decoded by it can be read |
//! | [`judge_any`] | any bytes as a log, any frames at any time | the same frames as a log; what each report promises |
//! | [`judge_reference`] | logs of the reference under any readings of any edition, late and with losses | the VCU is never blamed |
//! | [`protocol`] | any line between `conform` and a program of any edition | the same line written again |
//! | [`suite`] | any bytes as a test suite of each edition | the same tests written again |
//! | [`scenario`] | any bytes as a scenario, and how it is played | the same scenario written again; the order of its lines |
//! | [`conform`] | the answers of a VCU of any edition that lies, and of one that does not | what each report promises; who is right conforms |
//! | [`names`] | any words of a command line, any JSON | the same name; the same value written again |
//! | [`car`] | any frames, switches and times, at the car, the AI Computer and the live judge of any edition | their ranges; what they send can be read |
//!
//! The border to C is the one body that needs `unsafe`, and so it stands in `ffi/tests/c_border`.

// That a body panics where something is wrong is what it is for.
#![allow(clippy::missing_panics_doc)]

pub mod belief;
mod bytes;
pub mod candump;
pub mod car;
pub mod codec;
pub mod conform;
pub mod database;
pub mod judge_any;
pub mod judge_reference;
pub mod names;
pub mod protocol;
pub mod recording;
pub mod replay;
pub mod scenario;
pub mod seeds;
pub mod step;
pub mod suite;
pub mod theorems;

pub use bytes::Bytes;

/// A body, and the name of its fuzzer.
pub type Target = (&'static str, fn(&[u8]));

/// Every body of this crate. `fuzz/Cargo.toml` has a fuzzer of each name.
pub const TARGETS: [Target; 15] = [
    ("belief", belief::body),
    ("candump", candump::body),
    ("car", car::body),
    ("codec", codec::body),
    ("conform", conform::body),
    ("database", database::body),
    ("judge_any", judge_any::body),
    ("judge_reference", judge_reference::body),
    ("names", names::body),
    ("protocol", protocol::body),
    ("recording", recording::body),
    ("scenario", scenario::body),
    ("step", step::body),
    ("suite", suite::body),
    ("theorems", theorems::body),
];
