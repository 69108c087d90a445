//! How much closer to its limits the bad recording came, in words.

use std::fmt::{self, Write as _};

use adsdv_oracle::compare::MarginDiffers;
use adsdv_oracle::judge::Margin;

use super::section::{heading, more};
use crate::report::margins::{name, number};

/// So many margins tell enough.
const SHOWN: usize = 4;

/// The margins that are another, those that got worse first; of the same measure of one side, only the first.
pub(super) fn that_matter<'a, 'b>(margins: &'b [MarginDiffers<'a>]) -> Vec<&'b MarginDiffers<'a>> {
    let kind = |differs: &MarginDiffers<'_>| differs.either().map(|margin| (margin.what, margin.party));
    let mut shown: Vec<&MarginDiffers<'_>> = Vec::new();
    for differs in margins.iter().filter(|margin| margin.got_worse() || margin.got_better()) {
        if shown.iter().all(|other| kind(other) != kind(differs)) {
            shown.push(differs);
        }
    }
    shown
}

pub(super) fn write(out: &mut String, margins: &[MarginDiffers<'_>]) -> fmt::Result {
    let margins = that_matter(margins);
    heading(out, "MARGINS", margins.is_empty())?;
    for differs in margins.iter().take(SHOWN) {
        let (Some(good), Some(bad)) = (differs.good, differs.bad) else { continue };
        let word = if differs.got_worse() { "worse" } else { "better" };
        let by = differs.worse_by().unwrap_or_default().abs() * 100.0;
        writeln!(
            out,
            "  {word:6}  {:3}  {:<8}  {:<18}  GOOD {}, BAD {}: by {by:.0} % of {}",
            bad.party.name(),
            bad.section,
            name(bad),
            value(good),
            value(bad),
            limit(good, bad),
        )?;
    }
    more(out, margins.len(), SHOWN)
}

fn value(margin: &Margin) -> String {
    format!("{} {}", number(margin.value), margin.unit)
}

/// The limit, or both of them where two editions have different ones.
fn limit(good: &Margin, bad: &Margin) -> String {
    let [of_good, of_bad] = [good, bad].map(|margin| number(margin.limit));
    if of_good == of_bad {
        format!("{of_bad} {}", bad.unit)
    } else {
        format!("{of_good} and {of_bad} {}", bad.unit)
    }
}
