//! A finding as `--json` writes it.

use adsdv_oracle::judge::{Evidence, Finding};
use serde::Serialize;

use super::number::seconds;

/// A finding as `adsdv check --json` prints it.
#[derive(Serialize)]
pub struct FindingJson<'a> {
    t: f64,
    severity: &'static str,
    party: &'static str,
    section: String,
    rule: &'static str,
    requirements: &'a [&'static str],
    message: String,
    seen: &'a str,
    expected: Option<&'a str>,
    unless: Option<&'a str>,
    evidence: Vec<EvidenceJson>,
}

#[derive(Serialize)]
struct EvidenceJson {
    t: f64,
    id: String,
}

impl<'a> From<&'a Finding> for FindingJson<'a> {
    fn from(finding: &'a Finding) -> Self {
        let one =
            |&Evidence { t_ns, id }: &Evidence| EvidenceJson { t: seconds(t_ns), id: format!("{id:03X}h") };
        Self {
            t: seconds(finding.t_ns),
            severity: finding.severity.name(),
            party: finding.party.name(),
            section: finding.section.to_string(),
            rule: finding.rule.id(),
            requirements: &finding.requirements,
            message: finding.message(),
            seen: &finding.seen,
            expected: Some(finding.expected.as_str()).filter(|text| !text.is_empty()),
            unless: finding.excuse(),
            evidence: finding.evidence.iter().map(one).collect(),
        }
    }
}
