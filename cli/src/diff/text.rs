//! A difference as text: a group of aligned lines for each thing that differs.

use std::fmt::Write as _;

use super::difference::Difference;
use super::sections::{self, Group, Line};
use crate::layout::wrapped;
use crate::report::style::{BAD, GOOD, HEADING, Styled};

/// Where a subject is longer, the subjects of the group stand on lines of their own.
const LONGEST_SUBJECT: usize = 42;
/// A piece of a list that is longer is broken at its words.
const LONGEST_PIECE: usize = 40;

/// The text, in lines of at most so many columns where words allow it, with styles.
pub(super) fn text(difference: &Difference, width: usize) -> String {
    let mut text = format!("edition {} -> edition {}\n", difference.from, difference.to);
    if !difference.differs {
        text.push_str("\nnothing differs\n");
    }
    for section in sections::of(difference) {
        // Writing to a string does not fail.
        let _ = writeln!(text, "\n{}", Styled(HEADING, section.title));
        for group in &section.groups {
            write_group(&mut text, group, width);
        }
    }
    text
}

/// The lines about the thing itself first, then those about its parts.
fn write_group(text: &mut String, group: &Group, width: usize) {
    let mut indent = 2;
    if !group.title.is_empty() {
        let _ = writeln!(text, "  {}", group.title);
        indent = 4;
    }
    if !group.about.is_empty() {
        wrapped(text, group.about.split(' '), indent, width);
    }
    let (own, parts): (Vec<_>, Vec<_>) = group.lines.iter().partition(|line| line.subject.is_empty());
    write_lines(text, &own, indent, width);
    write_lines(text, &parts, indent, width);
}

/// Lines with aligned columns. A subject is named once.
fn write_lines(text: &mut String, lines: &[&Line], indent: usize, width: usize) {
    let widest = |column: fn(&Line) -> &str| {
        lines.iter().map(|line| column(line).chars().count()).max().unwrap_or_default()
    };
    let (mut subject, property) = (widest(|line| &line.subject), widest(|line| &line.property));
    let stacked = subject > LONGEST_SUBJECT;
    if stacked {
        subject = 0;
    }
    let mut before = "";
    for line in lines {
        let named = if line.subject == before { "" } else { &line.subject };
        before = &line.subject;
        let mut start = " ".repeat(indent);
        if stacked {
            if !named.is_empty() {
                wrapped(text, named.split(' '), indent, width);
            }
            start.push_str("  ");
        }
        column(&mut start, if stacked { "" } else { named }, subject);
        column(&mut start, &line.property, property);
        write_values(text, &start, line, width);
    }
}

/// Writes the start of a line, and behind it what was and what is.
fn write_values(text: &mut String, start: &str, line: &Line, width: usize) {
    let indent = start.chars().count();
    let (word, style, body) = match (line.from.as_str(), line.to.as_str()) {
        ("", to) => ("new:", GOOD, list(&format!("new: {to}"), indent, width)),
        (from, "") => ("gone:", BAD, list(&format!("gone: {from}"), indent, width)),
        (from, to) => {
            let body = list(&format!("{from} -> {to}"), indent, width);
            let two = || list(from, indent, width) + &list(&format!("-> {to}"), indent, width);
            ("", HEADING, if body.lines().count() > 1 { two() } else { body })
        }
    };
    // The body begins with white space in place of the start.
    let body = body.trim_start();
    text.push_str(start);
    match body.strip_prefix(word).filter(|_| !word.is_empty()) {
        Some(rest) => _ = write!(text, "{}{rest}", Styled(style, word)),
        None => text.push_str(body),
    }
}

/// A list in indented lines, broken behind its commas where its pieces are short.
fn list(words: &str, indent: usize, width: usize) -> String {
    let mut lines = String::new();
    let pieces = words.split_inclusive(", ").map(str::trim_end).flat_map(|piece| {
        let whole = piece.chars().count() <= LONGEST_PIECE;
        let at = move |c: char| !whole && c == ' ';
        piece.split(at)
    });
    wrapped(&mut lines, pieces, indent, width);
    lines
}

/// Writes a column and the space behind it; none where no line has anything in it.
fn column(line: &mut String, words: &str, width: usize) {
    if width > 0 {
        let _ = write!(line, "{words:width$}  ");
    }
}
