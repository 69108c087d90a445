//! What is examined: a stack in Python, or a program.

use std::ffi::OsString;
use std::path::PathBuf;

use adsdv_conform::ProgramErrorKind;
use adsdv_exam::{Failure, MAX_FRAMES, Stack, StackError, StackErrorKind, StdioStack};
use adsdv_spec::Edition;
use adsdv_spec::messages::Frame;
use pyo3::exceptions::PyException;
use pyo3::intern;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyList, PyTuple};

use super::options::Options;
use crate::error::{self, StackError as PyStackError};
use crate::value;

/// What a step returns.
const FRAMES: &str =
    "a list of the frames that it sends, each an (identifier, data), and [] where it sends nothing";
/// What a frame is.
const FRAME: &str = "an (identifier, data), with an identifier from 0 to 0x7FF and data of up to 8 bytes";

/// What somebody wants to be examined.
pub(super) enum Given {
    /// What makes a stack.
    Python(Py<PyAny>),
    /// A program and its arguments.
    Program(OsString, Vec<OsString>),
}

impl Given {
    pub(super) fn of(stack: &Bound<'_, PyAny>) -> PyResult<Self> {
        const EXPECTED: &str = "what makes a stack, such as its class, or a program with its arguments, such as [\"python3\", \"stack.py\"]";
        if stack.is_instance_of::<PyList>() || stack.is_instance_of::<PyTuple>() {
            // Not bytes, and no bool: a path is a str or has one.
            let words: Option<Vec<OsString>> = stack
                .try_iter()?
                .map(|word| Some(word.ok()?.extract::<PathBuf>().ok()?.into_os_string()))
                .collect();
            if let Some((program, args)) = words.as_deref().and_then(<[OsString]>::split_first) {
                return Ok(Self::Program(program.clone(), args.to_vec()));
            }
        } else if stack.is_callable() {
            return Ok(Self::Python(stack.clone().unbind()));
        } else if stack.hasattr(intern!(stack.py(), "step"))? {
            return Err(value::refused(
                "stack",
                stack,
                "what makes it afresh for each scenario, such as its class, or lambda: MyStack(1)",
            ));
        }
        Err(value::refused("stack", stack, EXPECTED))
    }

    /// The program and its arguments; empty where none is started.
    pub(super) fn words(&self) -> Vec<String> {
        match self {
            Self::Python(_) => Vec::new(),
            Self::Program(program, args) => {
                [program].into_iter().chain(args).map(|word| word.to_string_lossy().into_owned()).collect()
            }
        }
    }

    pub(super) fn start(&self, options: &Options) -> Result<UnderTest, StackError> {
        let kind = match self {
            Self::Python(factory) => {
                Way::Python { factory: Python::attach(|py| factory.clone_ref(py)), step: None }
            }
            Self::Program(program, args) => {
                Way::Program(StdioStack::start(program, args, options.timeout, options.time_limit)?)
            }
        };
        Ok(UnderTest { kind, raised: None })
    }
}

/// A stack that is examined.
pub(super) struct UnderTest {
    kind: Way,
    /// What ends the exam, such as a `KeyboardInterrupt`.
    raised: Option<PyErr>,
}

enum Way {
    Python {
        factory: Py<PyAny>,
        /// What is called at each step of this scenario.
        step: Option<Py<PyAny>>,
    },
    Program(StdioStack),
}

impl UnderTest {
    /// What has ended the exam, if Python has.
    pub(super) fn raised(&mut self) -> Option<PyErr> {
        self.raised.take()
    }

    /// Ends the exam if somebody has pressed Ctrl-C: a stack that is no Python would never learn of it.
    fn may_go_on(&mut self, py: Python<'_>) -> Result<(), StackError> {
        py.check_signals().map_err(|error| Self::ends(&mut self.raised, error))
    }

    fn ends(raised: &mut Option<PyErr>, error: PyErr) -> StackError {
        *raised = Some(error);
        StackError::new(StackErrorKind::Stopped)
    }

    /// What is not well with a stack: an `Exception` is a finding, and everything else ends the exam.
    fn wrong(raised: &mut Option<PyErr>, py: Python<'_>, wrong: Wrong) -> StackError {
        match wrong {
            Wrong::Raised(error) if error.is_instance_of::<PyException>(py) => {
                let why = format!("the stack raised {}", named(py, &error));
                let expected = "no exception";
                StackError::new(StackErrorKind::Failed(Failure { why, trace: trace(py, &error), expected }))
            }
            Wrong::Raised(error) => Self::ends(raised, error),
            Wrong::Said { why, expected } => {
                StackError::new(StackErrorKind::Failed(Failure { why, trace: None, expected }))
            }
        }
    }
}

/// What can be wrong with a stack in Python.
enum Wrong {
    Raised(PyErr),
    Said { why: String, expected: &'static str },
}

impl From<PyErr> for Wrong {
    fn from(error: PyErr) -> Self {
        Self::Raised(error)
    }
}

impl Stack for UnderTest {
    fn hello(&mut self, edition: &Edition) -> Result<(), StackError> {
        match &mut self.kind {
            Way::Python { .. } => Ok(()),
            Way::Program(program) => program.hello(edition),
        }
    }

