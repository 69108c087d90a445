//! The forms for programs: what `adsdv check --json`, `compare --json` and `readings --json` print, and the page shows.
//!
//! ```text
//! Report --> CheckJson (finding, stays, exercised, rules, response) --> line
//! ```
//!
//! The schemas in `cli/schema` describe them. The number of each stands in its first key.

mod check;
mod compare;
mod exercised;
mod finding;
mod number;
mod readings;
mod recognised;
mod response;
mod rules;
mod stays;

use serde::Serialize;

pub use check::CheckJson;
pub use compare::compared;
pub use finding::FindingJson;
pub use number::seconds;
pub use readings::ReadingsJson;
pub use stays::StayJson;

/// The number of the form that every answer in JSON has, which is its first key; `cli/schema/README.md` says when it changes.
pub const SCHEMA: u32 = 1;

/// An answer on one line.
///
/// ```
/// use adsdv_report::json::{ReadingsJson, line};
/// use adsdv_spec::Edition;
///
/// let text = line(&ReadingsJson::new(&Edition::V3_0));
/// assert!(text.starts_with(r#"{"schema":1,"edition":"3.0","readings":["#) && text.ends_with("}\n"));
/// ```
pub fn line(value: &impl Serialize) -> String {
    // Nothing here can fail to be written: all keys are text, and all numbers finite.
    let mut text = serde_json::to_string(value).unwrap_or_default();
    text.push('\n');
    text
}
