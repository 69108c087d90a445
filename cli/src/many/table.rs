//! What came of all logs, for a person: a line for each, and the report of the worst.

use std::fmt::{self, Write as _};

use super::row::{Row, Rows};
use crate::layout::Seconds;
use crate::report::style::{self, Styled};
use crate::status::Status;

/// So many lines of logs that conform are printed; of more there is their number.
const CONFORMING: usize = 20;

/// The text, with ANSI styles.
pub(super) fn text(rows: &Rows, width: usize) -> String {
    let mut text = String::new();
    // Writing to a string does not fail.
    let _ = write(&mut text, rows, width);
    text
}

fn write(out: &mut String, rows: &Rows, width: usize) -> fmt::Result {
    writeln!(out, "{}", Styled(style::HEADING, rows.counts()))?;
    if rows.no_logs > 0 {
        writeln!(out, "{}", rows.passed_over())?;
    }
    writeln!(out, "\nverdict     violations  warnings   duration  log")?;
    let (mut shown, mut more) = (0, 0);
    for row in rows.worst_first() {
        if row.status == Status::Conforms {
            shown += 1;
            if shown > CONFORMING {
                more += 1;
                continue;
            }
        }
        line(out, row, width)?;
    }
    if more > 0 {
        writeln!(out, "and {more} more that conform")?;
    }
    if let Some(report) = rows.report_of_worst() {
        writeln!(out, "\n{}\n{report}", Styled(style::HEADING, "THE WORST"))?;
    }
    Ok(())
}

fn line(out: &mut String, row: &Row, width: usize) -> fmt::Result {
    let style = if row.status == Status::Conforms { style::GOOD } else { style::BAD };
    let [violations, warnings, _] = row.counts;
    writeln!(
        out,
        "{}  {violations:>10}  {warnings:>8}  {:>7} s  {}",
        Styled(style, format_args!("{:<10}", row.verdict())),
        Seconds(row.duration_ns),
        row.name
    )?;
    let missing =
        (!row.missing.is_empty()).then(|| format!("required and missing: {}", row.missing.join(", ")));
    for text in row.first.iter().chain(&missing) {
        writeln!(out, "            {}", cut(text, width.saturating_sub(12)))?;
    }
    Ok(())
}

/// A line of at most so many characters.
fn cut(text: &str, width: usize) -> String {
    let line = text.lines().next().unwrap_or_default();
    if line.chars().count() <= width {
        return line.to_owned();
    }
    line.chars().take(width.saturating_sub(3)).chain("...".chars()).collect()
}
