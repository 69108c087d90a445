//! What is kept of each log: its row.

use std::cmp::Reverse;
use std::collections::BTreeMap;

use adsdv_oracle::judge::{Finding, Rule, Severity};

use crate::error::Error;
use crate::judged::Subject;
use crate::layout::{Seconds, counted};
use crate::status::Status;

/// Of a rule so many findings are kept in words.
const WORDS: usize = 5;

/// What came of a log.
#[derive(Debug)]
pub(super) struct Row {
    pub(super) name: String,
    /// The edition that it was judged by.
    pub(super) edition: &'static str,
    pub(super) frames: u64,
    pub(super) duration_ns: i64,
    pub(super) status: Status,
    /// Violations, warnings and notes.
    pub(super) counts: [usize; 3],
    /// By rule, what violates it and what is warned of.
    pub(super) rules: BTreeMap<&'static str, OfRule>,
    /// What was required and is missing.
    pub(super) missing: Vec<String>,
    /// The first violation, or why the log could not be read, or not to its end.
    pub(super) first: Option<String>,
}

/// What was found of a rule.
#[derive(Debug, Default)]
pub(super) struct OfRule {
    pub(super) violations: usize,
    pub(super) warnings: usize,
    /// The first few, in words.
    pub(super) words: Vec<String>,
}

impl Row {
    pub(super) fn of(name: &str, subject: &Subject) -> Self {
        let report = &subject.report;
        let mut rules: BTreeMap<&'static str, OfRule> = BTreeMap::new();
        for finding in report.findings.iter().filter(|finding| finding.severity != Severity::Note) {
            let of = rules.entry(finding.rule.id()).or_default();
            match finding.severity {
                Severity::Violation => of.violations += 1,
                _ => of.warnings += 1,
            }
            if of.words.len() < WORDS {
                of.words.push(words(finding));
            }
        }
        let broken = report.findings.iter().find(|finding| finding.severity == Severity::Violation);
        let failure = subject.failure.as_ref().map(ToString::to_string);
        Self {
            name: name.to_owned(),
            edition: subject.edition().version,
            frames: report.frames,
            duration_ns: report.duration_ns,
            status: subject.status(),
            counts: [Severity::Violation, Severity::Warning, Severity::Note]
                .map(|severity| report.count(severity)),
            rules,
            missing: subject.missing(),
            first: failure
                .or_else(|| broken.map(|finding| format!("{} {}", finding.party.name(), words(finding)))),
        }
    }

    pub(super) fn unreadable(name: &str, error: &Error) -> Self {
        Self {
            name: name.to_owned(),
            edition: "",
            frames: 0,
            duration_ns: 0,
            status: Status::NoAnswer,
            counts: [0; 3],
            rules: BTreeMap::new(),
            missing: Vec::new(),
            first: Some(error.why.clone()),
        }
    }

    pub(super) const fn verdict(&self) -> &'static str {
        match self.status {
            Status::Conforms => "conforms",
            Status::Violates => "violates",
            Status::NoAnswer => "unreadable",
        }
    }

    /// The larger, the worse.
    fn badness(&self) -> (u8, usize, usize) {
        let status = match self.status {
            Status::NoAnswer => 2,
            Status::Violates => 1,
            Status::Conforms => 0,
        };
        (status, self.counts[0], self.counts[1])
    }
}

fn words(finding: &Finding) -> String {
    format!("{} at {} s: {}", Rule::id(finding.rule), Seconds(finding.t_ns), finding.message())
}

/// What came of all.
#[derive(Debug, Default)]
pub(super) struct Rows {
    pub(super) all: Vec<Row>,
    /// How many files of directories have no frame.
    pub(super) no_logs: usize,
    /// The worst of those that could be judged: its place, and its report.
    worst: Option<(usize, String)>,
}

impl Rows {
    pub(super) fn add(&mut self, row: Row, text: Option<String>) {
        let worst = self.worst.as_ref().and_then(|(place, _)| self.all.get(*place));
        if row.frames > 0
            && worst.is_none_or(|worst| row.badness() > worst.badness())
            && let Some(text) = text
        {
            self.worst = Some((self.all.len(), text));
        }
        self.all.push(row);
    }

    /// The worst first; of equally bad ones in the order in which they were named.
    pub(super) fn worst_first(&self) -> Vec<&Row> {
        let mut rows: Vec<&Row> = self.all.iter().collect();
        rows.sort_by_key(|row| Reverse(row.badness()));
        rows
    }

    /// The report of the worst; of several that are without fault there is none.
    pub(super) fn report_of_worst(&self) -> Option<&str> {
        let (place, text) = self.worst.as_ref()?;
        let without_fault = self.all.get(*place)?.badness() == (0, 0, 0);
        (!without_fault || self.all.len() == 1).then_some(text)
    }

    pub(super) fn count(&self, status: Status) -> usize {
        self.all.iter().filter(|row| row.status == status).count()
    }

    /// In a line: how many logs, and what came of them.
    pub(super) fn counts(&self) -> String {
        let one = |status: Status, words: &str| {
            let count = self.count(status);
            (count > 0).then(|| format!("{count} {words}"))
        };
        let of = [
            (Status::NoAnswer, "unreadable"),
            (Status::Violates, "violating"),
            (Status::Conforms, "conforming"),
        ];
        let of: Vec<String> = of.into_iter().filter_map(|(status, words)| one(status, words)).collect();
        format!("{}: {}", counted(self.all.len() as u64, "log"), of.join(", "))
    }

    pub(super) fn passed_over(&self) -> String {
        format!("{} without a frame passed over", counted(self.no_logs as u64, "file"))
    }

    /// That of the worst.
    pub(super) fn status(&self) -> Status {
        let worst = self.all.iter().max_by_key(|row| row.badness());
        worst.map_or(Status::NoAnswer, |row| row.status)
    }
}
