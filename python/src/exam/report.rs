//! `ExamReport`: what came of an exam, in the form of `adsdv exam --json`.

use adsdv_exam::{self as exam, Outcome, Shorter};
use pyo3::intern;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyBytes, PyDict, PyList, PyType};

use crate::value;

/// The key of the explanation of what is against no single requirement.
const OTHERS: &str = "";

/// What came of an exam.
///
/// It is made by exam. It can be compared and pickled. Times are in seconds of simulated time since the start of the scenario.
///
/// >>> import adsdv
/// >>> class Stack:
/// ...     def step(self, t_ms, frames):
/// ...         return [(0x510, bytes(7))]
/// >>> report = adsdv.exam(Stack, only="ready", edition="3.0", shrink=0)
/// >>> report
/// <adsdv.ExamReport: fails, 8 failed, 18 passed, 31 not exercised>
/// >>> report.findings[0]["seen"]
/// 'AI2VCU_Status (510h) has 7 bytes'
#[pyclass(frozen, name = "ExamReport", module = "adsdv")]
pub(crate) struct PyReport {
    /// As the command prints it.
    form: Py<PyDict>,
    /// Of each requirement that failed, what is wrong, as text; of all else that is wrong as well.
    explanations: Py<PyDict>,
    logs: Py<PyDict>,
}

impl PyReport {
    pub(super) fn of(
        py: Python<'_>,
        json: &str,
        report: &exam::ExamReport,
        shorter: &Shorter,
        logs: Vec<(String, Vec<u8>)>,
    ) -> PyResult<Self> {
        let dict = py.import(intern!(py, "json"))?.call_method1(intern!(py, "loads"), (json,))?;
        let explanations = PyDict::new(py);
        for one in &report.requirements {
            if let Outcome::Fail(places) = &one.outcome {
                explanations.set_item(one.id, report.description(places, shorter).trim_end())?;
            }
        }
        explanations.set_item(OTHERS, others(report, shorter))?;
        let kept = PyDict::new(py);
        for (name, text) in logs {
            kept.set_item(name, PyBytes::new(py, &text))?;
        }
        Ok(Self {
            form: dict.cast_into::<PyDict>()?.unbind(),
            explanations: explanations.unbind(),
            logs: kept.unbind(),
        })
    }

    fn get<'py>(&self, py: Python<'py>, key: &str) -> PyResult<Bound<'py, PyAny>> {
        self.form.bind(py).as_any().get_item(key)
    }

    fn of_outcome<'py>(&self, py: Python<'py>, outcome: &str) -> PyResult<Bound<'py, PyList>> {
        let chosen = PyList::empty(py);
        for one in self.requirements(py)?.try_iter()? {
            let one = one?;
            if one.get_item("outcome")?.eq(outcome)? {
                chosen.append(one)?;
            }
        }
        Ok(chosen)
    }
}

/// What is wrong beside the requirements: of each rule the first.
fn others(report: &exam::ExamReport, shorter: &Shorter) -> String {
    let mut by_rule: Vec<(&str, Vec<usize>)> = Vec::new();
    for place in report.others() {
        let Some(rule) = report.findings.get(place).map(|finding| finding.found_by.id()) else { continue };
        match by_rule.iter_mut().find(|(known, _)| *known == rule) {
            Some((_, places)) => places.push(place),
            None => by_rule.push((rule, vec![place])),
        }
    }
    let texts: Vec<String> =
        by_rule.iter().map(|(_, places)| report.description(places, shorter).trim_end().to_owned()).collect();
    texts.join("\n\n")
}

#[pymethods]
impl PyReport {
    /// For copies: what reports are made of is this module's own.
    #[new]
    #[pyo3(signature = (report, explanations, logs, /))]
    fn new(report: Py<PyDict>, explanations: Py<PyDict>, logs: Py<PyDict>) -> Self {
        Self { form: report, explanations, logs }
    }

