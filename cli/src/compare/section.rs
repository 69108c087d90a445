//! How each section of a comparison begins, and how it ends where there is more than it shows.

use std::fmt::{self, Write as _};

use crate::report::style::{self, Styled};

/// The heading of a section, unless there is nothing in it.
pub(super) fn heading(out: &mut String, heading: &str, empty: bool) -> fmt::Result {
    if empty { Ok(()) } else { writeln!(out, "\n{}", Styled(style::HEADING, heading)) }
}

/// Says how many there are that were not shown.
pub(super) fn more(out: &mut String, count: usize, shown: usize) -> fmt::Result {
    match count.checked_sub(shown).filter(|more| *more > 0) {
        Some(more) => writeln!(out, "  and {more} more; --json has them"),
        None => Ok(()),
    }
}
