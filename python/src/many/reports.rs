//! `Reports`: what check says of each of many logs.

use pyo3::prelude::*;
use pyo3::types::{PyDict, PyIterator, PyList, PyTuple};

use super::table::Table;

/// The reports of many logs, made by check_many: a sequence of Report, in the order of the logs, and tables of all of them.
///
/// A log without a report has its error in errors, and a row in logs. A directory names its logs in the order of their names.
///
/// >>> import adsdv, pathlib, tempfile
/// >>> folder = tempfile.TemporaryDirectory()
/// >>> log = pathlib.Path(folder.name, "run.log")
/// >>> _ = log.write_text("(1.0) can0 520#0000040000000000\n(1.01) can0 520#0000030000000000\n")
/// >>> reports = adsdv.check_many([log, "no-such.log"], edition="3.0")
/// >>> reports
/// <adsdv.Reports: 2 logs: 1 unreadable, 1 violating>
/// >>> [(path == str(log), report.verdict) for path, report in zip(reports.paths, reports)]
/// [(True, 'violates')]
/// >>> reports.findings.columns()["rule"]
/// ['no-such-arrow', 'one-sided']
#[pyclass(frozen, sequence, module = "adsdv")]
pub(crate) struct Reports {
    pub(super) each: Py<PyTuple>,
    pub(super) paths: Py<PyList>,
    pub(super) errors: Py<PyDict>,
    pub(super) passed_over: Py<PyList>,
    pub(super) worst_first: Py<PyList>,
    pub(super) logs: Py<Table>,
    pub(super) findings: Py<Table>,
    /// How many logs are unreadable, violate and conform.
    pub(super) counts: [usize; 3],
}

#[pymethods]
impl Reports {
    /// Of each report, the path of its log, as check_many found it.
    #[getter]
    fn paths(&self, py: Python<'_>) -> Py<PyList> {
        self.paths.clone_ref(py)
    }

    /// By the path of the log, the exception that says why it has no report, the one that check raises. Of a log that is cut off or damaged,
    /// what comes before that is judged: it has both, a report and an error.
    ///
    /// >>> import adsdv
    /// >>> adsdv.check_many(["no-such.log"]).errors
    /// {'no-such.log': FileNotFoundError(2, 'No such file or directory')}
    #[getter]
    fn errors(&self, py: Python<'_>) -> Py<PyDict> {
        self.errors.clone_ref(py)
    }

    /// The files of directories that hold no frame, and so are no logs.
    #[getter]
    fn passed_over(&self, py: Python<'_>) -> Py<PyList> {
        self.passed_over.clone_ref(py)
    }

    /// The paths of all logs as `adsdv check` orders them: those with an error first, then those with the most violations, then warnings.
    #[getter]
    fn worst_first(&self, py: Python<'_>) -> Py<PyList> {
        self.worst_first.clone_ref(py)
    }

    /// A row for each log, whether it has a report or not: path, verdict ("conforms", "violates", or "unreadable" where errors has it),
    /// violations, warnings and notes (how many), edition, edition_certain (None where the edition was named), frames, duration_s, states
    /// (the AS states that were seen), handshake_median_ms, handshake_p99_ms and handshake_max_ms (how fast the AI Computer answered), and
    /// error.
    ///
    /// >>> import adsdv
    /// >>> adsdv.check_many(["no-such.log"]).logs.columns()["verdict"]
    /// ['unreadable']
    #[getter]
    fn logs(&self, py: Python<'_>) -> Py<Table> {
        self.logs.clone_ref(py)
    }

    /// A row for each finding of each log, in order: path, and what Report.findings has but for the evidence.
    #[getter]
    fn findings(&self, py: Python<'_>) -> Py<Table> {
        self.findings.clone_ref(py)
    }

    fn __len__(&self, py: Python<'_>) -> usize {
        self.each.bind(py).len()
    }

    fn __getitem__<'py>(&self, index: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        self.each.bind(index.py()).as_any().get_item(index)
    }

    fn __iter__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyIterator>> {
        self.each.bind(py).try_iter()
    }

    fn __repr__(&self) -> String {
        let words = ["unreadable", "violating", "conforming"];
        let counts = self.counts.iter().zip(words).filter(|(count, _)| **count > 0);
        let counts: Vec<String> = counts.map(|(count, word)| format!("{count} {word}")).collect();
        let logs: usize = self.counts.iter().sum();
        let of = if counts.is_empty() { String::new() } else { format!(": {}", counts.join(", ")) };
        format!("<adsdv.Reports: {logs} log{}{of}>", if logs == 1 { "" } else { "s" })
    }
}
