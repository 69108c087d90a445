//! `Report`: what a judge says, in the form of `adsdv check --json`.

use adsdv_oracle::judge::{self, Evidence, Finding, ResponseTimes, Severity, Transition, Verdict};
use adsdv_oracle::recognise::Recognised;
use adsdv_spec::Edition;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyList, PyType};

use crate::error::InputError;
use crate::rules;
use crate::value::{self, seconds};

/// The number of the form, as `adsdv check --json` has it.
const SCHEMA: u32 = 1;

/// What every report has.
const KEYS: [&str; 8] = [
    "schema",
    "edition",
    "frames",
    "duration_s",
    "transitions",
    "findings",
    "handshake_response_ms",
    "verdict",
];

/// What only the command reports, and is passed over here: what blocked arrows, margins, and what was exercised.
const FURTHER: [&str; 5] = ["stays", "go_presses", "margins", "exercised", "required"];

/// What a report has where the edition was recognised.
const RECOGNISED: &str = "recognised";

/// What a report has where rules of the user's own were followed.
const RULES: &str = "rules";

/// What a judge says about a log.
///
/// It is made by check and by Judge.finish, or from a dict: that of to_dict, or of the JSON that `adsdv check --json` prints.
/// It can be compared and pickled. Times are in seconds since the first frame.
///
/// >>> import adsdv
/// >>> log = ["(1.000000) can0 520#0000040000000000", "(1.010000) can0 520#0000030000000000"]
/// >>> report = adsdv.check(log, edition="3.0")
/// >>> report
/// <adsdv.Report: violates, 1 violation, 0 warnings, 1 note>
/// >>> report.violations[0]["rule"], report.violations[0]["party"]
/// ('no-such-arrow', 'VCU')
/// >>> report == adsdv.Report(report.to_dict())
/// True
#[pyclass(frozen, module = "adsdv")]
pub(crate) struct Report(Py<PyDict>);

impl Report {
    pub(crate) fn of(
        py: Python<'_>,
        edition: &Edition,
        recognised: Option<&Recognised>,
        report: &judge::Report,
    ) -> PyResult<Self> {
        let dict = PyDict::new(py);
        dict.set_item("schema", SCHEMA)?;
        dict.set_item("edition", edition.version)?;
        if let Some(Recognised { certain, evidence, against, .. }) = recognised {
            let recognised = PyDict::new(py);
            recognised.set_item("certain", certain)?;
            recognised.set_item("evidence", evidence)?;
            recognised.set_item("against", against)?;
            dict.set_item(RECOGNISED, recognised)?;
        }
        dict.set_item("frames", report.frames)?;
        dict.set_item("duration_s", seconds(report.duration_ns))?;
        dict.set_item("transitions", transitions(py, &report.transitions)?)?;
        dict.set_item("findings", findings(py, &report.findings)?)?;
        dict.set_item("handshake_response_ms", responses(py, &report.responses)?)?;
        dict.set_item("verdict", report.verdict().name())?;
        if !report.rules.is_empty() {
            dict.set_item(RULES, rules::reports(py, &report.rules)?)?;
        }
        Ok(Self(dict.unbind()))
    }

    fn get<'py>(&self, py: Python<'py>, key: &str) -> PyResult<Bound<'py, PyAny>> {
        self.0.bind(py).as_any().get_item(key)
    }

    fn of_severity<'py>(&self, py: Python<'py>, severity: Severity) -> PyResult<Vec<Bound<'py, PyAny>>> {
        let mut chosen = Vec::new();
        for finding in self.findings(py)?.try_iter()? {
            let finding = finding?;
            if finding.get_item("severity")?.eq(severity.name())? {
                chosen.push(finding);
            }
        }
        Ok(chosen)
    }
}

