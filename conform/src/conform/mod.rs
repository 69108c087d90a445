//! Whether a program under test does what the document says, where it does not, and how it reads the document.
//!
//! ```text
//! suite ---+                        +--> Explain: which combinations of readings explain the answers
//!          +--> Vcu: asks a program-+
//! random --+         and is answered    none explains them: Break, the row of Figure 2, and a shorter scenario
//! ```
//!
//! - `program.rs`: the program, a child process (`child.rs`), whose every misconduct ends in a [`ProgramError`] (`program_error.rs`), never in
//!   waiting for ever; `line_program.rs` is what it shares with every program that speaks in lines, to which `questions.rs` writes
//!   and of which `lines.rs` reads the lines and `stderr.rs` the last words; `running.rs` is a program that nobody asks anything,
//!   and `marked.rs` finds what it started, wherever that went;
//! - `vcu.rs`: what is asked, be it that program or a machine in this process;
//! - `explain.rs`: answers against the specification under every combination of readings at once, `set.rs` being sets of
//!   such combinations;
//! - `verdict.rs`: which combination the answers follow, or mix;
//! - `own_bit.rs`: the handshake for a program whose bit is not the specification's;
//! - `cycle.rs`: scenarios for a program that steps at a fixed cycle;
//! - `wall_clock.rs`: the tests for a program that runs on a clock on the wall;
//! - `walker.rs`: scenarios that lead everywhere, `rng.rs` the chance in them;
//! - `shrink.rs`: the shortest scenario that fails in the same way;
//! - `broken.rs`: the row of Figure 2 behind a wrong answer;
//! - `blame.rs`: the requirements that wrong answers break, `about.rs` what a requirement is about, and `keys.rs` sets of
//!   outputs;
//! - `requirements.rs`: what was passed, failed and not checked;
//! - `judging.rs`: all of it in order, each part of it on the `Run` of `run.rs`: first `suite.rs`, the tests, then `failures.rs`, what is
//!   wrong in them, then `random.rs`, the random scenarios; `options.rs` says how, and `report.rs` what came of it.

mod about;
mod blame;
mod broken;
mod child;
mod chunks;
mod cycle;
mod explain;
mod failures;
mod judging;
mod keys;
mod line_program;
mod lines;
mod marked;
mod options;
mod own_bit;
mod program;
mod program_error;
mod questions;
mod random;
mod report;
mod requirements;
mod rng;
mod run;
mod running;
mod set;
mod shrink;
mod stderr;
mod suite;
mod vcu;
mod verdict;
mod walker;
mod wall_clock;

pub use broken::{Break, Row, Why};
#[cfg(unix)]
pub use child::{Stopped, stop_programs};
pub use judging::{NOT_ALIKE, conform};
pub use line_program::LineProgram;
pub use lines::{LineBuffer, TooLong};
pub use options::{ConformOptions, ConformProgress, Phase};
pub use program::Program;
pub use program_error::{ProgramError, ProgramErrorKind, SentLine, Work, excerpt};
pub use report::{ConformReport, Failure, Stretch};
pub use requirements::{Outcome, Requirement};
pub use running::RunningProgram;
pub use vcu::{InProcess, Reply, Vcu};
pub use verdict::{Follows, Side};
