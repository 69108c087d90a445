//! A difference as text: a group of aligned lines for each thing that differs.

use std::fmt::Write as _;

use super::difference::Difference;
use super::sections::{self, Group, Line};
use crate::layout::wrapped;
use crate::report::style::{BAD, GOOD, HEADING, Styled};

/// A subject that is longer gets a line of its own.
const LONGEST_SUBJECT: usize = 42;

/// The text, in lines of at most so many columns, with styles.
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

fn write_group(text: &mut String, group: &Group, width: usize) {
    let mut indent = 2;
    if !group.title.is_empty() {
        let _ = writeln!(text, "  {}", group.title);
        indent = 4;
    }
    if !group.about.is_empty() {
        wrapped(text, group.about.split(' '), indent, width);
    }
    let widest = |column: fn(&Line) -> &str| {
        let lengths = group.lines.iter().map(|line| column(line).chars().count());
        lengths.filter(|length| *length <= LONGEST_SUBJECT).max().unwrap_or_default()
    };
    let columns = [widest(|line| &line.subject), widest(|line| &line.property)];
    for line in &group.lines {
        write_line(text, line, indent, columns, width);
    }
}

fn write_line(text: &mut String, line: &Line, indent: usize, columns: [usize; 2], width: usize) {
    let mut start = " ".repeat(indent);
    let [subject, property] = columns;
    if line.subject.chars().count() > LONGEST_SUBJECT {
        wrapped(text, line.subject.split(' '), indent, width);
        column(&mut start, "", subject);
    } else {
        column(&mut start, &line.subject, subject);
    }
    column(&mut start, &line.property, property);

    let (word, style, words) = match (line.from.as_str(), line.to.as_str()) {
        ("", to) => ("new ", GOOD, to.to_owned()),
        (from, "") => ("gone ", BAD, from.to_owned()),
        (from, to) => ("", HEADING, format!("{from} -> {to}")),
    };
    let mut body = String::new();
    wrapped(&mut body, format!("{word}{words}").split(' '), start.chars().count(), width);
    // The first line begins with the columns, in place of the white space.
    let body = body.trim_start().strip_prefix(word).unwrap_or_default();
    text.push_str(&start);
    if !word.is_empty() {
        let _ = write!(text, "{} ", Styled(style, word.trim_end()));
    }
    text.push_str(body);
}

/// Writes a column and the space behind it; none where no line has anything in it.
fn column(line: &mut String, words: &str, width: usize) {
    if width > 0 {
        let _ = write!(line, "{words:width$}  ");
    }
}