#[pymethods]
impl Report {
    #[new]
    #[pyo3(signature = (report, /))]
    fn new(report: &Bound<'_, PyAny>) -> PyResult<Self> {
        let dict = PyDict::new(report.py());
        value::each(Some(report), None, |key, given| {
            let right = match key {
                "schema" => given.extract::<u32>().is_ok_and(|schema| schema == SCHEMA),
                "edition" => value::text(given).is_some(),
                RECOGNISED => given.is_instance_of::<PyDict>(),
                "transitions" | "findings" | RULES => given.is_instance_of::<PyList>(),
                "verdict" => value::text(given).is_some_and(|verdict| {
                    [Verdict::Conforms, Verdict::Violates].iter().any(|one| one.name() == verdict)
                }),
                "handshake_response_ms" => given.is_none() || given.is_instance_of::<PyDict>(),
                "frames" | "duration_s" => given.extract::<f64>().is_ok(),
                key if FURTHER.contains(&key) => return Ok(()),
                _ => return Err(value::unknown_key(key, "", KEYS.into_iter().chain([RECOGNISED, RULES]))),
            };
            if right {
                dict.set_item(key, given)
            } else {
                Err(value::refused(key, given, "what a report has"))
            }
        })?;
        for key in KEYS {
            if !dict.contains(key)? {
                return Err(InputError::new_err(format!("there is no {key:?}; expected a whole report")));
            }
        }
        Ok(Self(dict.unbind()))
    }

    /// The version of the edition of the interface that was judged by.
    ///
    /// >>> import adsdv
    /// >>> adsdv.check(["(1.0) can0 520#0000010000000000"], edition="4.0").edition
    /// '4.0'
    #[getter]
    fn edition<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.get(py, "edition")
    }

    /// How the edition was recognised: a dict of certain (whether it fits better than every other; if not, it is the default),
    /// evidence (what fits it and not every other) and against (what does not fit it). None if somebody named the edition.
    ///
    /// >>> import adsdv
    /// >>> adsdv.check(["(1.0) can0 520#0000010000000000"]).recognised["certain"]
    /// False
    #[getter]
    fn recognised<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyAny>>> {
        self.0.bind(py).get_item(RECOGNISED)
    }

    /// "conforms" or "violates": whether at least one finding is a violation.
    #[getter]
    fn verdict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.get(py, "verdict")
    }

    /// The changes of AS_STATE that were seen, in order, as flat dicts: t, from, to, section (of the document),
    /// and justified ("true", "false" or "unknown").
    #[getter]
    fn transitions<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.get(py, "transitions")
    }

    /// What was found, in order, as flat dicts: t, severity ("violation", "warning" or "note"), party ("AI", "VCU" or
    /// "LOG"; "OWN" where rules of one's own were broken), section (of the document, or the line of the rules), rule (what was
    /// checked) and message.
    #[getter]
    fn findings<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.get(py, "findings")
    }

    /// Those of the findings that are violations.
    ///
    /// >>> import adsdv
    /// >>> adsdv.check(["(1.0) can0 520#0000010000000000"]).violations
    /// []
    #[getter]
    fn violations<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyAny>>> {
        self.of_severity(py, Severity::Violation)
    }

    /// What became of rules of one's own, in their order, as dicts: name, line, rule, verdict ("holds", "broken" or "never
    /// decided"), held, broken and undecided (how many times), breaches (when, and what was seen), and note and why where there
    /// is one. Empty where none were followed.
    ///
    /// >>> import adsdv
    /// >>> log = ["(1.000000) can0 520#0000010000000000", "(1.010000) can0 520#0000020000000000"]
    /// >>> [rule] = adsdv.check(log, rules="calm: never AS_STATE is AS_READY").rules
    /// >>> rule["verdict"], rule["breaches"]
    /// ('broken', [{'t': 0.01, 'seen': 'AS_STATE is AS_READY'}])
    #[getter]
    fn rules<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let rules = self.0.bind(py).get_item(RULES)?;
        Ok(rules.unwrap_or_else(|| PyList::empty(py).into_any()))
    }

    /// How many frames could be read.
    #[getter]
    fn frames<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.get(py, "frames")
    }

    /// The time from the first frame to the last, in seconds.
    #[getter]
    fn duration_s<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.get(py, "duration_s")
    }

    /// How fast the AI Computer answered the handshake (section 2.4), in milliseconds: a dict of count, min, median, p99 and
    /// max; None if no answer was seen.
    #[getter]
    fn handshake_response_ms<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.get(py, "handshake_response_ms")
    }

    /// The whole report as a dict, equal to what `adsdv check --json` prints of the same keys; stays, go_presses, margins and
    /// exercised are the command's alone.
    ///
    /// >>> import adsdv
    /// >>> list(adsdv.check(["(1.0) can0 520#0000010000000000"]).to_dict())
    /// ['schema', 'edition', 'recognised', 'frames', 'duration_s', 'transitions', 'findings', 'handshake_response_ms', 'verdict']
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        self.0.bind(py).copy()
    }

    fn __eq__<'py>(&self, py: Python<'py>, other: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let Ok(other) = other.cast::<Self>() else { return Ok(py.NotImplemented().into_bound(py)) };
        let same = self.0.bind(py).eq(other.get().0.bind(py))?;
        Ok(PyBool::new(py, same).to_owned().into_any())
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let count = |severity: Severity| -> PyResult<String> {
            let count = self.of_severity(py, severity)?.len();
            Ok(format!("{count} {}{}", severity.name(), if count == 1 { "" } else { "s" }))
        };
        let (violations, warnings, notes) =
            (count(Severity::Violation)?, count(Severity::Warning)?, count(Severity::Note)?);
        Ok(format!("<adsdv.Report: {}, {violations}, {warnings}, {notes}>", self.verdict(py)?))
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyType>, (Bound<'py, PyDict>,))> {
        Ok((slf.get_type(), (slf.get().to_dict(slf.py())?,)))
    }
}

