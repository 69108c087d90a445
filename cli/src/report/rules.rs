//! What became of the rules of the user's own: a line for each.

use std::fmt::{self, Write as _};

use adsdv_oracle::rules::{RuleReport, RuleVerdict};

use super::style::{self, Styled};
use crate::layout::{Seconds, counted, wrapped};
use crate::output;

/// Names up to this length stand below one another.
const NAME: usize = 24;
/// How many columns stand beside the name, in front of what became of the rule.
const BETWEEN: usize = 30;
/// Where that stands below it, if it has no room there.
const INDENT: usize = 6;

pub(super) fn write(out: &mut String, rules: &[RuleReport], width: usize) -> fmt::Result {
    if rules.is_empty() {
        return Ok(());
    }
    writeln!(out, "\n{}", Styled(style::HEADING, "CUSTOM RULES"))?;
    let longest = rules.iter().map(|rule| rule.name.chars().count()).max().unwrap_or_default().min(NAME);
    rules.iter().try_for_each(|rule| write_one(out, rule, longest, width))
}

fn write_one(out: &mut String, rule: &RuleReport, longest: usize, width: usize) -> fmt::Result {
    let (verdict, style) = match rule.verdict() {
        verdict @ RuleVerdict::Broken => (verdict, style::BAD),
        verdict @ RuleVerdict::Holds => (verdict, style::GOOD),
        verdict @ RuleVerdict::Undecided => (verdict, style::CARE),
    };
    let RuleReport { name, line, held, broken, undecided, breaches, why, .. } = rule;
    let mut facts = Vec::new();
    if let (Some(first), true) = (breaches.first(), *broken > 0) {
        facts.push(format!("{}, first at {} s", counted(*broken, "time"), Seconds(first.t_ns)));
        if *broken > breaches.len() as u64 {
            facts.push(format!("the first {} are listed", breaches.len()));
        }
    }
    if *held > 0 {
        let kept = if *broken > 0 { "held " } else { "" };
        facts.push(format!("{kept}{}", counted(*held, "time")));
    }
    if *undecided > 0 {
        facts.push(format!("not certain {}", counted(*undecided, "time")));
    }
    facts.extend(why.clone());
    let verdict = Styled(style, verdict.name());
    let facts = facts.join("; ");
    let before = longest.max(name.chars().count()) + BETWEEN;
    if before + facts.chars().count() <= width.max(output::WIDTH) {
        return writeln!(out, "  {name:<longest$}  line {line:<4}  {verdict:13}  {facts}");
    }
    writeln!(out, "  {name:<longest$}  line {line:<4}  {verdict}")?;
    wrapped(out, facts.split(' '), INDENT, width);
    Ok(())
}
