//! What a log can be read from: a file, bytes, or lines, one after the other.

use std::fs::File;
use std::io::{self, Cursor, Read};
use std::path::PathBuf;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::{self, ThreadId};
use std::time::{Duration, Instant};

use adsdv_formats::{Log, OpenError};
use adsdv_oracle::candump::{ReadError, Unit};
use adsdv_oracle::log::LogError;
use pyo3::exceptions::{PyOSError, PyTypeError};
use pyo3::prelude::*;
use pyo3::pybacked::PyBackedBytes;
use pyo3::types::{PyBytes, PyIterator};

use crate::error::{self, InputError};
use crate::rules;
use crate::value;

/// So long Python waits before it may interrupt.
const UNINTERRUPTED: Duration = Duration::from_millis(50);

/// How many bytes of lines are fetched from Python at a time.
const FETCHED: usize = 1 << 16;

/// The bytes of a log.
struct Source {
    kind: Kind,
    signals: Arc<Signals>,
}

/// Where a log comes from, for errors.
pub(crate) struct Origin {
    /// What to name: the path.
    name: Py<PyAny>,
    signals: Arc<Signals>,
}

enum Kind {
    File(File),
    Bytes(Cursor<PyBackedBytes>),
    Lines(Lines),
}

/// Opens a log, whatever format it has.
pub(crate) fn open(log: &Bound<'_, PyAny>) -> PyResult<(Origin, Log)> {
    let py = log.py();
    let kind = Kind::of(log)?;
    let signals = Arc::new(Signals::new());
    let source = Source { kind, signals: Arc::clone(&signals) };
    let watch = Arc::clone(&signals);
    let origin = Origin { name: log.clone().unbind(), signals };
    match py.detach(|| adsdv_formats::open_watched(source, move || watch.look())) {
        Ok(log) => Ok((origin, log)),
        Err(error) => Err(origin.signals.failure().unwrap_or_else(|| unopened(py, log, error))),
    }
}

/// Why a log cannot be opened; `name` names it.
pub(crate) fn unopened(py: Python<'_>, name: &Bound<'_, PyAny>, error: OpenError) -> PyErr {
    match error {
        OpenError::Read(source) => {
            unread(py, name, &LogError::Read(ReadError { unit: Unit::Line, line: 0, source }))
        }
        OpenError::Foreign(foreign) => error::LogError::new_err(format!(
            "the log is {}, which is not read: {}",
            foreign.what, foreign.hint
        )),
        error @ OpenError::NotBuilt { .. } => error::LogError::new_err(error.to_string()),
    }
}

/// Why a log cannot be judged; `name` names it.
pub(crate) fn unread(py: Python<'_>, name: &Bound<'_, PyAny>, error: &LogError) -> PyErr {
    match error {
        LogError::Read(read) if read.source.raw_os_error().is_some() => {
            error::os_error(py, &read.source, name)
        }
        LogError::Read(_) => PyOSError::new_err(error.to_string()),
        LogError::Rules(error) => rules::wrong(py, error),
        _ => error::LogError::new_err(error.to_string()),
    }
}

impl Kind {
    fn of(log: &Bound<'_, PyAny>) -> PyResult<Self> {
        let py = log.py();
        let kind = if let Some(bytes) = value::bytes(log)? {
            Kind::Bytes(Cursor::new(bytes))
        } else if value::text(log).is_some() || log.hasattr("__fspath__")? {
            let path: PathBuf = log.extract()?;
            // What is opened may wait for another thread: a pipe, for one, does.
            let file = py.detach(|| File::open(path));
            Kind::File(file.map_err(|error| error::os_error(py, &error, log))?)
        } else {
            let lines = log.try_iter().map_err(|_| {
                PyTypeError::new_err(format!(
                    "a log is a path, bytes, or lines; this is {}",
                    value::shown(log)
                ))
            })?;
            Kind::Lines(Lines::new(lines))
        };
        Ok(kind)
    }
}

impl Origin {
    /// Why there is no report.
    pub(crate) fn error(&self, py: Python<'_>, error: &LogError) -> PyErr {
        self.signals.failure().unwrap_or_else(|| unread(py, self.name.bind(py), error))
    }
}

