//! The judge of a log: holds both sides of a recorded run against the specification.
//!
//! A log is sampled, jittered, and silent about the shutdown circuit, but for the remote E-stop where that is on the bus. So the
//! judge reasons with three-valued truth: what every sample of a window agrees on is known, the rest is unknown, and no guess is
//! reported as a fact. A violation is what is one whatever the unknown is, under every reading of the document that is not excluded.
//!
//! ```text
//! frame --> Sampler (what each message last said, how fresh that is, and what the recording may have lost)
//!             |
//!             v
//!           Estimator (what may be so of the VCU: what is known of every condition, now and in the window that counts)
//!             |
//!             v
//!           Rules (each looks at the estimator only) --> Book (findings, transitions, margins, what was exercised)
//! ```
//!
//! No rule knows how recorders behave, and the sampler knows no state machine. `judge.rs` is the walk of a frame through all three;
//! files depend on those before them only. Beside the rules of the document, `own.rs` follows [those of the user's own](crate::rules);
//! `senders.rs` tells when there is no one VCU to judge.
//!
//! Everything is online and in bounded memory: one frame after the other, as they come.
//!
//! ```
//! use adsdv_oracle::judge::{Judge, JudgeOptions, Verdict};
//! use adsdv_spec::{Control, Inputs, Machine};
//!
//! let mut judge = Judge::new(JudgeOptions::default());
//! let vcu = Machine::REFERENCE;
//! let (mut control, inputs) = (Control::INITIAL, Inputs::default());
//! for cycle in 0..100 {
//!     let (next, outputs) = vcu.step(&control, &inputs, 10);
//!     control = next;
//!     for frame in outputs.messages(&inputs).frames(&vcu.edition().bus) {
//!         judge.frame(cycle * 10_000_000, frame.id.into(), frame.data());
//!     }
//! }
//! assert_eq!(judge.finish().verdict(), Verdict::Conforms);
//! ```

mod book;
mod decided;
mod estimator;
mod evidence;
mod exercised;
mod finding;
#[expect(clippy::module_inception, reason = "it is what the folder is about")]
mod judge;
mod margins;
mod options;
mod output;
mod own;
mod report;
mod response;
mod rules;
mod sampler;
mod senders;
mod time;

pub use decided::Decided;
pub use exercised::{Exercised, Lack, Required, RequiredError, RequirementStanding, Standing};
pub use finding::{Evidence, Finding, Party, Rule, Section, Severity};
pub use judge::Judge;
pub use margins::{Basis, Margin, Measure, Needs};
pub use options::JudgeOptions;
pub use report::{Report, Transition, Verdict};
pub use response::{Meter, ResponseTimes};
pub use time::SILENCE_NS;
