//! How close the run came to its limits: the closest few, and of each kind for each side only the closest.

use std::fmt::{self, Write as _};

use adsdv_oracle::judge::{Basis, Margin, Measure, Needs, Party};

use super::style::{self, Styled};
use crate::layout::Seconds;

/// So many tell enough; `--json` has all.
const CLOSEST: usize = 5;

pub(super) fn write(out: &mut String, margins: &[Margin]) -> fmt::Result {
    if margins.is_empty() {
        return Ok(());
    }
    writeln!(out, "\n{}", Styled(style::HEADING, "MARGINS"))?;
    let before = |place: usize| margins.iter().take(place).map(kind);
    let closest = margins
        .iter()
        .enumerate()
        .filter(|(place, margin)| before(*place).all(|other| other != kind(margin)));
    closest.take(CLOSEST).try_for_each(|(_, margin)| write_one(out, margin))
}

fn write_one(out: &mut String, margin: &Margin) -> fmt::Result {
    let Margin { party, section, value, limit, unit, basis, t_ns, .. } = margin;
    let what = name(margin);
    let named = match (basis, margin.what.needs()) {
        (Basis::Cycle, _) => "cycle",
        (Basis::Deadline, _) => "deadline",
        (Basis::Document, Needs::AtMost) => "limit",
        (Basis::Document, Needs::AtLeast) => "at least",
    };
    let left = margin.left();
    let (style, words) = match (basis, margin.what.needs(), left < 0.0) {
        (Basis::Cycle, ..) => (style::QUIET, None),
        (_, Needs::AtMost, true) => (style::BAD, Some("past it")),
        (_, Needs::AtMost, false) => (style::QUIET, Some("left")),
        (_, Needs::AtLeast, true) => (style::BAD, Some("short")),
        (_, Needs::AtLeast, false) => (style::QUIET, Some("more")),
    };
    let rest = words.map(|words| format!(": {:.0} % {words}", left.abs() * 100.0)).unwrap_or_default();
    writeln!(
        out,
        "{:>10} s  {:3}  {section:<8}  {what:<18}  {} {unit}, {named} {} {unit}{}",
        Seconds(*t_ns),
        party.name(),
        number(*value),
        number(*limit),
        Styled(style, rest),
    )
}

/// What the report lists once. Where there was only one reaction, it was the slowest and the fastest.
fn kind(margin: &Margin) -> (Measure, Party) {
    let what = if margin.what == Measure::FastestReaction { Measure::SlowestReaction } else { margin.what };
    (what, margin.party)
}

/// What was measured, with the message where there are several.
pub(crate) fn name(margin: &Margin) -> String {
    let id = margin.what.id();
    margin.message.map_or_else(|| id.to_owned(), |message| format!("{id} {message:03X}h"))
}

/// With up to two decimals.
pub(crate) fn number(value: f64) -> String {
    let text = format!("{value:.2}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_the_decimals_that_they_need() {
        let texts = [0.0, 10.0, 17.07, 5.5, 100.0, 0.004].map(number);
        assert_eq!(texts, ["0", "10", "17.07", "5.5", "100", "0"]);
    }
}
