//! `exam`: examines an AI Computer, a stack in Python or a program.

mod options;
mod report;
mod stack;

use std::fs::{self, File};
use std::io::{self, BufWriter};
use std::path::{Path, PathBuf};

use adsdv_exam::{
    ExamForm, ExamReport, ExamScenario, Sent, Shorter, StackError, exam as hold, shorter, write_log,
};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

use crate::edition;
use crate::error;
use options::{Logs, Options};
use report::PyReport;
use stack::{Given, UnderTest};

pub(crate) fn add(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<PyReport>()?;
    module.add_function(wrap_pyfunction!(exam, module)?)?;
    module.add_function(wrap_pyfunction!(exam_requirements, module)?)?;
    module.add_function(wrap_pyfunction!(exam_scenarios, module)?)
}

/// Examines a stack, the AI Computer, in simulated time, as `adsdv exam --stdio` does: is its car, its operator and its judge, in one
/// scenario after the other.
///
/// stack: what makes the stack, such as its class: it is called without arguments at the beginning of each scenario, and makes a
/// stack that has just been switched on. Every 10 ms of simulated time its method step, or the stack itself if it has none, is
/// called with the time since then in milliseconds and a list of the frames that have come since, each an (identifier, data), and
/// returns those that it sends now. Or a program that speaks exam/PROTOCOL.md: a list of it and its arguments, such as
/// ["python3", "stack.py"].
/// edition: the edition of the interface, one of adsdv.editions(); None for adsdv.INTERFACE_VERSION.
/// only: the beginning of the names of the scenarios to hold, or a list of such; adsdv.exam_scenarios() lists them.
/// quick: only the few scenarios that show most.
/// scenario: the text of a scenario to hold instead, such as a finding's shortest.
/// runs, seed: so many scenarios by chance follow, at most 100000; the same seed, 1 if it is None, is the same ones.
/// shrink: of each finding that is shown, how many runs to look for the shortest scenario that shows it; None for 40.
/// mission_time: how long a mission may take, in seconds of simulated time; None for 60.
/// timeout, time_limit: how long a program may take for an answer, and for all of them, in seconds; None for 5 and 900.
/// logs: True to have the log of each scenario in the report, some 40 MB for all of them; or the directory to write them to.
///
/// A stack that raises an Exception, or returns what are no frames, has failed: its scenario is over, and that is a finding with
/// the rule stack-failed. KeyboardInterrupt ends the exam. A program that cannot be started is an OSError; one that does not keep
/// to the protocol is a StackError.
///
/// >>> import adsdv
/// >>> class Stack:
/// ...     def step(self, t_ms, frames):
/// ...         return []
/// >>> report = adsdv.exam(Stack, only="ready")
/// >>> report.requirement("RDY-7")["outcome"]
/// 'fail'
/// >>> print(report.explain("RDY-7").splitlines()[0])
/// MISSION_STATUS is not SELECTED though a mission is selected on the AMI after 2000 ms (no 510h that can be read, in AS_OFF); expected MISSION_STATUS SELECTED
// They are keyword arguments in Python.
#[allow(clippy::too_many_arguments)]
#[pyfunction]
#[pyo3(signature = (stack, *, edition=None, only=None, quick=false, scenario=None, runs=None, seed=None, shrink=None, mission_time=None, timeout=None, time_limit=None, logs=None))]
fn exam(
    py: Python<'_>,
    stack: &Bound<'_, PyAny>,
    edition: Option<&Bound<'_, PyAny>>,
    only: Option<&Bound<'_, PyAny>>,
    quick: bool,
    scenario: Option<&Bound<'_, PyAny>>,
    runs: Option<&Bound<'_, PyAny>>,
    seed: Option<&Bound<'_, PyAny>>,
    shrink: Option<&Bound<'_, PyAny>>,
    mission_time: Option<&Bound<'_, PyAny>>,
    timeout: Option<&Bound<'_, PyAny>>,
    time_limit: Option<&Bound<'_, PyAny>>,
    logs: Option<&Bound<'_, PyAny>>,
) -> PyResult<PyReport> {
    let given = Given::of(stack)?;
    let edition = edition::or_default(edition)?;
    let scenarios = options::scenarios(only, quick, scenario, runs, seed)?;
    let options = Options::of(edition, shrink, mission_time, timeout, time_limit, logs)?;
    let examined = py.detach(|| examine(&given, &scenarios, &options));
    let Examined { report, shorter, logs } = examined.map_err(|trouble| trouble.raised(py, stack))?;
    let form = ExamForm {
        edition,
        program: given.words(),
        shorter: &shorter,
        reason: &|_| None,
        unused: Vec::new(),
        passes: report.passes(),
    };
    PyReport::of(py, &form.text(&report), &report, &shorter, logs)
}

/// What comes of an exam.
struct Examined {
    report: ExamReport,
    shorter: Shorter,
    /// The logs that are to be in the report, each by its name.
    logs: Vec<(String, Vec<u8>)>,
}

