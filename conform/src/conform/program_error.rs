//! Why a program could not be judged.

use std::fmt;
use std::io;
use std::time::Duration;

use super::options::{ConformProgress, Phase};
use crate::protocol::BadLine;

/// A program that does not keep to the protocol, so that there is no verdict. It displays as what is wrong, in one line,
/// and below that where, what was sent, what came, and what the program said on its standard error.
#[derive(Debug)]
pub struct ProgramError {
    /// Where; `None` before the first line and after the last.
    pub place: Option<Box<SentLine>>,
    /// What is wrong.
    pub what: ProgramErrorKind,
    /// The last lines of the program's standard error.
    pub stderr: Vec<String>,
}

/// The line of which the answer is wrong, or missing.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SentLine {
    /// The test, or the random scenario; empty where it is the hello before all of them.
    pub scenario: String,
    /// The step, from 1; 0 is the reset before the first.
    pub step: usize,
    /// The line that was sent.
    pub sent: String,
}

/// How far a program came.
#[derive(Clone, Copy, Debug)]
pub struct Work {
    /// What was being done, and how much of it was done.
    pub at: ConformProgress,
    /// The steps that it had made.
    pub steps: u64,
    /// The steps of the whole suite.
    pub suite_steps: u64,
    /// The random scenarios that it was to be asked for.
    pub runs: u32,
}

/// What is wrong. Lines of the program are as much of them as an error shows, without control characters.
#[derive(Debug)]
pub enum ProgramErrorKind {
    /// It cannot be started.
    NoStart(io::Error),
    /// It ended before it was asked everything.
    Ended(String),
    /// It closed its standard output, and went on.
    Closed,
    /// It did not answer in time; what had come of a line by then.
    Late(Duration, String),
    /// It answers, and is not done within the limit of all of it; how far it came.
    OutOfTime(Duration, Option<Work>),
    /// It wrote a line that does not end within so many bytes; how it begins.
    TooLong(usize, String),
    /// It wrote a line that is not UTF-8.
    NotText(String),
    /// It is of another edition than it was asked about, or says none.
    OtherEdition {
        /// The version that it was asked about.
        asked: String,
        /// What it says.
        said: Option<String>,
    },
    /// It answered a hello with something else than an object.
    NoHello(String, BadLine),
    /// What it says of itself cannot be so.
    NoAbout(String, BadLine),
    /// It answered a step with something else than outputs.
    NoAnswer(String, BadLine),
    /// It answered a reset with something else than an object, or with outputs.
    NoReset(String, Option<BadLine>),
    /// It wrote a line that nothing asked for, after the last answer.
    TooMany(String),
}

impl ProgramError {
    pub(super) fn new(what: ProgramErrorKind) -> Self {
        Self { place: None, what, stderr: Vec::new() }
    }

    /// The same with how far the program came, if that is what is wrong.
    pub(super) fn after(mut self, work: Work) -> Self {
        if let ProgramErrorKind::OutOfTime(_, done) = &mut self.what {
            *done = Some(work);
        }
        self
    }

    /// What to do, in one sentence.
    pub fn hint(&self) -> &'static str {
        const HELLO: &str = "a program of this edition answers the hello with it, as conform/PROTOCOL.md has it; for one of another edition name that with --edition";
        const ABOUT: &str = "say before the first answer only what conform/PROTOCOL.md has: \"inputs\", \"outputs\", \"cycle_ms\" and \"clock\", each as it is there; or leave it out";
        if let ProgramErrorKind::NoAbout(..) = self.what {
            return ABOUT;
        }
        if self.place.as_ref().is_some_and(|place| place.scenario.is_empty()) {
            return HELLO;
        }
        match &self.what {
            ProgramErrorKind::OtherEdition { .. } | ProgramErrorKind::NoHello(..) => HELLO,
            ProgramErrorKind::NoAbout(..) => ABOUT,
            ProgramErrorKind::NoStart(error) => match error.kind() {
                io::ErrorKind::NotFound => {
                    "check the path, and put what the program is started with before it, such as: adsdv conform -- python3 vcu.py"
                }
                io::ErrorKind::PermissionDenied => {
                    "make it executable (chmod +x), or start it with its interpreter"
                }
                _ => "start the program by hand, and type {\"op\":\"reset\"} to it",
            },
            ProgramErrorKind::Ended(_) => {
                "the program has to go on until the end of its input; give it the line above by hand to see why it ended"
            }
            ProgramErrorKind::Closed => {
                "keep standard output open until the end of input, and write nothing but answers to it"
            }
            ProgramErrorKind::Late(..) => {
                "answer every line as soon as it is read, and flush standard output after each; for a slow program raise --timeout"
            }
            ProgramErrorKind::OutOfTime(..) => {
                "raise --time-limit, or ask for less: --runs 0 leaves the random scenarios out; and see what the program waits for between a line and its answer"
            }
            ProgramErrorKind::TooLong(..) => {
                "end every answer with a line break, and write one JSON object a line"
            }
            ProgramErrorKind::NotText(_) => {
                "write answers in UTF-8, and nothing but answers; standard error is for everything else"
            }
            ProgramErrorKind::NoAnswer(line, _) if line.trim() == "{}" => {
                "show at least as_state; {} here means that a line before it was not answered, that what the program said of itself first has no key that there is, or that it is late: then say by how many steps with --latency"
            }
            ProgramErrorKind::NoAnswer(..) => {
                "answer a step with one JSON object, as conform/PROTOCOL.md has it, and write everything else to standard error"
            }
            ProgramErrorKind::NoReset(_, None) => {
                "answer a reset with {}; outputs here mean that a line before it was answered twice, or that a reset was taken for a step"
            }
            ProgramErrorKind::NoReset(_, Some(_)) => {
                "answer a reset with {}, and write everything else to standard error"
            }
            ProgramErrorKind::TooMany(_) => {
                "answer every line once, and write everything else to standard error"
            }
        }
    }
}

