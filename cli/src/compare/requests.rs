//! What the AI Computer requested otherwise, in words.

use std::fmt;

use adsdv_oracle::compare::{Range, RangeDiffers, Sequence, SequenceDiffers};
use adsdv_spec::AsState;

use super::section::{heading, more};
use crate::layout::wrapped;

/// So many requests tell enough.
const SHOWN: usize = 8;
/// Where a line goes on.
const INDENT: usize = 19;

pub(super) fn write(
    out: &mut String,
    ranges: &[RangeDiffers],
    sequences: &[SequenceDiffers<'_>],
    width: usize,
) -> fmt::Result {
    heading(out, "REQUESTS", ranges.is_empty() && sequences.is_empty())?;
    let said = sequences.iter().map(|SequenceDiffers { state, again, good, bad }| {
        line(*state, *again, good.signal.name, &values(good), &values(bad))
    });
    let requested = ranges.iter().filter_map(|RangeDiffers { state, again, good, bad }| {
        let name = good.or(*bad)?.signal.name;
        Some(line(*state, *again, name, &[range(good.as_ref())], &[range(bad.as_ref())]))
    });
    let lines: Vec<Vec<String>> = said.chain(requested).collect();
    for line in lines.iter().take(SHOWN) {
        let mut text = String::new();
        wrapped(&mut text, line, 2, width);
        for (place, line) in text.lines().enumerate() {
            let indent = if place == 0 { 0 } else { INDENT - 2 };
            out.extend(std::iter::repeat_n(' ', indent));
            out.push_str(line);
            out.push('\n');
        }
    }
    more(out, lines.len(), SHOWN)
}

/// The pieces of a line that stay whole.
fn line(state: AsState, again: bool, name: &str, good: &[String], bad: &[String]) -> Vec<String> {
    let state = if again { format!("{state} again") } else { state.to_string() };
    let mut pieces = vec![format!("{state:15}  {name}:")];
    for (which, values, end) in [("GOOD", good, ";"), ("BAD", bad, "")] {
        let last = values.len().saturating_sub(1);
        for (place, value) in values.iter().enumerate() {
            let before = if place == 0 { format!("{which} ") } else { String::new() };
            pieces.push(format!("{before}{value}{}", if place == last { end } else { "," }));
        }
    }
    pieces
}

/// The names of the values, one after the other.
fn values(sequence: &Sequence) -> Vec<String> {
    let names = sequence.values.iter().map(|raw| sequence.signal.display(*raw).to_string());
    names.chain(sequence.more.then(|| "...".to_owned())).collect()
}

/// Such as `0 to 28.5 Nm`.
fn range(range: Option<&Range>) -> String {
    let Some(Range { signal, min, max, .. }) = range else { return "none".to_owned() };
    let (low, high) = (signal.display(*min).to_string(), signal.display(*max).to_string());
    if min == max {
        return high;
    }
    format!("{} to {high}", low.strip_suffix(&format!(" {}", signal.unit)).unwrap_or(&low))
}
