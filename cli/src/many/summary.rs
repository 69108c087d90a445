//! What came of logs as Markdown, for the summary page of a CI run.

use std::fmt::{self, Write as _};

use super::row::Rows;
use crate::layout::Seconds;
use crate::markdown::{escaped, escaped_html};

/// The text.
pub(super) fn text(rows: &Rows) -> String {
    let mut text = String::new();
    // Writing to a string does not fail.
    let _ = write(&mut text, rows);
    text
}

fn write(out: &mut String, rows: &Rows) -> fmt::Result {
    writeln!(out, "## adsdv check: {}\n", rows.counts())?;
    writeln!(out, "| verdict | violations | warnings | duration | edition | log |")?;
    writeln!(out, "| --- | ---: | ---: | ---: | --- | --- |")?;
    let worst_first = rows.worst_first();
    for row in &worst_first {
        let [violations, warnings, _] = row.counts;
        writeln!(
            out,
            "| {} | {violations} | {warnings} | {} s | {} | {} |",
            row.verdict(),
            Seconds(row.duration_ns),
            row.edition,
            escaped(&row.name)
        )?;
    }
    for row in worst_first {
        if row.rules.is_empty() && row.missing.is_empty() && row.first.is_none() {
            continue;
        }
        writeln!(out, "\n<details><summary>{}: {}</summary>\n", escaped_html(&row.name), row.verdict())?;
        if let Some(first) = row.first.as_ref().filter(|_| row.rules.is_empty()) {
            writeln!(out, "- {}", escaped(first))?;
        }
        for (rule, of) in &row.rules {
            writeln!(out, "- {rule}: {} violations, {} warnings", of.violations, of.warnings)?;
            of.words.iter().try_for_each(|words| writeln!(out, "  - {}", escaped(words)))?;
        }
        row.missing.iter().try_for_each(|one| writeln!(out, "- required and missing: {}", escaped(one)))?;
        writeln!(out, "\n</details>")?;
    }
    Ok(())
}
