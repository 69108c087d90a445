//! The findings that are shown, and the pieces of one, which each form puts together in its own way.

use adsdv_exam::{ExamFinding, ExamReport, Outcome, Sent};

use crate::layout::Seconds;

/// So many findings are shown in full.
pub(super) const FINDINGS: usize = 12;
/// So many frames stand in a line.
pub(super) const FRAMES: usize = 3;

/// What is beside the words of a finding.
pub(super) struct Pieces<'a> {
    /// Its scenario, and what that is about.
    pub(super) scenario: String,
    /// What the operator had done by then; empty if nothing.
    pub(super) operator: String,
    /// What the car did.
    pub(super) car: &'a str,
    /// The last frames, each with its time.
    pub(super) frames: Vec<String>,
}

impl<'a> Pieces<'a> {
    pub(super) fn of(report: &ExamReport, finding: &'a ExamFinding) -> Self {
        let scenario = report.scenarios.get(finding.scenario);
        let (name, about) = scenario.map_or(("", ""), |one| (one.name.as_str(), one.about.as_str()));
        let did = |(ms, what): &(u64, String)| format!("{} s {what}", Seconds(ms_to_ns(*ms)));
        let frame = |sent: &Sent| format!("{} {}", Seconds(sent.t_ns), sent.frame);
        Self {
            scenario: format!("{name}: {about}"),
            operator: finding.operator.iter().map(did).collect::<Vec<_>>().join("; "),
            car: &finding.car,
            frames: finding.frames.iter().map(frame).collect(),
        }
    }
}

/// What was seen, and what was expected.
pub(super) fn words(finding: &ExamFinding) -> String {
    format!("{}; expected {}", finding.seen, finding.expected)
}

/// The places of the findings that are shown: of each requirement that failed the one that shows soonest, and all that are against none, once.
pub(super) fn shown(report: &ExamReport) -> Vec<usize> {
    let soonest = report.requirements.iter().filter_map(|one| match &one.outcome {
        Outcome::Fail(places) => places.first().copied(),
        _ => None,
    });
    let mut shown: Vec<usize> = soonest.collect();
    for (place, finding) in report.findings.iter().enumerate() {
        let is_shown = |other: &usize| {
            report.findings.get(*other).is_some_and(|other| other.found_by == finding.found_by)
        };
        if finding.requirements.is_empty() && !shown.iter().any(is_shown) {
            shown.push(place);
        }
    }
    let mut seen = std::collections::HashSet::new();
    shown.retain(|place| seen.insert(*place));
    shown
}

/// How many scenarios have one of these findings.
pub(super) fn scenarios(report: &ExamReport, places: &[usize]) -> u64 {
    let found = places.iter().filter_map(|place| Some(report.findings.get(*place)?.scenario));
    found.collect::<std::collections::BTreeSet<_>>().len() as u64
}

pub(super) fn ms_to_ns(ms: u64) -> i64 {
    i64::try_from(ms).unwrap_or(i64::MAX / 1_000_000).saturating_mul(1_000_000)
}
