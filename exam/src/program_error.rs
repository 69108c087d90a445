//! Why a stack could not be examined.

use std::fmt;
use std::io;

use adsdv_conform::ProgramErrorKind;

/// A stack that does not keep to the protocol, so that there is no verdict. It displays as what is wrong, in one line, and below
/// that where, what was sent, what came, and what the program said on its standard error.
#[derive(Debug)]
pub struct StackError {
    /// Where; `None` before the first line and after the last.
    pub place: Option<Box<StackErrorPlace>>,
    /// What is wrong.
    pub what: StackErrorKind,
    /// The last lines of its standard error.
    pub stderr: Vec<String>,
}

/// The line whose answer is wrong or missing.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct StackErrorPlace {
    /// The scenario; empty before the first.
    pub scenario: String,
    /// The time in it, in milliseconds.
    pub time_ms: u64,
    /// What was sent; empty where nothing was.
    pub sent: String,
}

/// What is wrong. Lines of the program are as much of them as an error shows, without control characters.
#[derive(Debug)]
pub enum StackErrorKind {
    /// What can be wrong with any program: it does not start, it ends, or no line comes in time.
    Program(ProgramErrorKind),
    /// It is of another edition than it was asked about, or says none.
    OtherEdition {
        /// The version that it was asked about.
        asked: String,
        /// What it says.
        said: Option<String>,
    },
    /// It is in this process, and failed instead of an answer: that ends its scenario, and is a finding there.
    Failed(Failure),
    /// The user has stopped the exam.
    Stopped,
    /// It answered with something that is no answer to what was asked.
    NoAnswer {
        /// What it was asked: `hello`, `reset` or `step`.
        to: &'static str,
        /// The line.
        line: String,
        /// What is wrong with it.
        why: String,
    },
}

/// What a stack in this process did instead of an answer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Failure {
    /// What was seen, in one line.
    pub why: String,
    /// Where in the stack, in its own words, which may be many lines.
    pub trace: Option<String>,
    /// What was expected instead.
    pub expected: &'static str,
}

impl From<ProgramErrorKind> for StackErrorKind {
    fn from(what: ProgramErrorKind) -> Self {
        Self::Program(what)
    }
}

impl StackError {
    /// An error without a place.
    pub fn new(what: impl Into<StackErrorKind>) -> Self {
        Self { place: None, what: what.into(), stderr: Vec::new() }
    }

    /// The same in a scenario.
    pub(crate) fn during(self, scenario: &str, time_ms: u64) -> Self {
        let sent = self.place.map(|place| place.sent).unwrap_or_default();
        let place = StackErrorPlace { scenario: scenario.to_owned(), time_ms, sent };
        Self { place: Some(Box::new(place)), ..self }
    }

    /// What to do, in one sentence.
    pub fn hint(&self) -> &'static str {
        match &self.what {
            StackErrorKind::Program(ProgramErrorKind::NoStart(error)) => match error.kind() {
                io::ErrorKind::NotFound => {
                    "check the path, and put what the program is started with before it, such as: adsdv exam --stdio -- python3 stack.py"
                }
                io::ErrorKind::PermissionDenied => {
                    "make it executable (chmod +x), or start it with its interpreter"
                }
                _ => "start the program by hand, and type {\"op\":\"reset\"} to it",
            },
            StackErrorKind::Program(ProgramErrorKind::Ended(_) | ProgramErrorKind::Closed) => {
                "a program is asked until its input ends; start it by hand, and type to it what was sent last"
            }
            StackErrorKind::Program(ProgramErrorKind::OutOfTime(..)) => {
                "raise --time-limit, or ask for less with --only; and see what the program waits for between a line and its answer"
            }
            StackErrorKind::Program(ProgramErrorKind::TooLong(..)) => {
                "end every answer with a line break, and write one JSON object a line"
            }
            StackErrorKind::Program(ProgramErrorKind::TooMany(_)) => {
                "answer every line once, and write everything else to standard error"
            }
            StackErrorKind::Program(_) => {
                "answer every line as soon as it is read, and flush standard output after each; for a slow program raise --timeout"
            }
            StackErrorKind::Failed(_) => "see what the stack does there",
            StackErrorKind::Stopped => "hold the exam again",
            StackErrorKind::OtherEdition { .. } => {
                "answer the hello with the edition that the stack speaks, and name that one with --edition"
            }
            StackErrorKind::NoAnswer { .. } => {
                "answer as exam/PROTOCOL.md has it, and write everything else to standard error"
            }
        }
    }
}

impl fmt::Display for StackErrorKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Program(what) => write!(f, "{what}"),
            Self::Failed(Failure { why, expected, .. }) => write!(f, "{why}; expected {expected}"),
            Self::Stopped => f.write_str("the exam was stopped"),
            Self::OtherEdition { asked, said: Some(said) } => {
                write!(f, "the program is of edition {said}; expected {asked}")
            }
            Self::OtherEdition { asked, said: None } => write!(
                f,
                "the program does not say that it is of edition {asked}; expected {{\"edition\":\"{asked}\"}}"
            ),
            Self::NoAnswer { to, why, .. } => write!(f, "not the answer to a {to}: {why}"),
        }
    }
}

impl fmt::Display for StackError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { place, what, stderr } = self;
        write!(f, "{what}")?;
        if let Some(StackErrorPlace { scenario, time_ms, sent }) = place.as_deref() {
            if !scenario.is_empty() {
                write!(f, "\n  in        {scenario}, at {}.{:03} s", time_ms / 1000, time_ms % 1000)?;
            }
            if !sent.is_empty() {
                write!(f, "\n  sent      {sent}")?;
            }
        }
        let line = match what {
            StackErrorKind::Program(what) => what.line(),
            StackErrorKind::NoAnswer { line, .. } => Some(line),
            StackErrorKind::OtherEdition { .. } | StackErrorKind::Failed(_) | StackErrorKind::Stopped => None,
        };
        if let Some(line) = line {
            write!(f, "\n  received  {line}")?;
        }
        stderr.iter().try_for_each(|line| write!(f, "\n  stderr    {line}"))
    }
}

impl std::error::Error for StackError {}