    fn reset(&mut self) -> Result<(), StackError> {
        let Self { kind, raised } = self;
        match kind {
            Way::Program(program) => program.reset(),
            Way::Python { factory, step } => Python::attach(|py| {
                // The one of the scenario before is gone before there is another.
                *step = None;
                match made(factory.bind(py)) {
                    Ok(made) => {
                        *step = Some(made);
                        Ok(())
                    }
                    Err(wrong) => Err(Self::wrong(raised, py, wrong)),
                }
            }),
        }
    }

    fn step(&mut self, time_ms: u64, frames: &[Frame]) -> Result<Vec<Frame>, StackError> {
        Python::attach(|py| self.may_go_on(py))?;
        let Self { kind, raised } = self;
        match kind {
            Way::Program(program) => program.step(time_ms, frames),
            Way::Python { step, .. } => Python::attach(|py| {
                // A stack that could not be made has ended its scenario.
                let Some(step) = step else { return Ok(Vec::new()) };
                asked(step.bind(py), time_ms, frames).map_err(|wrong| Self::wrong(raised, py, wrong))
            }),
        }
    }

    fn end(&mut self) -> Result<Vec<String>, StackError> {
        match &mut self.kind {
            Way::Python { .. } => Ok(Vec::new()),
            Way::Program(program) => program.end(),
        }
    }
}

/// What is called at each step of a stack that is made now.
fn made(factory: &Bound<'_, PyAny>) -> Result<Py<PyAny>, Wrong> {
    let stack = factory.call0()?;
    let step = stack.getattr_opt(intern!(stack.py(), "step"))?.unwrap_or_else(|| stack.clone());
    if step.is_callable() {
        return Ok(step.unbind());
    }
    Err(Wrong::Said {
        why: format!("what makes the stack returned {}", value::shown(&stack)),
        expected: "a stack, which has a method step(t_ms, frames), or is a function of these",
    })
}

fn asked(step: &Bound<'_, PyAny>, time_ms: u64, frames: &[Frame]) -> Result<Vec<Frame>, Wrong> {
    let py = step.py();
    let came = PyList::empty(py);
    for frame in frames {
        came.append((frame.id, PyBytes::new(py, frame.data())))?;
    }
    let sent = step.call1((time_ms, came))?;
    let Ok(items) = sent.try_iter() else {
        return Err(Wrong::Said {
            why: format!("the stack returned {}", value::shown(&sent)),
            expected: FRAMES,
        });
    };
    let mut frames = Vec::new();
    for item in items {
        let item = item?;
        if frames.len() == MAX_FRAMES {
            return Err(Wrong::Said {
                why: format!("the stack sends more than {MAX_FRAMES} frames in 10 ms"),
                expected: "each of its messages once",
            });
        }
        let Some(frame) = frame(&item) else {
            return Err(Wrong::Said {
                why: format!("the stack sends {}", value::shown(&item)),
                expected: FRAME,
            });
        };
        frames.push(frame);
    }
    Ok(frames)
}

/// A frame of an (identifier, data).
fn frame(item: &Bound<'_, PyAny>) -> Option<Frame> {
    if !(item.is_instance_of::<PyTuple>() || item.is_instance_of::<PyList>()) || item.len().ok()? != 2 {
        return None;
    }
    let (id, data) = (item.get_item(0).ok()?, item.get_item(1).ok()?);
    Frame::new(value::id(&id).ok()?, &value::data(&data).ok()?)
}

/// An exception in one line.
fn named(py: Python<'_>, error: &PyErr) -> String {
    const LIMIT: usize = 200;
    let name = error.get_type(py).name().map_or_else(|_| "an exception".to_owned(), |name| name.to_string());
    let text = error.value(py).str().ok().and_then(|text| value::text(text.as_any())).unwrap_or_default();
    let line: String =
        text.lines().next().unwrap_or_default().chars().filter(|one| !one.is_control()).take(LIMIT).collect();
    if line.is_empty() { name } else { format!("{name}: {line}") }
}

/// Where it was raised, as Python prints it.
fn trace(py: Python<'_>, error: &PyErr) -> Option<String> {
    let parts = (error.get_type(py), error.value(py), error.traceback(py));
    let lines = py.import(intern!(py, "traceback")).ok()?.call_method1("format_exception", parts).ok()?;
    lines.extract::<Vec<String>>().ok().map(|lines| lines.concat())
}

/// Why a program has no verdict.
pub(super) fn error(py: Python<'_>, error: &StackError, stack: &Bound<'_, PyAny>) -> PyErr {
    if let StackErrorKind::Program(ProgramErrorKind::NoStart(error)) = &error.what {
        return match stack.get_item(0) {
            Ok(program) => error::os_error(py, error, &program),
            Err(error) => error,
        };
    }
    // The hints are the command's, which has options where Python has keywords.
    let hint = error.hint().replace("--time-limit", "time_limit").replace("--", "");
    PyStackError::new_err(format!("{error}\n  hint      {hint}"))
}
