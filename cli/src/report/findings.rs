//! What was found: violations and warnings in order of time, then the notes, of which there may be many.

use std::fmt::{self, Write as _};

use adsdv_oracle::judge::{Finding, Severity};

use super::INDENT;
use super::style::{self, Styled};
use crate::layout::{Seconds, wrapped};

pub(super) fn write(out: &mut String, findings: &[Finding], width: usize) -> fmt::Result {
    let (notes, serious): (Vec<&Finding>, Vec<&Finding>) =
        findings.iter().partition(|finding| finding.severity == Severity::Note);
    writeln!(out, "\n{}", Styled(style::HEADING, "FINDINGS"))?;
    if serious.is_empty() {
        writeln!(out, "  no violations, no warnings")?;
    }
    for finding in serious {
        write_one(out, finding, 1, width)?;
    }
    if notes.is_empty() {
        return Ok(());
    }
    writeln!(out, "\n{}", Styled(style::HEADING, "NOTES"))?;
    for (note, times) in grouped(&notes) {
        write_one(out, note, times, width)?;
    }
    Ok(())
}

pub(super) fn write_one(out: &mut String, finding: &Finding, times: usize, width: usize) -> fmt::Result {
    let Finding { t_ns, severity, party, section, rule, .. } = finding;
    let style = style::of(*severity);
    write!(
        out,
        "{:>10} s  {:9}  {:3}  {section:<8}  {}",
        Seconds(*t_ns),
        Styled(style, severity.name()),
        party.name(),
        rule.id(),
    )?;
    if times > 1 {
        write!(out, " ({times} times, first here)")?;
    }
    out.push('\n');
    wrapped(out, finding.message().split_whitespace(), INDENT, width);
    Ok(())
}

/// Notes that say the same stand once, where the first of them does.
fn grouped<'a>(notes: &[&'a Finding]) -> Vec<(&'a Finding, usize)> {
    let mut groups: Vec<(&Finding, usize)> = Vec::new();
    for note in notes {
        let same = |other: &Finding| {
            (other.rule, other.party, &other.seen, &other.expected)
                == (note.rule, note.party, &note.seen, &note.expected)
        };
        match groups.iter_mut().find(|(first, _)| same(first)) {
            Some((_, times)) => *times += 1,
            None => groups.push((note, 1)),
        }
    }
    groups
}
