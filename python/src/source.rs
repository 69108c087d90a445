//! What a log can be read from: a file, bytes, or lines, one after the other.

use std::fs::File;
use std::io::{self, Cursor, Read};
use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};

use adsdv_formats::{Log, OpenError};
use adsdv_oracle::candump::{ReadError, Unit};
use adsdv_oracle::log::LogError;
use pyo3::exceptions::{PyOSError, PyTypeError};
use pyo3::prelude::*;
use pyo3::pybacked::PyBackedBytes;
use pyo3::types::{PyBytes, PyIterator};

use crate::error::{self, InputError};
use crate::value;

/// How many bytes are read before Python may interrupt: some hundredths of a second.
const UNINTERRUPTED: usize = 1 << 24;

/// How many bytes of lines are fetched from Python at a time.
const FETCHED: usize = 1 << 16;

/// The bytes of a log.
struct Source {
    kind: Kind,
    /// Bytes read since Python was asked whether to go on.
    unasked: usize,
    failure: Failure,
}

/// What Python itself had against reading a log.
type Failure = Arc<Mutex<Option<PyErr>>>;

/// Where a log comes from, for errors.
pub(crate) struct Origin {
    /// What to name: the path.
    name: Py<PyAny>,
    failure: Failure,
}

enum Kind {
    File(File),
    Bytes(Cursor<PyBackedBytes>),
    Lines(Lines),
}

/// Opens a log, whatever format it has.
pub(crate) fn open(log: &Bound<'_, PyAny>) -> PyResult<(Origin, Log)> {
    let py = log.py();
    let failure = Failure::default();
    let kind = Kind::of(log)?;
    let source = Source { kind, unasked: 0, failure: Arc::clone(&failure) };
    let origin = Origin { name: log.clone().unbind(), failure };
    match py.detach(|| adsdv_formats::open(source)) {
        Ok(log) => Ok((origin, log)),
        Err(OpenError::Read(source)) => {
            Err(origin.error(py, &LogError::Read(ReadError { unit: Unit::Line, line: 0, source })))
        }
        Err(OpenError::Foreign(foreign)) => Err(error::LogError::new_err(format!(
            "the log is {}, which is not read: {}",
            foreign.what, foreign.hint
        ))),
        Err(error @ OpenError::NotBuilt { .. }) => Err(error::LogError::new_err(error.to_string())),
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
        let failure = self.failure.lock().unwrap_or_else(PoisonError::into_inner).take();
        match (failure, error) {
            (Some(failure), _) => failure,
            (None, LogError::Read(read)) if read.source.raw_os_error().is_some() => {
                error::os_error(py, &read.source, self.name.bind(py))
            }
            (None, LogError::Read(_)) => PyOSError::new_err(error.to_string()),
            (None, _) => error::LogError::new_err(error.to_string()),
        }
    }
}

impl Source {
    fn fail(&self, error: PyErr) -> io::Error {
        *self.failure.lock().unwrap_or_else(PoisonError::into_inner) = Some(error);
        io::ErrorKind::Other.into()
    }
}

impl Read for Source {
    fn read(&mut self, room: &mut [u8]) -> io::Result<usize> {
        if self.unasked >= UNINTERRUPTED {
            self.unasked = 0;
            #[expect(
                clippy::redundant_closure_for_method_calls,
                reason = "the method alone is not general enough"
            )]
            if let Err(error) = Python::attach(|py| py.check_signals()) {
                return Err(self.fail(error));
            }
        }
        let read = match &mut self.kind {
            Kind::File(file) => file.read(room)?,
            Kind::Bytes(bytes) => bytes.read(room)?,
            Kind::Lines(lines) => match lines.read(room) {
                Ok(read) => read,
                Err(error) => return Err(self.fail(error)),
            },
        };
        self.unasked += read;
        Ok(read)
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