pub(crate) fn transitions<'py>(py: Python<'py>, transitions: &[Transition]) -> PyResult<Bound<'py, PyList>> {
    let list = PyList::empty(py);
    for transition in transitions {
        let dict = PyDict::new(py);
        dict.set_item("t", seconds(transition.t_ns))?;
        dict.set_item("from", transition.from.name())?;
        dict.set_item("to", transition.to.name())?;
        dict.set_item("section", transition.section)?;
        dict.set_item("justified", transition.justified.name())?;
        list.append(dict)?;
    }
    Ok(list)
}

pub(crate) fn findings<'py>(py: Python<'py>, findings: &[Finding]) -> PyResult<Bound<'py, PyList>> {
    let list = PyList::empty(py);
    for finding in findings {
        let dict = PyDict::new(py);
        dict.set_item("t", seconds(finding.t_ns))?;
        dict.set_item("severity", finding.severity.name())?;
        dict.set_item("party", finding.party.name())?;
        dict.set_item("section", finding.section.to_string())?;
        dict.set_item("rule", finding.rule.id())?;
        dict.set_item("requirements", &finding.requirements)?;
        dict.set_item("message", finding.message())?;
        dict.set_item("seen", &finding.seen)?;
        dict.set_item("expected", Some(&finding.expected).filter(|text| !text.is_empty()))?;
        dict.set_item("unless", finding.excuse())?;
        dict.set_item("evidence", evidence(py, &finding.evidence)?)?;
        list.append(dict)?;
    }
    Ok(list)
}

fn evidence<'py>(py: Python<'py>, frames: &[Evidence]) -> PyResult<Bound<'py, PyList>> {
    let list = PyList::empty(py);
    for frame in frames {
        let dict = PyDict::new(py);
        dict.set_item("t", seconds(frame.t_ns))?;
        dict.set_item("id", format!("{:03X}h", frame.id))?;
        list.append(dict)?;
    }
    Ok(list)
}

/// How fast the handshake was answered, in milliseconds, rounded to whole microseconds.
pub(crate) struct Answers {
    pub(crate) min: f64,
    pub(crate) median: f64,
    pub(crate) p99: f64,
    pub(crate) max: f64,
}

impl Answers {
    /// `None` if no answer was seen.
    pub(crate) fn of(times: &ResponseTimes) -> Option<Self> {
        let rounded = |ms: f64| (ms * 1e3).round() / 1e3;
        Some(Self {
            min: rounded(times.min_ms()?),
            median: rounded(times.quantile_ms(0.5)?),
            p99: rounded(times.quantile_ms(0.99)?),
            max: rounded(times.max_ms()?),
        })
    }
}

/// `None` if no answer was seen.
pub(crate) fn responses<'py>(py: Python<'py>, times: &ResponseTimes) -> PyResult<Option<Bound<'py, PyDict>>> {
    let Some(Answers { min, median, p99, max }) = Answers::of(times) else { return Ok(None) };
    let dict = PyDict::new(py);
    dict.set_item("count", times.count())?;
    for (key, ms) in [("min", min), ("median", median), ("p99", p99), ("max", max)] {
        dict.set_item(key, ms)?;
    }
    Ok(Some(dict))
}