    /// The version of the edition of the interface.
    #[getter]
    fn edition<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.get(py, "edition")
    }

    /// Whether nothing is wrong.
    #[getter]
    fn passes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.get(py, "passes")
    }

    /// "passes" or "fails".
    #[getter]
    fn verdict(&self, py: Python<'_>) -> PyResult<&'static str> {
        Ok(if self.passes(py)?.is_truthy()? { "passes" } else { "fails" })
    }

    /// Every requirement of the AI Computer that the edition has, in the order of the document, as dicts: id, section (of the document),
    /// about (what it asks for, in a few words), outcome ("pass", "fail" or "not exercised"), findings (the places in the list of
    /// findings of those that are against it, the one that shows soonest first), why (it was not exercised; None if it was)
    /// and accepted (None: that is for the command).
    #[getter]
    fn requirements<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.get(py, "requirements")
    }

    /// Those of the requirements that failed.
    #[getter]
    fn failed<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        self.of_outcome(py, "fail")
    }

    /// A requirement by its id, as in requirements.
    ///
    /// >>> import adsdv
    /// >>> adsdv.exam(lambda: lambda t_ms, frames: [], only="ready", shrink=0).requirement("FIN-1")["why"]
    /// 'no scenario came so far'
    fn requirement<'py>(&self, py: Python<'py>, id: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        for one in self.requirements(py)?.try_iter()? {
            let one = one?;
            if value::text(&one.get_item("id")?) == value::text(id) {
                return Ok(one);
            }
        }
        Err(value::refused("id", id, "one of those of adsdv.exam_requirements(), such as \"RDY-7\""))
    }

    /// All that is wrong, in the order of the scenarios, as dicts: scenario (its name), t, section, rule ("not-done" where something
    /// was to be done and was not, "stack-failed" where the stack raised or returned no frames, else a rule of check),
    /// requirements (that it is against), seen, expected, operator (what the operator had done by then), car (what it did then),
    /// frames (the last ones), shortest (the shortest scenario that was found to show it, or None), and trace (the traceback),
    /// where the stack raised.
    #[getter]
    fn findings<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.get(py, "findings")
    }

    /// The scenarios, in their order, as dicts: name, about, duration (in seconds of simulated time), frames, findings (how many),
    /// exercised (the requirements that it put to the test, kept or broken) and stuck (what it waited for in vain, if it came to no
    /// end).
    #[getter]
    fn scenarios<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.get(py, "scenarios")
    }

    /// What is worth a note about the stack.
    #[getter]
    fn notes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.get(py, "notes")
    }

    /// The slowest answer to the handshake (section 2.4), in milliseconds; None if there was none.
    #[getter]
    fn slowest_answer_ms<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.get(py, "slowest_answer_ms")
    }

    /// The logs by the names of their scenarios, and those of the shortest scenarios as finding-1 and on: each is bytes that check
    /// judges. Empty unless exam was called with logs=True.
    ///
    /// >>> import adsdv
    /// >>> log = adsdv.exam(lambda: lambda t_ms, frames: [], only="ready", logs=True, edition="4.0").logs["ready"]
    /// >>> adsdv.check(log, edition="4.0").transitions
    /// []
    #[getter]
    fn logs<'py>(&self, py: Python<'py>) -> Bound<'py, PyDict> {
        self.logs.bind(py).clone()
    }

    /// What is wrong, in some lines of text: of the finding that shows soonest what was seen and expected, its scenario, what the operator
    /// had done, the frames around it, and the shortest scenario. Empty if nothing is.
    ///
    /// id: of a requirement; None for what is against no single one: of each rule the first.
    #[pyo3(signature = (id=None))]
    fn explain<'py>(&self, py: Python<'py>, id: Option<&Bound<'py, PyAny>>) -> PyResult<Bound<'py, PyAny>> {
        let key = match id {
            Some(id) => self.requirement(py, id)?.get_item("id")?,
            None => OTHERS.into_pyobject(py)?.into_any(),
        };
        let text = self.explanations.bind(py).get_item(key)?;
        text.map_or_else(|| Ok(OTHERS.into_pyobject(py)?.into_any()), Ok)
    }

    /// The whole report as a dict, equal to what `adsdv exam --json` prints.
    ///
    /// >>> import adsdv
    /// >>> list(adsdv.exam(lambda: lambda t_ms, frames: [], only="ready", shrink=0).to_dict())[:4]
    /// ['schema', 'edition', 'program', 'scenarios']
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        self.form.bind(py).copy()
    }

    /// The whole report as JSON, in the form of `adsdv exam --json`, of which `adsdv schema exam` prints the schema. Where no program was
    /// started, its program is empty.
    fn to_json<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let options = PyDict::new(py);
        options.set_item("ensure_ascii", false)?;
        options.set_item("separators", (",", ":"))?;
        py.import(intern!(py, "json"))?.call_method("dumps", (self.form.bind(py),), Some(&options))
    }

    fn __eq__<'py>(&self, py: Python<'py>, other: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let Ok(other) = other.cast::<Self>() else { return Ok(py.NotImplemented().into_bound(py)) };
        let other = other.get();
        let same =
            self.form.bind(py).eq(other.form.bind(py))? && self.logs.bind(py).eq(other.logs.bind(py))?;
        Ok(PyBool::new(py, same).to_owned().into_any())
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let count = |outcome: &str| -> PyResult<String> {
            Ok(format!("{} {outcome}", self.of_outcome(py, outcome)?.len()))
        };
        let (failed, passed, not) = (count("fail")?, count("pass")?, count("not exercised")?);
        Ok(format!("<adsdv.ExamReport: {}, {failed}ed, {passed}ed, {not}>", self.verdict(py)?))
    }

    #[expect(clippy::type_complexity, reason = "it is what pickle asks for")]
    fn __reduce__<'py>(
        slf: &Bound<'py, Self>,
    ) -> (Bound<'py, PyType>, (Bound<'py, PyDict>, Bound<'py, PyDict>, Bound<'py, PyDict>)) {
        let (py, this) = (slf.py(), slf.get());
        let parts = (&this.form, &this.explanations, &this.logs);
        let bound = |dict: &Py<PyDict>| dict.bind(py).clone();
        (slf.get_type(), (bound(parts.0), bound(parts.1), bound(parts.2)))
    }
}