/// Why nothing does.
enum Trouble {
    /// Python has something against it.
    Raised(PyErr),
    Stack(StackError),
    /// A log cannot be written.
    Log(PathBuf, io::Error),
}

impl Trouble {
    fn raised(self, py: Python<'_>, stack: &Bound<'_, PyAny>) -> PyErr {
        match self {
            Self::Raised(error) => error,
            Self::Stack(error) => stack::error(py, &error, stack),
            Self::Log(path, error) => match path.as_os_str().into_pyobject(py) {
                Ok(path) => error::os_error(py, &error, path.as_any()),
                Err(error) => error.into(),
            },
        }
    }
}

fn examine(given: &Given, scenarios: &[ExamScenario], options: &Options) -> Result<Examined, Trouble> {
    if let Logs::Directory(path) = &options.logs {
        fs::create_dir_all(path).map_err(|error| Trouble::Log(path.clone(), error))?;
    }
    let mut stack = given.start(options).map_err(Trouble::Stack)?;
    let mut logs = Vec::new();
    let mut logged = Ok(());
    let held = hold(&mut stack, scenarios, &options.exam, &mut |progress| {
        if logged.is_ok() {
            logged = log(&options.logs, &mut logs, progress.name, progress.sent);
        }
    });
    let report = stack.settled(held)?;
    logged?;
    let mut found = Shorter::new();
    if options.shrink > 0 && !report.passes() {
        let mut stack = given.start(options).map_err(Trouble::Stack)?;
        let searched = shorter(&mut stack, scenarios, &report, &options.exam, options.shrink, &mut |_, _| {});
        found = stack.settled(searched)?;
    }
    for (number, place) in (1..).zip(report.shown()) {
        let Some(shortest) = found.get(&place) else { continue };
        let name = format!("finding-{number}");
        if let Logs::Directory(path) = &options.logs {
            let path = path.join(format!("{name}.txt"));
            fs::write(&path, shortest.scenario.to_string()).map_err(|error| Trouble::Log(path, error))?;
        }
        log(&options.logs, &mut logs, &name, &shortest.sent)?;
    }
    Ok(Examined { report, shorter: found, logs })
}

fn log(to: &Logs, logs: &mut Vec<(String, Vec<u8>)>, name: &str, sent: &[Sent]) -> Result<(), Trouble> {
    let wrong = |path: &Path| {
        let path = path.to_owned();
        move |error| Trouble::Log(path, error)
    };
    match to {
        Logs::None => Ok(()),
        Logs::Report => {
            let mut text = Vec::new();
            write_log(&mut text, sent).map_err(wrong(Path::new(name)))?;
            logs.push((name.to_owned(), text));
            Ok(())
        }
        Logs::Directory(path) => {
            let path = path.join(format!("{name}.log"));
            let written = File::create(&path).and_then(|file| write_log(BufWriter::new(file), sent));
            written.map_err(wrong(&path))
        }
    }
}

impl UnderTest {
    /// What came of asking it: what Python raised meanwhile goes first.
    fn settled<T>(&mut self, asked: Result<T, StackError>) -> Result<T, Trouble> {
        match (self.raised(), asked) {
            (Some(error), _) => Err(Trouble::Raised(error)),
            (None, Ok(done)) => Ok(done),
            (None, Err(error)) => Err(Trouble::Stack(error)),
        }
    }
}

/// The requirements on which an AI Computer is examined, in the order of the document, as flat dicts: id, section (of the document) and
/// about (what it asks for, in a few words).
///
/// edition: one of adsdv.editions(); None for adsdv.INTERFACE_VERSION.
///
/// >>> import adsdv
/// >>> [one for one in adsdv.exam_requirements() if one["id"] == "RDY-7"]
/// [{'id': 'RDY-7', 'section': '3.1', 'about': 'confirms the mission that is selected'}]
#[pyfunction]
#[pyo3(signature = (edition=None))]
fn exam_requirements<'py>(
    py: Python<'py>,
    edition: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyList>> {
    let list = PyList::empty(py);
    for one in adsdv_exam::requirements(edition::or_default(edition)?) {
        let dict = PyDict::new(py);
        dict.set_item("id", one.id)?;
        dict.set_item("section", one.section)?;
        dict.set_item("about", one.about)?;
        list.append(dict)?;
    }
    Ok(list)
}

/// The scenarios of an exam, the simple ones first, as flat dicts: name, about (in a few words) and quick (whether it is one of the
/// few that show most).
///
/// >>> import adsdv
/// >>> adsdv.exam_scenarios()[1]
/// {'name': 'ready', 'about': 'a mission is selected, and nothing follows', 'quick': False}
#[pyfunction]
fn exam_scenarios(py: Python<'_>) -> PyResult<Bound<'_, PyList>> {
    let list = PyList::empty(py);
    for one in adsdv_exam::scenarios() {
        let dict = PyDict::new(py);
        dict.set_item("name", &one.name)?;
        dict.set_item("about", &one.about)?;
        dict.set_item("quick", one.is_quick())?;
        list.append(dict)?;
    }
    Ok(list)
}
