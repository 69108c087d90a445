//! The part of a report that says what became of the rules of the user's own.

use adsdv_oracle::rules::{Breach, RuleReport};
use serde::Serialize;

use super::number::seconds;

#[derive(Serialize)]
pub(super) struct RuleJson<'a> {
    name: &'a str,
    line: usize,
    rule: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    note: Option<&'a str>,
    verdict: &'static str,
    held: u64,
    broken: u64,
    undecided: u64,
    breaches: Vec<BreachJson<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    why: Option<&'a str>,
}

#[derive(Serialize)]
struct BreachJson<'a> {
    t: f64,
    seen: &'a str,
}

impl<'a> From<&'a RuleReport> for RuleJson<'a> {
    fn from(report: &'a RuleReport) -> Self {
        let RuleReport { name, line, rule, note, held, broken, undecided, breaches, why } = report;
        let breach = |breach: &'a Breach| BreachJson { t: seconds(breach.t_ns), seen: &breach.seen };
        Self {
            name,
            line: *line,
            rule,
            note: note.as_deref(),
            verdict: report.verdict().name(),
            held: *held,
            broken: *broken,
            undecided: *undecided,
            breaches: breaches.iter().map(breach).collect(),
            why: why.as_deref(),
        }
    }
}
