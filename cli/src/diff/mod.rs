//! `adsdv diff`: what one edition of the interface changes of another.
//!
//! ```text
//! two editions ----> Difference (difference) ----> JSON
//!   messages, figure2, numbers,      |
//!   faults, reserved, questions      +---> sections ----> text, or Markdown
//! ```
//!
//! All of it comes from the data of the two editions. What the parts have in common, things that are new, gone or changed and
//! the properties by which they are compared, is in `change`.

mod change;
mod devices;
mod difference;
mod faults;
mod figure2;
mod markdown;
mod messages;
mod numbers;
mod questions;
mod reserved;
mod sections;
#[cfg(test)]
mod tests;
mod text;

use crate::args::DiffArgs;
use crate::error::Error;
use crate::json::{SCHEMA, line};
use crate::output;
use crate::status::Status;
use difference::Difference;
use serde::Serialize;

pub(crate) fn run(args: &DiffArgs) -> Result<Status, Error> {
    let difference = Difference::between(args.from, args.to);
    if args.json {
        output::plain(&line(&DiffJson { schema: SCHEMA, difference: &difference }))?;
    } else if args.markdown {
        output::plain(&markdown::text(&difference))?;
    } else {
        output::styled(&text::text(&difference, output::width()), args.color)?;
    }
    Ok(Status::Conforms)
}

/// Its form is described by `schema/diff.schema.json`.
#[derive(Serialize)]
struct DiffJson<'a> {
    schema: u32,
    #[serde(flatten)]
    difference: &'a Difference,
}