impl fmt::Display for ProgramError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { place, what, stderr } = self;
        write!(f, "{what}")?;
        if let Some(SentLine { scenario, step, sent }) = place.as_deref() {
            match step {
                _ if scenario.is_empty() => {}
                0 => write!(f, "\n  in        {scenario}, the reset")?,
                step => write!(f, "\n  in        {scenario}, step {step}")?,
            }
            write!(f, "\n  sent      {sent}")?;
        }
        if let Some(line) = what.line() {
            write!(f, "\n  received  {line}")?;
        }
        for line in stderr {
            write!(f, "\n  stderr    {line}")?;
        }
        Ok(())
    }
}

impl ProgramErrorKind {
    /// The line of the program that is wrong, or what had come of it; `None` where there is none.
    pub fn line(&self) -> Option<&String> {
        match self {
            Self::NotText(line)
            | Self::NoAnswer(line, _)
            | Self::NoReset(line, _)
            | Self::NoHello(line, _)
            | Self::NoAbout(line, _)
            | Self::TooMany(line)
            | Self::TooLong(_, line) => Some(line),
            Self::Late(_, unfinished) => Some(unfinished).filter(|unfinished| !unfinished.is_empty()),
            Self::NoStart(_)
            | Self::Ended(_)
            | Self::Closed
            | Self::OutOfTime(..)
            | Self::OtherEdition { .. } => None,
        }
    }
}

impl fmt::Display for Work {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { at: ConformProgress { phase, done, all }, steps, suite_steps, runs } = self;
        match phase {
            Phase::Suite => write!(
                f,
                "{done} of {all} tests ({steps} of {suite_steps} steps) were done, and 0 of {runs} random scenarios"
            ),
            Phase::Random => {
                write!(f, "all tests and {done} of {all} random scenarios ({steps} steps) were done")
            }
            Phase::Shrinking => write!(
                f,
                "tests fail, and shorter scenarios that fail were looked for ({steps} steps were done)"
            ),
        }
    }
}

impl fmt::Display for ProgramErrorKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoStart(error) => write!(f, "cannot start the program: {error}"),
            Self::Ended(how) => write!(f, "the program ended early ({how}); expected an answer"),
            Self::Closed => f.write_str("the program closed its standard output; expected an answer"),
            Self::Late(limit, unfinished) if !unfinished.is_empty() => {
                write!(f, "no end of the line within {} s; expected one line", limit.as_secs_f64())
            }
            Self::Late(limit, _) => {
                write!(f, "no answer within {} s; expected one line", limit.as_secs_f64())
            }
            Self::OutOfTime(limit, work) => {
                write!(f, "not done within the time limit of {} s", limit.as_secs_f64())?;
                work.map_or(Ok(()), |work| write!(f, ": {work}"))
            }
            Self::TooLong(limit, _) => {
                write!(f, "a line of more than {limit} bytes; expected a JSON object on one line")
            }
            Self::NotText(_) => f.write_str("a line that is not UTF-8; expected a JSON object on one line"),
            Self::OtherEdition { asked, said: Some(said) } => {
                write!(f, "the program is of edition {said}; expected {asked}")
            }
            Self::OtherEdition { asked, said: None } => {
                write!(
                    f,
                    "the program does not say that it is of edition {asked}; expected {{\"edition\":\"{asked}\"}}"
                )
            }
            Self::NoHello(_, why) => write!(f, "not the answer to a hello: {why}"),
            Self::NoAbout(_, why) => write!(f, "what it says of itself cannot be so: {why}"),
            Self::NoAnswer(_, why) => write!(f, "not the answer to a step: {why}"),
            Self::NoReset(_, Some(why)) => write!(f, "not the answer to a reset: {why}"),
            Self::NoReset(_, None) => f.write_str("not the answer to a reset: outputs; expected {}"),
            Self::TooMany(_) => f.write_str("an answer too many; expected nothing after the last"),
        }
    }
}

impl std::error::Error for ProgramError {}

/// As much of the program's own text as an error shows, fit for a terminal.
pub fn excerpt(bytes: &[u8]) -> String {
    const SHOWN: usize = 200;
    let text = String::from_utf8_lossy(bytes.get(..SHOWN * 4).unwrap_or(bytes));
    let line = text.trim_end_matches(['\r', '\n']);
    let mut shown: String = line
        .chars()
        .take(SHOWN)
        .flat_map(|c| if c.is_control() { c.escape_default().collect() } else { vec![c] })
        .collect();
    if line.chars().nth(SHOWN).is_some() || bytes.len() > SHOWN * 4 {
        shown.push_str("...");
    }
    shown
}

#[cfg(test)]
mod tests {
    use super::excerpt;

    #[test]
    fn as_much_as_fits_is_shown_and_nothing_that_moves_the_cursor() {
        assert_eq!(excerpt(b"one\ttwo\x1b[2J\r\n"), "one\\ttwo\\u{1b}[2J");
        assert_eq!(excerpt(b"\xFFx"), "\u{FFFD}x");
        // Letters of one byte, of two and of four.
        for letter in ["x", "\u{E4}", "\u{1F3CE}"] {
            let (fits, more) = (letter.repeat(200), letter.repeat(201));
            assert_eq!(excerpt(fits.as_bytes()), fits);
            assert_eq!(excerpt(more.as_bytes()), fits + "...");
        }
        assert_eq!(excerpt(&[b'\n'; 900]), "...");
    }
}
