//! The verdict, which is about what is not accepted.

use std::path::Path;

use adsdv_exam::{ExamFinding, ExamReport, Outcome};

use crate::accept::{Acceptable, Accepted};
use crate::error::Error;

/// What `--accept` accepts: requirements that fail, and rules of findings that are against no single one.
pub(super) const ACCEPTABLE: Acceptable = Acceptable {
    command: "exam",
    things: "failures",
    example: "RDY-7  the mission is confirmed by hand until June",
};

/// What is accepted of a report.
pub(super) struct Verdict {
    accepted: Accepted,
}

impl Verdict {
    pub(super) const fn new(accepted: Accepted) -> Self {
        Self { accepted }
    }

    /// Whether nothing is wrong but what is accepted.
    pub(super) fn passes(&self, report: &ExamReport) -> bool {
        report.findings.iter().all(|finding| self.accepts(finding))
    }

    /// Whether all that a finding is against is accepted.
    pub(super) fn accepts(&self, finding: &ExamFinding) -> bool {
        finding.ids().into_iter().all(|id| self.reason(id).is_some())
    }

    /// Why a requirement may fail, or why findings of a rule may be there that are against no single one.
    pub(super) fn reason(&self, id: &str) -> Option<&str> {
        self.accepted.reason(id)
    }

    /// Writes what is wrong to a file that accepts it, with the reasons that are given already.
    pub(super) fn write(&self, path: &Path, report: &ExamReport) -> Result<(), Error> {
        self.accepted.write(path, &ACCEPTABLE, wrong(report))
    }

    /// How many of the requirements that failed are accepted.
    pub(super) fn count(&self, report: &ExamReport) -> usize {
        let failed = report.requirements.iter().filter(|one| matches!(one.outcome, Outcome::Fail(_)));
        failed.filter(|one| self.reason(one.id).is_some()).count()
    }

    /// The ids that are accepted for nothing, each with a sentence that says why.
    pub(super) fn unused(&self, report: &ExamReport) -> Vec<(&str, String)> {
        let known: Vec<String> =
            report.findings.iter().flat_map(ExamFinding::ids).map(str::to_owned).collect();
        let why = |id: &str| match report.requirements.iter().find(|one| one.id == id) {
            Some(one) if one.outcome == Outcome::Pass => "passes",
            Some(_) => "is not exercised",
            None => "is no requirement of the exam in this edition, and no rule of a finding",
        };
        let unused = self.accepted.unused(&known).into_iter();
        unused.map(|id| (id, format!("{id} is accepted, and {}: take it out of the file", why(id)))).collect()
    }
}

/// What is wrong, for a file that accepts it: each id with what it asks for, and how it looks.
fn wrong(report: &ExamReport) -> Vec<(String, String)> {
    let mut wrong = Vec::new();
    for one in &report.requirements {
        let Outcome::Fail(places) = &one.outcome else { continue };
        let Some(finding) = places.first().and_then(|place| report.findings.get(*place)) else { continue };
        wrong.push((one.id.to_owned(), format!("{}: {}", one.about, finding.words())));
    }
    for finding in report.findings.iter().filter(|finding| finding.requirements.is_empty()) {
        let id = finding.found_by.id();
        if wrong.iter().all(|(known, _)| known != id) {
            wrong.push((id.to_owned(), finding.words()));
        }
    }
    wrong
}
