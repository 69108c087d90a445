//! A difference as Markdown: a table for each section, as GitHub renders it.

use std::fmt::Write as _;

use super::difference::Difference;
use super::sections::{self, Group, Line, Section};
use crate::markdown::escaped;

/// Where there is nothing.
const NOTHING: &str = "-";

/// The text.
pub(super) fn text(difference: &Difference) -> String {
    let mut text = format!("# Edition {} to edition {}\n", difference.from, difference.to);
    if !difference.differs {
        text.push_str("\nNothing differs.\n");
    }
    for section in sections::of(difference) {
        // Writing to a string does not fail.
        let _ = write!(text, "\n## {}\n\n", in_a_sentence(section.title));
        write_table(&mut text, &section, [difference.from, difference.to]);
    }
    text
}

/// `RESERVED IDENTIFIERS` as `Reserved identifiers`.
fn in_a_sentence(title: &str) -> String {
    let (first, rest) = title.split_at_checked(1).unwrap_or((title, ""));
    format!("{first}{}", rest.to_lowercase())
}

/// What a column has for a line.
type Cell = fn(&Group, &Line) -> String;

/// A column that no line has anything in is left out.
fn write_table(text: &mut String, section: &Section, versions: [&str; 2]) {
    let lines = || section.groups.iter().flat_map(|group| group.lines.iter().map(move |line| (group, line)));
    let [thing, part] = section.kinds;
    let columns: [(&str, Cell); 5] = [
        (thing, |group, _| about(group)),
        (part, |_, line| line.subject.clone()),
        ("property", |_, line| line.property.clone()),
        (versions[0], |_, line| or_nothing(&line.from)),
        (versions[1], |_, line| or_nothing(&line.to)),
    ];
    let used = columns.iter().filter(|(_, cell)| lines().any(|(group, line)| !cell(group, line).is_empty()));
    let used: Vec<_> = used.collect();
    let heads = used.iter().map(|(head, _)| (*head).to_owned());
    write_row(text, heads);
    write_row(text, used.iter().map(|_| "---".to_owned()));
    for (group, line) in lines() {
        write_row(text, used.iter().map(|(_, cell)| cell(group, line)));
    }
}

fn write_row(text: &mut String, cells: impl Iterator<Item = String>) {
    for cell in cells {
        let _ = write!(text, "| {} ", escaped(&cell));
    }
    text.push_str("|\n");
}

fn about(group: &Group) -> String {
    if group.about.is_empty() { group.title.clone() } else { format!("{}: {}", group.title, group.about) }
}

fn or_nothing(words: &str) -> String {
    if words.is_empty() { NOTHING } else { words }.to_owned()
}
