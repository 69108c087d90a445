//! Figure 2 as a Markdown table.

use core::fmt;

use super::arrows::arrows;
use super::escape::Escaped;
use crate::Machine;

/// Displays Figure 2 as a Markdown table: from, to, section, guard.
///
/// Hold it against the figure: a row is an arrow, and the guard reads like the arrow's label, one line for each
/// alternative. The rows of one state stand in the order in which they are evaluated.
///
/// ```
/// use adsdv_spec::{Machine, export::Figure2};
///
/// let table = Figure2(&Machine::REFERENCE).to_string();
/// assert!(table.starts_with("| from | to | section | guard |\n|---|---|---|---|\n| AS_OFF | AS_READY | 3.1 | "));
/// assert_eq!(table.lines().count(), 2 + 9); // Figure 2 has nine arrows
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Figure2<'a>(pub &'a Machine);

impl fmt::Display for Figure2<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("| from | to | section | guard |\n|---|---|---|---|\n")?;
        for arrow in arrows(self.0) {
            let row = arrow.row;
            let (section, guard) = (Escaped(row.section, in_cell), Escaped(arrow.guard(usize::MAX), in_cell));
            writeln!(f, "| {} | {} | {section} | {guard} |", row.from, row.to)?;
        }
        Ok(())
    }
}

/// Underscores stay: inside a word, such as AS_OFF, they are not emphasis.
fn in_cell(character: char) -> Option<&'static str> {
    match character {
        '\n' => Some("<br>"),
        '|' => Some("\\|"),
        '\\' => Some("\\\\"),
        '*' => Some("\\*"),
        '`' => Some("\\`"),
        '<' => Some("&lt;"),
        '&' => Some("&amp;"),
        _ => None,
    }
}
