//! The executable specification of the ADS-DV AI/VCU interface as a C library.
//!
//! `include/adsdv.h`, which is made from this crate, is the documentation for C; `README.md` shows how to build and
//! link it. All names are C's own.
//!
//! ```text
//! C structs of plain integers --inputs.rs, control.rs--> the specification's types, or an error that names the field
//!                                                               |
//!                                                        Machine::step, the codec, the judge
//!                                                               |
//! C structs of plain integers <--outputs.rs, signal.rs----------+
//! ```
//!
//! All `unsafe` code of the project is in this crate, and nearly all of that in `border.rs`, which says what is
//! asked of a caller. No panic crosses the border, and only the judge and the recogniser allocate.

#![cfg_attr(not(feature = "std"), no_std)]
#![deny(unsafe_op_in_unsafe_fn, clippy::undocumented_unsafe_blocks)]
#![allow(non_camel_case_types, reason = "the names are C's")]
#![allow(
    clippy::missing_safety_doc,
    reason = "the rules are the same for all functions: see border.rs and the header"
)]
#![expect(
    clippy::inline_always,
    reason = "measured: half of a step's time, which structs handed through memory cost"
)]

mod allowed;
mod border;
mod constants;
mod control;
mod edition;
mod error;
mod frame;
mod inputs;
#[cfg(feature = "judge")]
mod judge;
mod limits;
mod machine;
mod names;
mod outputs;
mod plain;
#[cfg(feature = "judge")]
mod recognise;
#[cfg(feature = "judge")]
mod rules;
mod signal;
mod step;
mod steps;
mod text;
#[cfg(feature = "judge")]
mod texts;
mod version;

pub use constants::*;
pub use control::*;
pub use edition::*;
pub use error::*;
pub use frame::*;
pub use inputs::*;
#[cfg(feature = "judge")]
pub use judge::*;
pub use machine::*;
pub use names::*;
pub use outputs::*;
#[cfg(feature = "judge")]
pub use recognise::*;
#[cfg(feature = "judge")]
pub use rules::*;
pub use signal::*;
pub use step::*;
pub use steps::*;
pub use version::*;

/// A program without the standard library and without a handler of its own stops where a panic would be. No code of
/// this crate or of the specification is known to panic.
#[cfg(all(feature = "panic-handler", not(feature = "std"), not(test)))]
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {
        core::hint::spin_loop();
    }
}
