//! What a report says of a finding, in pieces that each form puts together in its own way.

use std::collections::{BTreeSet, HashSet};
use std::fmt::{self, Write as _};

use crate::report::{ExamFinding, ExamReport, FoundBy, Outcome};
use crate::session::Sent;
use crate::shrink::Shorter;

/// So many frames stand in a line.
pub const FRAMES: usize = 3;

/// What is beside the words of a finding.
#[derive(Clone, Debug)]
pub struct Pieces<'a> {
    /// Its scenario, and what that is about.
    pub scenario: String,
    /// What the operator had done by then; empty if nothing.
    pub operator: String,
    /// What the car did.
    pub car: &'a str,
    /// The last frames, each with its time.
    pub frames: Vec<String>,
}

impl<'a> Pieces<'a> {
    /// Those of a finding of this report.
    pub fn of(report: &ExamReport, finding: &'a ExamFinding) -> Self {
        let scenario = report.scenarios.get(finding.scenario);
        let (name, about) = scenario.map_or(("", ""), |one| (one.name.as_str(), one.about.as_str()));
        let did = |(ms, what): &(u64, String)| format!("{} s {what}", At(ms_to_ns(*ms)));
        let frame = |sent: &Sent| format!("{} {}", At(sent.t_ns), sent.frame);
        Self {
            scenario: format!("{name}: {about}"),
            operator: finding.operator.iter().map(did).collect::<Vec<_>>().join("; "),
            car: &finding.car,
            frames: finding.frames.iter().map(frame).collect(),
        }
    }
}

impl ExamFinding {
    /// What was seen, and what was expected, where that is not the same.
    pub fn words(&self) -> String {
        let Self { seen, expected, .. } = self;
        if expected.is_empty() { seen.clone() } else { format!("{seen}; expected {expected}") }
    }

    /// What it can be accepted by: the requirements that it is against, or its rule where no single one is.
    pub fn ids(&self) -> Vec<&'static str> {
        if self.requirements.is_empty() { vec![self.found_by.id()] } else { self.requirements.clone() }
    }
}

impl ExamFinding {
    /// Whether it is the same mistake in other numbers: by the same rule of the judge, or of what was expected the same was not done.
    fn is_of_the_kind_of(&self, other: &Self) -> bool {
        let by_rule = matches!(self.found_by, FoundBy::Judge(_));
        self.found_by == other.found_by && (by_rule || self.expected == other.expected)
    }
}

impl ExamReport {
    /// The places of the findings that are shown: of each requirement that failed the one that shows soonest, and all that are
    /// against none, once.
    pub fn shown(&self) -> Vec<usize> {
        let soonest = self.requirements.iter().filter_map(|one| match &one.outcome {
            Outcome::Fail(places) => places.first().copied(),
            _ => None,
        });
        let mut shown: Vec<usize> = soonest.collect();
        for (place, finding) in self.findings.iter().enumerate() {
            let is_shown = |other: &usize| {
                self.findings.get(*other).is_some_and(|other| finding.is_of_the_kind_of(other))
            };
            if finding.requirements.is_empty() && !shown.iter().any(is_shown) {
                shown.push(place);
            }
        }
        let mut seen = HashSet::new();
        shown.retain(|place| seen.insert(*place));
        shown
    }

    /// The places of the findings that are against no single requirement.
    pub fn others(&self) -> Vec<usize> {
        let all = self.findings.iter().enumerate();
        all.filter(|(_, one)| one.requirements.is_empty()).map(|(place, _)| place).collect()
    }

    /// How many scenarios have one of these findings.
    pub fn scenarios_of(&self, places: &[usize]) -> u64 {
        let found = places.iter().filter_map(|place| Some(self.findings.get(*place)?.scenario));
        found.collect::<BTreeSet<_>>().len() as u64
    }

    /// The first of these findings in some lines of text, and how many scenarios have one; empty if there is none.
    pub fn description(&self, places: &[usize], shorter: &Shorter) -> String {
        let Some(place) = places.first() else { return String::new() };
        let Some(finding) = self.findings.get(*place) else { return String::new() };
        let pieces = Pieces::of(self, finding);
        let count = self.scenarios_of(places);
        let many = if count == 1 { "1 scenario".to_owned() } else { format!("{count} scenarios") };
        let mut text = format!("{}\nscenario  {} ({many} in all)\n", finding.words(), pieces.scenario);
        // Writing to a string does not fail.
        let _ = writeln!(text, "time      {} s, section {}", At(finding.t_ns), finding.section);
        let _ = writeln!(text, "operator  {}\ncar       {}", pieces.operator, pieces.car);
        for frames in pieces.frames.chunks(FRAMES) {
            let _ = writeln!(text, "frames    {}", frames.join("   "));
        }
        if let Some(trace) = &finding.trace {
            let _ = writeln!(text, "{}", trace.trim_end());
        }
        if let Some(shortest) = shorter.get(place) {
            let _ = write!(text, "shortest scenario, for adsdv exam --scenario:\n{}", shortest.scenario);
        }
        text
    }
}

/// Seconds of nanoseconds, to the millisecond.
struct At(i64);

impl fmt::Display for At {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ms = self.0.max(0).saturating_add(500_000) / 1_000_000;
        write!(f, "{}.{:03}", ms / 1000, ms % 1000)
    }
}

fn ms_to_ns(ms: u64) -> i64 {
    i64::try_from(ms).unwrap_or(i64::MAX / 1_000_000).saturating_mul(1_000_000)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_what_is_against_no_requirement_each_kind_is_shown_once() {
        let finding = |expected: &str, seen: &str| ExamFinding {
            expected: expected.to_owned(),
            seen: seen.to_owned(),
            ..ExamFinding::new(0, "2.1", FoundBy::Exam, Vec::new())
        };
        let findings = vec![
            finding("it to run", "it ended after 1 s"),
            finding("it to run", "it ended after 2 s"),
            finding("it to listen", "it sent while it was off"),
        ];
        let report = ExamReport {
            scenarios: Vec::new(),
            requirements: Vec::new(),
            findings,
            slowest: None,
            notes: Vec::new(),
        };
        assert_eq!(report.shown(), [0, 2]);
    }
}
