//! What comes of the logs, gathered one after the other.

use std::cmp::Reverse;
use std::path::PathBuf;

use adsdv_formats::Found;
use adsdv_oracle::judge::Severity;
use adsdv_oracle::log::{Judged, LogError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList, PyString, PyTuple};

use super::Unread;
use super::reports::Reports;
use super::rows::{FindingRows, LogRows};
use super::table::Table;
use crate::check::Plan;
use crate::error;
use crate::report::Report;
use crate::source;

/// Gathers them.
pub(super) struct Harvest {
    reports: Vec<Py<Report>>,
    /// Of each report, the path of its log.
    paths: Vec<Py<PyString>>,
    /// By the path of the log, why it has no report, or one of less than all.
    errors: Py<PyDict>,
    passed_over: Vec<Py<PyString>>,
    /// Of each log, how bad it is, and its path.
    badness: Vec<(Badness, Py<PyString>)>,
    logs: LogRows,
    findings: FindingRows,
}

/// The larger, the worse, as `adsdv check` orders logs: whether it is unreadable, its violations, its warnings.
type Badness = (bool, usize, usize);

impl Harvest {
    pub(super) fn new(py: Python<'_>) -> Self {
        Self {
            reports: Vec::new(),
            paths: Vec::new(),
            errors: PyDict::new(py).unbind(),
            passed_over: Vec::new(),
            badness: Vec::new(),
            logs: LogRows::default(),
            findings: FindingRows::default(),
        }
    }

    /// Adds what came of a log.
    pub(super) fn add(
        &mut self,
        py: Python<'_>,
        plan: &Plan,
        found: &Found,
        judged: Result<Judged, Unread>,
    ) -> PyResult<()> {
        let path = found.path.as_os_str().into_pyobject(py)?;
        let named = |error: &LogError| source::unread(py, &path, error);
        let judged = match judged {
            // Nobody said that this file is a log.
            Err(Unread::Log(LogError::NoFrame { .. })) if found.by_directory => {
                self.passed_over.push(path.unbind());
                return Ok(());
            }
            Err(Unread::File(error)) => Err(error::os_error(py, &error, path.as_any())),
            Err(Unread::Recording(error)) => Err(source::unopened(py, &path, error)),
            Err(Unread::Log(error)) => Err(named(&error)),
            Ok(judged) => plan.possible(&judged).map(|()| judged),
        };
        let name = found.path.to_string_lossy();
        match judged {
            Ok(judged) => {
                let error = judged.failure.as_ref();
                let count = |severity| judged.report.count(severity);
                let (violations, warnings) = (count(Severity::Violation), count(Severity::Warning));
                self.badness.push(((error.is_some(), violations, warnings), path.clone().unbind()));
                self.logs.add(&name, &judged, plan.recognises(), error.map(ToString::to_string));
                self.findings.add(&name, &judged.report.findings);
                self.reports.push(Py::new(py, plan.report(py, &judged)?)?);
                self.paths.push(path.clone().unbind());
                if let Some(failure) = judged.failure {
                    self.errors.bind(py).set_item(&path, named(&LogError::Read(failure)).into_value(py))?;
                }
            }
            Err(error) => {
                self.badness.push(((true, 0, 0), path.clone().unbind()));
                self.logs.add_unreadable(&name, error.value(py).to_string());
                self.errors.bind(py).set_item(&path, error.into_value(py))?;
            }
        }
        Ok(())
    }

    /// Whether there was no log.
    pub(super) fn is_empty(&self) -> bool {
        self.badness.is_empty()
    }

    /// That there was none.
    pub(super) fn no_log(&self, paths: &[PathBuf]) -> PyErr {
        let paths: Vec<String> = paths.iter().map(|path| path.display().to_string()).collect();
        let count = self.passed_over.len();
        error::LogError::new_err(format!(
            "there is no log in {}, and {count} file{} without a frame; expected recordings of CAN traffic",
            paths.join(", "),
            if count == 1 { "" } else { "s" }
        ))
    }

    /// All of it.
    pub(super) fn reports(mut self, py: Python<'_>) -> PyResult<Reports> {
        let bad = |badness: &Badness| if badness.0 { 0 } else { usize::from(badness.1 == 0) + 1 };
        let mut counts = [0; 3];
        for (badness, _) in &self.badness {
            if let Some(count) = counts.get_mut(bad(badness)) {
                *count += 1;
            }
        }
        self.badness.sort_by_key(|(badness, _)| Reverse(*badness));
        let (logs, findings) = (self.logs.batch()?, self.findings.batch()?);
        Ok(Reports {
            each: PyTuple::new(py, self.reports)?.unbind(),
            paths: PyList::new(py, self.paths)?.unbind(),
            errors: self.errors,
            passed_over: PyList::new(py, self.passed_over)?.unbind(),
            worst_first: PyList::new(py, self.badness.into_iter().map(|(_, path)| path))?.unbind(),
            logs: Py::new(py, Table(logs))?,
            findings: Py::new(py, Table(findings))?,
            counts,
        })
    }
}
