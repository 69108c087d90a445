//! What a reader of the answer has to know, on standard error, so that the answer itself is for a tool.

use std::fmt::Write as _;
use std::io::{self, Write as _};

use adsdv_decode::{Catalog, Summary};
use adsdv_oracle::recognise::Recognised;

use crate::layout::counted;

/// Prints what there is to say; nothing of a log that was decoded by an edition that was certain, and had nothing else.
pub(super) fn print(
    recognised: &Recognised,
    by_log: bool,
    catalog: &Catalog,
    summary: &Summary,
    of_format: &[String],
) {
    let mut text = String::new();
    let mut note = |what: &str| {
        let _ = writeln!(text, "note: {what}");
    };
    if by_log && !(recognised.certain && recognised.against.is_empty()) {
        note(&format!("decoded by {recognised}"));
    }
    catalog.notes().iter().for_each(|what| note(what));
    if let Some(first) = &summary.first_broken {
        note(&format!("{} could not be read; the first: {first}", counted(summary.broken, "line")));
    }
    if summary.dropped > 0 {
        note(&format!("{} lost before they were recorded, the log says", counted(summary.dropped, "frame")));
    }
    if summary.unknown > 0 {
        note(&format!(
            "{} of {}: of no message that is known, or no data frame",
            counted(summary.unknown, "frame"),
            summary.frames
        ));
    }
    for what in of_format {
        note(what);
    }
    // If standard error cannot be written there is nobody to tell; the answer is complete all the same.
    let _ = io::stderr().write_all(text.as_bytes());
}
