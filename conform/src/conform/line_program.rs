//! A program that is asked in lines and answers in lines, whatever these say.

use std::ffi::OsString;
use std::thread;
use std::time::{Duration, Instant};

use super::child::{Ended, Process};
use super::chunks::Chunks;
use super::lines::{LineBuffer, Lines, Missing};
use super::program_error::{ProgramErrorKind, excerpt};
use super::questions::Questions;
use super::stderr::LastWords;

/// How long a program may take to end when its input has, whatever it may take to answer.
const FAREWELL: Duration = Duration::from_secs(1);

/// A child process that is written lines and read lines from. It is killed, with everything that it started, when it is dropped.
///
/// Whatever it does, nobody waits for it without end: for a line it has a time, and for all of them if that is
/// [said](Self::within); a line has a [length](LineBuffer::LONGEST).
#[derive(Debug)]
pub struct LineProgram {
    // The order matters: the process is gone before anything else is dropped.
    process: Process,
    /// `None` after the end of its input.
    questions: Option<Questions>,
    lines: Lines,
    last_words: LastWords,
    timeout: Duration,
    /// Since when it runs, and how long it may take for all of it.
    limit: Option<(Instant, Duration)>,
}

impl LineProgram {
    /// Starts a program that has `timeout` for each line.
    ///
    /// # Errors
    ///
    /// [`ProgramErrorKind::NoStart`] if the system cannot start it.
    pub fn start(program: &OsString, args: &[OsString], timeout: Duration) -> Result<Self, ProgramErrorKind> {
        let started = Process::start(program, args);
        let (process, (stdin, stdout, stderr)) = started.map_err(ProgramErrorKind::NoStart)?;
        let (lines, last_words) = (Lines::of(Chunks::of(stdout)), LastWords::of(stderr));
        let questions = Some(Questions::of(stdin));
        Ok(Self { process, questions, lines, last_words, timeout, limit: None })
    }

    /// With a limit, from now on, for all that it is asked: one that is slow, and never too slow for an answer, ends as well.
    #[must_use]
    pub fn within(self, limit: Duration) -> Self {
        Self { limit: Some((Instant::now(), limit)), ..self }
    }

    /// How long it may take for the next answer; an error if the time for all of them is over.
    fn patience(&self) -> Result<Duration, ProgramErrorKind> {
        let Some((start, limit)) = self.limit else { return Ok(self.timeout) };
        let left = limit.saturating_sub(start.elapsed());
        if left.is_zero() {
            Err(ProgramErrorKind::OutOfTime(limit, None))
        } else {
            Ok(left.min(self.timeout))
        }
    }

    /// Writes lines, each with its line feed. Nobody waits until they are read.
    pub fn write(&self, lines: Vec<u8>) {
        if let Some(questions) = &self.questions {
            questions.write(lines);
        }
    }

    /// The next line, without its line feed.
    ///
    /// # Errors
    ///
    /// Fails if it does not come in time, is too long, or the program has ended or closed its output.
    pub fn line(&mut self) -> Result<&[u8], ProgramErrorKind> {
        let patience = self.patience()?;
        let process = &mut self.process;
        match self.lines.next(patience, || process.ended().is_some()) {
            Ok(line) => Ok(self.lines.get(line)),
            // It is not the answer that is late.
            Err(Missing::Late) if patience < self.timeout => {
                Err(ProgramErrorKind::OutOfTime(self.limit.map_or(patience, |(_, limit)| limit), None))
            }
            Err(Missing::Late) => Err(ProgramErrorKind::Late(self.timeout, excerpt(self.lines.rest()))),
            Err(Missing::TooLong) => {
                Err(ProgramErrorKind::TooLong(LineBuffer::LONGEST, excerpt(self.lines.rest())))
            }
            Err(Missing::End) => Err(self.gone()),
        }
    }

    /// The last lines of its standard error.
    pub fn last_words(&self) -> Vec<String> {
        self.last_words.lines()
    }

    /// What it is that has no more lines. A program that has just closed its output may be about to end.
    fn gone(&mut self) -> ProgramErrorKind {
        match self.wait(Duration::from_millis(200)) {
            Some(ended) => ProgramErrorKind::Ended(ended.how),
            None => ProgramErrorKind::Closed,
        }
    }

    /// Waits for the end of the program.
    fn wait(&mut self, limit: Duration) -> Option<Ended> {
        let start = Instant::now();
        loop {
            let ended = self.process.ended();
            if ended.is_some() || start.elapsed() >= limit {
                return ended;
            }
            thread::sleep(Duration::from_millis(2));
        }
    }

    /// Ends its input, and gives it a moment to end; what is worth a note of how it did. One that does not is killed when it is
    /// dropped; that is no trouble.
    ///
    /// # Errors
    ///
    /// Fails if it wrote a line that nothing asked for.
    pub fn end(&mut self) -> Result<Vec<String>, ProgramErrorKind> {
        self.questions = None;
        let start = Instant::now();
        let process = &mut self.process;
        let rest = self.lines.next(FAREWELL, || process.ended().is_some());
        let unasked = match rest {
            Ok(line) => self.lines.get(line),
            Err(_) => self.lines.rest(),
        };
        if !unasked.trim_ascii().is_empty() {
            return Err(ProgramErrorKind::TooMany(excerpt(unasked)));
        }
        Ok(match self.wait(FAREWELL.saturating_sub(start.elapsed())) {
            Some(ended) if ended.well => Vec::new(),
            Some(ended) => {
                vec![format!("at the end of its input the program ended with {}; expected 0", ended.how)]
            }
            None => vec!["the program did not end at the end of its input, and was killed".to_owned()],
        })
    }
}
