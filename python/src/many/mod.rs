//! `check_many`: judges many logs, on all cores.
//!
//! ```text
//! paths --> find, each (adsdv-formats): Plan::judge, without Python --> Harvest: reports, rows --> Reports, with two Tables
//!           every 100 ms, and for each log: Ctrl-C, and the caller's progress
//! ```

mod harvest;
mod reports;
mod rows;
mod table;

use std::io;
use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

use adsdv_formats::{FindError, Found, OpenError, Step, each, find, open_watched};
use adsdv_oracle::log::{Judged, LogError};
use pyo3::exceptions::{PyOSError, PyTypeError};
use pyo3::prelude::*;

use crate::check::Plan;
use crate::error;
use crate::value;
use harvest::Harvest;
use reports::Reports;
use table::Table;

/// More threads than any machine has cores.
const MOST_THREADS: u32 = 1024;

pub(crate) fn add(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<Reports>()?;
    module.add_class::<Table>()?;
    module.add_function(wrap_pyfunction!(check_many, module)?)
}

/// Judges many logs, on all cores, and says of each what check says.
///
/// paths: what `adsdv check` takes: files, directories (all logs in them and below, but for hidden files), patterns such as
/// "logs/*.blf"; one of these, or any iterable of them.
/// readings, window_ms, deadline_ms, interface, edition, rules: as of check, for each log.
/// progress: called with how many logs are done, how many there are, how many bytes were read, and how many there are; after each log,
/// and ten times a second. It is called by the thread that called check_many. What it raises stops the work, and is raised.
/// threads: how many logs are judged at once; None for one for each core.
///
/// A log that cannot be read stops no other: its error is in Reports.errors. Files of directories that hold no frame are passed over.
/// Ctrl-C stops the work within some tenths of a second. What is wrong with an argument is raised at once; so is a directory that cannot
/// be listed (an OSError), a pattern that names nothing (an InputError), and that there is no log in what was named (a LogError).
///
/// >>> import adsdv
/// >>> adsdv.check_many(["a.log", "b.log"], progress=lambda done, total, read, size: print(done, "of", total))
/// 1 of 2
/// 2 of 2
/// <adsdv.Reports: 2 logs: 2 unreadable>
// They are keyword arguments in Python.
#[allow(clippy::too_many_arguments)]
#[pyfunction]
#[pyo3(signature = (paths, *, readings=None, window_ms=None, deadline_ms=None, interface=None, edition=None, rules=None, progress=None, threads=None))]
fn check_many(
    py: Python<'_>,
    paths: &Bound<'_, PyAny>,
    readings: Option<&Bound<'_, PyAny>>,
    window_ms: Option<&Bound<'_, PyAny>>,
    deadline_ms: Option<&Bound<'_, PyAny>>,
    interface: Option<String>,
    edition: Option<&Bound<'_, PyAny>>,
    rules: Option<&Bound<'_, PyAny>>,
    progress: Option<&Bound<'_, PyAny>>,
    threads: Option<&Bound<'_, PyAny>>,
) -> PyResult<Reports> {
    let plan = Plan::of(py, readings, window_ms, deadline_ms, interface, edition, rules)?;
    if let Some(given) = progress.filter(|given| !given.is_callable()) {
        return Err(value::refused("progress", given, "something that can be called, or None"));
    }
    let threads = threads.map(|given| value::whole("threads", given, 1, MOST_THREADS)).transpose()?;
    let threads = threads.and_then(|count| NonZeroUsize::new(usize::try_from(count).ok()?));
    let paths = of_paths(paths)?;
    let found = py.detach(|| find(&paths)).map_err(|error| unfound(py, &error))?;
    let mut watch = Watcher {
        progress: progress.map(|progress| progress.clone().unbind()),
        done: 0,
        logs: found.len(),
        read: Arc::default(),
        bytes: found.iter().map(|one| one.bytes).sum(),
    };
    let mut harvest = Harvest::new(py);
    let (read, stop) = (Arc::clone(&watch.read), Arc::new(AtomicBool::new(false)));
    let mut outcome = Ok(());
    let work = |found: Found| {
        let judged = judge(&plan, &found, &read, &stop);
        (found, judged)
    };
    let take = |step| {
        outcome = Python::attach(|py| {
            if let Step::Done((found, judged)) = step {
                watch.done += 1;
                harvest.add(py, &plan, &found, judged)?;
            }
            watch.look(py)
        });
        stop.store(outcome.is_err(), Ordering::Relaxed);
        outcome.is_ok()
    };
    let had_threads = py.detach(|| each(threads, found, work, take));
    had_threads.map_err(|error| PyOSError::new_err(format!("the system has no threads left: {error}")))?;
    outcome?;
    if harvest.is_empty() && !paths.is_empty() {
        return Err(harvest.no_log(&paths));
    }
    harvest.reports(py)
}

/// Why there is no report of a log.
enum Unread {
    /// Its file cannot be opened.
    File(io::Error),
    /// It is nothing that can be read.
    Recording(OpenError),
    /// It cannot be judged.
    Log(LogError),
}

/// Judges one log, unless it is to stop.
fn judge(
    plan: &Plan,
    found: &Found,
    read: &Arc<AtomicU64>,
    stop: &Arc<AtomicBool>,
) -> Result<Judged, Unread> {
    let source = found.source(read).map_err(Unread::File)?;
    let stop = Arc::clone(stop);
    let watch = move || if stop.load(Ordering::Relaxed) { Err(io::ErrorKind::Other.into()) } else { Ok(()) };
    let log = open_watched(source, watch).map_err(Unread::Recording)?;
    plan.judge(log).map_err(Unread::Log)
}

/// What Python learns, and is asked, while the work goes on.
struct Watcher {
    progress: Option<Py<PyAny>>,
    done: usize,
    logs: usize,
    read: Arc<AtomicU64>,
    bytes: u64,
}

impl Watcher {
    fn look(&self, py: Python<'_>) -> PyResult<()> {
        py.check_signals()?;
        let Some(progress) = &self.progress else { return Ok(()) };
        progress.call1(py, (self.done, self.logs, self.read.load(Ordering::Relaxed), self.bytes)).map(drop)
    }
}

/// One path, or all of an iterable.
fn of_paths(given: &Bound<'_, PyAny>) -> PyResult<Vec<PathBuf>> {
    if let Some(path) = of_path(given)? {
        return Ok(vec![path]);
    }
    let wrong = |given: &Bound<'_, PyAny>| {
        PyTypeError::new_err(format!(
            "paths are a path, or an iterable of paths; this is {}",
            value::shown(given)
        ))
    };
    // The contents of a log are an iterable of numbers.
    if value::bytes(given)?.is_some() {
        return Err(wrong(given));
    }
    let paths = given.try_iter().map_err(|_| wrong(given))?;
    paths.map(|path| path.and_then(|path| of_path(&path)?.ok_or_else(|| wrong(&path)))).collect()
}

fn of_path(given: &Bound<'_, PyAny>) -> PyResult<Option<PathBuf>> {
    if value::text(given).is_some() || given.hasattr("__fspath__")? {
        return given.extract().map(Some);
    }
    Ok(None)
}

fn unfound(py: Python<'_>, error: &FindError) -> PyErr {
    match error {
        FindError::Pattern { .. } => error::InputError::new_err(error.to_string()),
        FindError::Directory { path, source } => match path.as_os_str().into_pyobject(py) {
            Ok(path) => error::os_error(py, source, path.as_any()),
            Err(error) => error.into(),
        },
    }
}