/// Asks Python whether to go on, such as after Ctrl-C, and keeps what it has against that.
struct Signals {
    /// The thread that reads the log. Python hears signals in its main thread alone, and what unpacks the log is another.
    reader: ThreadId,
    begun: Instant,
    /// When Python was asked last, in milliseconds.
    asked: AtomicU64,
    failure: Mutex<Option<PyErr>>,
}

impl Signals {
    fn new() -> Self {
        let (reader, begun) = (thread::current().id(), Instant::now());
        Self { reader, begun, asked: AtomicU64::new(0), failure: Mutex::default() }
    }

    /// Asks, if that was some time ago.
    fn look(&self) -> io::Result<()> {
        if self.locked().is_some() {
            return Err(io::ErrorKind::Other.into());
        }
        if thread::current().id() != self.reader {
            return Ok(());
        }
        let now = self.begun.elapsed();
        if now < Duration::from_millis(self.asked.load(Ordering::Relaxed)) + UNINTERRUPTED {
            return Ok(());
        }
        self.asked.store(u64::try_from(now.as_millis()).unwrap_or(u64::MAX), Ordering::Relaxed);
        self.ask()
    }

    fn ask(&self) -> io::Result<()> {
        #[expect(
            clippy::redundant_closure_for_method_calls,
            reason = "the method alone is not general enough"
        )]
        Python::attach(|py| py.check_signals()).map_err(|error| self.fail(error))
    }

    fn fail(&self, error: PyErr) -> io::Error {
        *self.locked() = Some(error);
        io::ErrorKind::Other.into()
    }

    fn failure(&self) -> Option<PyErr> {
        self.locked().take()
    }

    fn locked(&self) -> MutexGuard<'_, Option<PyErr>> {
        self.failure.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Read for Source {
    fn read(&mut self, room: &mut [u8]) -> io::Result<usize> {
        match &mut self.kind {
            Kind::File(file) => match file.read(room) {
                // A signal came while a pipe gave nothing, and the reader tries again.
                Err(error) if error.kind() == io::ErrorKind::Interrupted => {
                    self.signals.ask()?;
                    Err(error)
                }
                other => other,
            },
            Kind::Bytes(bytes) => bytes.read(room),
            Kind::Lines(lines) => lines.read(room).map_err(|error| self.signals.fail(error)),
        }
    }
}

/// The lines of an iterator, each with an end.
struct Lines {
    iterator: Py<PyIterator>,
    text: Vec<u8>,
    /// How much of the text has been read.
    read: usize,
    count: u64,
    /// Whether the last line lacks its end.
    open: bool,
    /// Whether lines bring their ends along, as those of a file do: then the last one may lack it, and is cut off.
    with_ends: bool,
}

impl Lines {
    fn new(lines: Bound<'_, PyIterator>) -> Self {
        Self { iterator: lines.unbind(), text: Vec::new(), read: 0, count: 0, open: false, with_ends: false }
    }

    fn read(&mut self, room: &mut [u8]) -> PyResult<usize> {
        if self.read == self.text.len() {
            self.text.clear();
            self.read = 0;
            Python::attach(|py| self.fetch(py))?;
        }
        let mut rest = self.text.get(self.read..).unwrap_or_default();
        // A slice can always be read.
        let read = rest.read(room).unwrap_or_default();
        self.read += read;
        Ok(read)
    }

    fn fetch(&mut self, py: Python<'_>) -> PyResult<()> {
        let mut lines = self.iterator.bind(py).clone();
        while self.text.len() < FETCHED {
            let Some(line) = lines.next() else {
                if self.open && !self.with_ends {
                    self.open = false;
                    self.text.push(b'\n');
                }
                return Ok(());
            };
            self.count += 1;
            self.add(&line?)?;
        }
        Ok(())
    }

    fn add(&mut self, line: &Bound<'_, PyAny>) -> PyResult<()> {
        if std::mem::take(&mut self.open) {
            self.text.push(b'\n');
        }
        if let Ok(bytes) = line.cast::<PyBytes>() {
            self.text.extend_from_slice(bytes.as_bytes());
        } else if let Some(text) = value::text(line) {
            self.text.extend_from_slice(text.as_bytes());
        } else {
            return Err(InputError::new_err(format!(
                "line {} of the log is {}; expected a str or bytes",
                self.count,
                value::shown(line)
            )));
        }
        self.open = self.text.last() != Some(&b'\n');
        self.with_ends |= !self.open;
        Ok(())
    }
}
