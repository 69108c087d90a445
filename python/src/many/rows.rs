//! The rows of the two tables, one for each log and one for each finding, as columns of Arrow.

use std::sync::Arc;

use adsdv_oracle::judge::{Finding, Severity};
use adsdv_oracle::log::Judged;
use arrow_array::builder::{BooleanBuilder, Float64Builder, Int64Builder, ListBuilder, StringBuilder};
use arrow_array::{ArrayRef, RecordBatch};
use pyo3::PyResult;
use pyo3::exceptions::PyRuntimeError;

use crate::report::Answers;
use crate::value::seconds;

/// One row for each log.
#[derive(Default)]
pub(super) struct LogRows {
    path: StringBuilder,
    verdict: StringBuilder,
    violations: Int64Builder,
    warnings: Int64Builder,
    notes: Int64Builder,
    edition: StringBuilder,
    edition_certain: BooleanBuilder,
    frames: Int64Builder,
    duration_s: Float64Builder,
    states: ListBuilder<StringBuilder>,
    handshake_median_ms: Float64Builder,
    handshake_p99_ms: Float64Builder,
    handshake_max_ms: Float64Builder,
    error: StringBuilder,
}

impl LogRows {
    /// A log that was judged, by the edition that was recognised or by one that was named; with why it is not all of it.
    pub(super) fn add(&mut self, path: &str, judged: &Judged, recognised: bool, error: Option<String>) {
        let report = &judged.report;
        let count = |severity| whole(report.count(severity) as u64);
        self.path.append_value(path);
        self.verdict.append_value(if error.is_some() { UNREADABLE } else { report.verdict().name() });
        self.violations.append_value(count(Severity::Violation));
        self.warnings.append_value(count(Severity::Warning));
        self.notes.append_value(count(Severity::Note));
        self.edition.append_value(judged.recognised.edition.version);
        self.edition_certain.append_option(recognised.then_some(judged.recognised.certain));
        self.frames.append_value(whole(report.frames));
        self.duration_s.append_value(seconds(report.duration_ns));
        self.states.append_value(report.exercised.states.iter().map(|state| Some(state.name())));
        let answers = Answers::of(&report.responses);
        self.handshake_median_ms.append_option(answers.as_ref().map(|answers| answers.median));
        self.handshake_p99_ms.append_option(answers.as_ref().map(|answers| answers.p99));
        self.handshake_max_ms.append_option(answers.as_ref().map(|answers| answers.max));
        self.error.append_option(error);
    }

    /// A log that has no report.
    pub(super) fn add_unreadable(&mut self, path: &str, error: String) {
        self.path.append_value(path);
        self.verdict.append_value(UNREADABLE);
        for counts in [&mut self.violations, &mut self.warnings, &mut self.notes, &mut self.frames] {
            counts.append_value(0);
        }
        self.edition.append_null();
        self.edition_certain.append_null();
        self.duration_s.append_value(0.0);
        self.states.append_value(std::iter::empty::<Option<&str>>());
        for answers in [&mut self.handshake_median_ms, &mut self.handshake_p99_ms, &mut self.handshake_max_ms]
        {
            answers.append_null();
        }
        self.error.append_value(error);
    }

    pub(super) fn batch(&mut self) -> PyResult<RecordBatch> {
        batch([
            ("path", Arc::new(self.path.finish()), false),
            ("verdict", Arc::new(self.verdict.finish()), false),
            ("violations", Arc::new(self.violations.finish()), false),
            ("warnings", Arc::new(self.warnings.finish()), false),
            ("notes", Arc::new(self.notes.finish()), false),
            ("edition", Arc::new(self.edition.finish()), true),
            ("edition_certain", Arc::new(self.edition_certain.finish()), true),
            ("frames", Arc::new(self.frames.finish()), false),
            ("duration_s", Arc::new(self.duration_s.finish()), false),
            ("states", Arc::new(self.states.finish()), false),
            ("handshake_median_ms", Arc::new(self.handshake_median_ms.finish()), true),
            ("handshake_p99_ms", Arc::new(self.handshake_p99_ms.finish()), true),
            ("handshake_max_ms", Arc::new(self.handshake_max_ms.finish()), true),
            ("error", Arc::new(self.error.finish()), true),
        ])
    }
}

/// As `adsdv check` calls a log that has no report, or one of less than all.
const UNREADABLE: &str = "unreadable";

/// One row for each finding: what a finding of a report has, but for the frames that are its evidence.
#[derive(Default)]
pub(super) struct FindingRows {
    path: StringBuilder,
    t: Float64Builder,
    severity: StringBuilder,
    party: StringBuilder,
    section: StringBuilder,
    rule: StringBuilder,
    requirements: ListBuilder<StringBuilder>,
    message: StringBuilder,
    seen: StringBuilder,
    expected: StringBuilder,
    unless: StringBuilder,
}

impl FindingRows {
    pub(super) fn add(&mut self, path: &str, findings: &[Finding]) {
        for finding in findings {
            self.path.append_value(path);
            self.t.append_value(seconds(finding.t_ns));
            self.severity.append_value(finding.severity.name());
            self.party.append_value(finding.party.name());
            self.section.append_value(finding.section.to_string());
            self.rule.append_value(finding.rule.id());
            self.requirements.append_value(finding.requirements.iter().map(Some));
            self.message.append_value(finding.message());
            self.seen.append_value(&finding.seen);
            self.expected.append_option(Some(&finding.expected).filter(|text| !text.is_empty()));
            self.unless.append_option(finding.excuse());
        }
    }

    pub(super) fn batch(&mut self) -> PyResult<RecordBatch> {
        batch([
            ("path", Arc::new(self.path.finish()), false),
            ("t", Arc::new(self.t.finish()), false),
            ("severity", Arc::new(self.severity.finish()), false),
            ("party", Arc::new(self.party.finish()), false),
            ("section", Arc::new(self.section.finish()), false),
            ("rule", Arc::new(self.rule.finish()), false),
            ("requirements", Arc::new(self.requirements.finish()), false),
            ("message", Arc::new(self.message.finish()), false),
            ("seen", Arc::new(self.seen.finish()), false),
            ("expected", Arc::new(self.expected.finish()), true),
            ("unless", Arc::new(self.unless.finish()), true),
        ])
    }
}

/// Columns by their names, and whether there may be nothing in them.
fn batch<const N: usize>(columns: [(&str, ArrayRef, bool); N]) -> PyResult<RecordBatch> {
    // Texts of more than 2 GB in a column are the one thing that Arrow cannot take.
    RecordBatch::try_from_iter_with_nullable(columns)
        .map_err(|error| PyRuntimeError::new_err(format!("the table cannot be made: {error}")))
}

fn whole(count: u64) -> i64 {
    i64::try_from(count).unwrap_or(i64::MAX)
}
