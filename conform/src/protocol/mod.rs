//! The protocol in which a program under test is asked for its steps: one JSON object a line, each way.
//!
//! `PROTOCOL.md`, beside this crate's sources, is the page for the author of such a program. What can be said stands
//! here as two tables: the inputs of a step ([`INPUTS`]) and what it shows ([`SHOWN`]), each a list of fields with its
//! key, what its values are, and how it is got from the specification's own types. The values of an edition are in its
//! [`Protocol`], and the first line of a conversation says which edition it is about ([`Request::Hello`]).
//!
//! ```
//! use adsdv_conform::protocol::{Answer, Request, Shown};
//! use adsdv_spec::{Control, Inputs, Machine};
//!
//! let inputs = Inputs { asms: true, ..Inputs::default() };
//! let line = Request::Step { dt_ms: 10, inputs }.to_string();
//! assert_eq!(line, r#"{"op":"step","dt_ms":10,"asms":true}"#);
//! let Ok(Request::Step { dt_ms, inputs }) = line.parse() else { panic!("a step") };
//!
//! let (_, outputs) = Machine::REFERENCE.step(&Control::INITIAL, &inputs, dt_ms);
//! let shown = Shown::of(Machine::REFERENCE.edition(), &outputs, &inputs);
//! assert!(shown.to_string().starts_with(r#"{"as_state":"AS_OFF","handshake":false,"#));
//!
//! let answer: Answer = r#"{"as_state":"AS_READY"}"#.parse()?;
//! assert_eq!(answer.differences(&shown).next().unwrap().to_string(), "as_state is AS_READY; expected AS_OFF");
//! # Ok::<(), adsdv_conform::protocol::BadLine>(())
//! ```

mod about;
mod answer;
mod bad_line;
mod field;
mod foreign;
mod inputs;
mod request;
mod shown;
mod spoken;
mod unsaid;
mod values;

pub use about::About;
pub use answer::{Answer, Difference};
pub use bad_line::BadLine;
pub use field::{Domain, Value};
pub use inputs::{INPUTS, InputField};
pub use request::{InputsAsJson, Request};
pub use shown::{SHOWN, Showing, Shown, ShownField, ShownValues};
pub use spoken::Protocol;
pub use unsaid::UNSAID;
pub use values::Values;
