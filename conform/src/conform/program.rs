//! A program under test: started once, asked line by line, many lines ahead.

use std::collections::HashMap;
use std::ffi::OsString;
use std::io::Write as _;
use std::sync::Arc;
use std::thread;
use std::time::{Duration, Instant};

use adsdv_spec::{Edition, Inputs};

use super::line_program::LineProgram;
use super::program_error::{ProgramError, ProgramErrorKind, SentLine};
use super::vcu::{Reply, Vcu};
use super::wall_clock::{PATIENCE, TRIED, TRIES, Taken};
use crate::protocol::{About, Answer, Protocol, Request, UNSAID};
use crate::suite::{Scenario, Step};

/// So many lines are sent before the answer to the first of them has come.
const AHEAD: usize = 4096;
/// So many lines of answers are kept at most, each with what it says: nearly all are the same as one before.
const KEPT: usize = 10_000;
/// No longer line is kept, in bytes: all outputs take less than half as many.
const LONGEST_KEPT: usize = 4096;
/// What is asked by none of the scenarios.
const DIAGNOSIS: &str = "the diagnosis";

/// A child process that speaks the protocol. It is killed, with everything that it started, when it is dropped.
#[derive(Debug)]
pub struct Program {
    lines: LineProgram,
    /// Whether `{}` is an answer to a step.
    late: bool,
    /// What its answers may say.
    protocol: Arc<Protocol>,
    /// What its answers said.
    read: HashMap<Box<[u8]>, Answer>,
    /// Whether it has just been reset, and nothing was asked since.
    is_reset: bool,
    /// Since when its last step lasts, if its time is that of a clock on the wall.
    clock: Option<Instant>,
    /// Whether each step of the last scenario lasted, by that clock, as long as the tests allow for.
    told: bool,
    /// How often a scenario is tried that was not told.
    tries: usize,
}

impl Program {
    /// Starts a program that has `timeout` for each answer. One that is `late` may answer `{}` to a step.
    ///
    /// # Errors
    ///
    /// [`ProgramErrorKind::NoStart`](super::ProgramErrorKind::NoStart) if the system cannot start it.
    pub fn start(
        program: &OsString,
        args: &[OsString],
        timeout: Duration,
        late: bool,
    ) -> Result<Self, ProgramError> {
        let lines = LineProgram::start(program, args, timeout).map_err(ProgramError::new)?;
        let protocol = Arc::new(Protocol::of(UNSAID));
        Ok(Self {
            lines,
            late,
            protocol,
            read: HashMap::new(),
            is_reset: false,
            clock: None,
            told: true,
            tries: TRIES,
        })
    }

    /// With a limit, from now on, for all that it is asked: one that is slow, and never too slow for an answer, ends as well.
    #[must_use]
    pub fn within(self, limit: Duration) -> Self {
        Self { lines: self.lines.within(limit), ..self }
    }

    /// Power on, and waits for the answer; for who asks one thing after the other, each by the answer before.
    ///
    /// # Errors
    ///
    /// Fails if no answer comes in time, or what comes is none.
    pub fn reset(&mut self) -> Result<(), ProgramError> {
        if std::mem::take(&mut self.is_reset) {
            return Ok(());
        }
        self.asked(&Request::Reset, |program| Reply::to_reset(program.lines.line()?))
    }

    /// One step, and waits for its answer.
    ///
    /// # Errors
    ///
    /// Fails if no answer comes in time, or what comes shows no outputs.
    pub fn step(&mut self, dt_ms: u32, inputs: &Inputs) -> Result<Answer, ProgramError> {
        let inputs = *inputs;
        self.asked(&Request::Step { dt_ms, inputs }, |program| match program.reply(false)? {
            Reply::Answer(answer) => Ok(answer),
            Reply::Nothing => Err(ProgramErrorKind::Closed),
        })
    }

    /// Power on and steps, all of which are sent before the first answer has to come.
    ///
    /// # Errors
    ///
    /// Fails if an answer does not come in time, or what comes shows no outputs.
    pub fn steps(&mut self, steps: &[Step]) -> Result<Vec<Answer>, ProgramError> {
        let scenario = Scenario { steps: steps.to_vec() };
        let mut replies = Vec::new();
        self.ask(&[(DIAGNOSIS, &scenario)], &mut |_, all| replies = all.to_vec())?;
        let answer = |(place, reply)| match reply {
            Reply::Answer(answer) => Ok(answer),
            Reply::Nothing => Err(self.trouble(ProgramErrorKind::Closed, DIAGNOSIS, &scenario, place + 1)),
        };
        replies.into_iter().enumerate().map(answer).collect()
    }

    fn asked<T>(
        &mut self,
        request: &Request,
        read: impl FnOnce(&mut Self) -> Result<T, ProgramErrorKind>,
    ) -> Result<T, ProgramError> {
        let sent = self.protocol.line(request).to_string();
        self.lines.write(format!("{sent}\n").into_bytes());
        read(self).map_err(|what| {
            let place = Some(Box::new(SentLine { scenario: DIAGNOSIS.to_owned(), step: 1, sent }));
            ProgramError { place, what, stderr: self.lines.last_words() }
        })
    }

    /// The answer to a step. Of a program that is `late` it may be that there is nothing to show yet.
    fn reply(&mut self, late: bool) -> Result<Reply, ProgramErrorKind> {
        let line = self.lines.line()?;
        if let Some(answer) = self.read.get(line) {
            return Ok(Reply::Answer(*answer));
        }
        let reply = Reply::to_step(line, late, &self.protocol)?;
        if let Reply::Answer(answer) = reply
            && line.len() <= LONGEST_KEPT
        {
            if self.read.len() == KEPT {
                self.read.clear();
            }
            self.read.insert(line.into(), answer);
        }
        Ok(reply)
    }

    /// Waits until this time has passed since the last step, if that is what the program goes by.
    fn wait_for(&mut self, dt_ms: u32) {
        let Some(since) = self.clock else { return };
        let due = since + Duration::from_millis(dt_ms.into()) + PATIENCE;
        thread::sleep(due.saturating_duration_since(Instant::now()));
        self.clock = Some(Instant::now());
    }

    /// Steps through one scenario, each step by the answer to the one before.
    fn once_in_turn(
        &mut self,
        name: &str,
        next: &mut dyn FnMut(usize, Option<&Reply>) -> Option<Step>,
    ) -> Result<Vec<Reply>, ProgramError> {
        let protocol = Arc::clone(&self.protocol);
        let mut scenario = Scenario::default();
        let mut replies = Vec::new();
        let written = Instant::now();
        // One that goes by a clock has waited since.
        if !std::mem::take(&mut self.is_reset) || self.clock.is_some() {
            self.lines.write(format!("{}\n", protocol.line(&Request::Reset)).into_bytes());
            let reset = self.lines.line().and_then(Reply::to_reset);
            reset.map_err(|what| self.trouble(what, name, &scenario, 0))?;
        }
        self.clock = self.clock.map(|_| Instant::now());
        self.told = true;
        let mut before = Taken { written, answered: Instant::now() };
        while let Some(step) = next(replies.len(), replies.last()) {
            scenario.steps.push(step);
            self.wait_for(step.dt_ms);
            let request = Request::Step { dt_ms: step.dt_ms, inputs: step.inputs };
            let written = Instant::now();
            self.lines.write(format!("{}\n", protocol.line(&request)).into_bytes());
            let reply = self.reply(self.late);
            replies.push(reply.map_err(|what| self.trouble(what, name, &scenario, replies.len() + 1))?);
            let taken = Taken { written, answered: Instant::now() };
            self.told &= Taken::is_told(std::mem::replace(&mut before, taken), taken, step.dt_ms);
        }
        Ok(replies)
    }

    /// The first reset, before which a program may say something of itself.
    fn first_reset(&mut self) -> Result<Option<About>, ProgramErrorKind> {
        let protocol = Arc::clone(&self.protocol);
        self.lines.write(format!("{}\n", protocol.line(&Request::Reset)).into_bytes());
        let line = self.lines.line()?.to_vec();
        let about = Reply::about(&line, &protocol)?;
        Reply::to_reset(if about.is_some() { self.lines.line()? } else { &line })?;
        self.is_reset = true;
        Ok(about)
    }

    /// Writes all lines of a scenario, but for so many at its beginning; how many are answered.
    fn send(&self, scenario: &Scenario, written: usize) -> usize {
        let mut lines = Vec::with_capacity(64 * (scenario.steps.len() + 1));
        for request in scenario.requests().skip(written) {
            // Writing to memory does not fail.
            let _ = writeln!(lines, "{}", self.protocol.line(&request));
        }
        self.lines.write(lines);
        scenario.steps.len() + 1 - written
    }

    /// What is wrong with the answer to a step of a scenario, or with that to the reset before it.
    fn trouble(&self, what: ProgramErrorKind, name: &str, scenario: &Scenario, step: usize) -> ProgramError {
        let sent = scenario.requests().nth(step).map(|request| self.protocol.line(&request).to_string());
        let sent = sent.unwrap_or_default();
        let place = Some(Box::new(SentLine { scenario: name.to_owned(), step, sent }));
        ProgramError { place, what, stderr: self.lines.last_words() }
    }
}

impl Vcu for Program {
    /// One that is asked about [`UNSAID`] gets no hello: so programs that know no hello are judged as they always were.
    fn hello(&mut self, edition: &Edition) -> Result<About, ProgramError> {
        self.protocol = Arc::new(Protocol::of(edition));
        self.read.clear();
        let protocol = Arc::clone(&self.protocol);
        let mut about = None;
        if edition.version != UNSAID.version {
            let sent = Request::Hello { edition: edition.version.to_owned() }.to_string();
            self.lines.write(format!("{sent}\n").into_bytes());
            let answered = self.lines.line().and_then(|line| {
                let answer = Reply::to_hello(line, edition);
                // What it says of itself beside another edition is of that one.
                let of_another = matches!(&answer, Err(ProgramErrorKind::OtherEdition { said: Some(_), .. }));
                let about = if of_another { None } else { Reply::about(line, &protocol)? };
                Ok((about, answer))
            });
            let answered = answered.and_then(|(said, answer)| {
                about = said;
                match answer {
                    // It says something of itself before it answers.
                    Err(_) if about.is_some() => {
                        self.lines.line().and_then(|line| Reply::to_hello(line, edition))
                    }
                    answer => answer,
                }
            });
            answered.map_err(|what| {
                let place = Some(Box::new(SentLine { scenario: String::new(), step: 0, sent }));
                ProgramError { place, what, stderr: self.lines.last_words() }
            })?;
        }
        let first = self.first_reset().map_err(|what| {
            let sent = Request::Reset.to_string();
            let place = Some(Box::new(SentLine { scenario: "the beginning".to_owned(), step: 0, sent }));
            ProgramError { place, what, stderr: self.lines.last_words() }
        })?;
        let about = about.or(first).unwrap_or_default();
        self.clock = about.wall_clock.then(Instant::now);
        Ok(about)
    }

    fn ask(
        &mut self,
        scenarios: &[(&str, &Scenario)],
        answered: &mut dyn FnMut(usize, &[Reply]),
    ) -> Result<(), ProgramError> {
        if self.clock.is_some() {
            for (place, (name, scenario)) in scenarios.iter().enumerate() {
                let mut step = |place: usize, _: Option<&Reply>| scenario.steps.get(place).copied();
                let replies = self.ask_in_turn(name, &mut step)?;
                answered(place, &replies);
            }
            return Ok(());
        }
        let mut to_send = scenarios.iter();
        let mut in_flight = 0;
        let mut replies = Vec::new();
        // The first of all was reset already.
        let mut to_write = usize::from(!scenarios.is_empty() && std::mem::take(&mut self.is_reset));
        let mut to_read = to_write;
        for (place, (name, scenario)) in scenarios.iter().enumerate() {
            // This one at least has been sent when its answers are waited for: it is the first of those in flight.
            while in_flight < AHEAD {
                let Some((_, next)) = to_send.next() else { break };
                in_flight += self.send(next, std::mem::take(&mut to_write));
            }
            if std::mem::take(&mut to_read) == 0 {
                let reset = self.lines.line().and_then(Reply::to_reset);
                reset.map_err(|what| self.trouble(what, name, scenario, 0))?;
                in_flight -= 1;
            }
            replies.clear();
            for step in 1..=scenario.steps.len() {
                let reply = self.reply(self.late);
                replies.push(reply.map_err(|what| self.trouble(what, name, scenario, step))?);
            }
            in_flight -= scenario.steps.len();
            answered(place, &replies);
        }
        Ok(())
    }

    /// One that goes by a clock is asked again while that did not tell its time.
    fn ask_in_turn(
        &mut self,
        name: &str,
        next: &mut dyn FnMut(usize, Option<&Reply>) -> Option<Step>,
    ) -> Result<Vec<Reply>, ProgramError> {
        let began = Instant::now();
        let mut replies = self.once_in_turn(name, next)?;
        if self.clock.is_some() {
            for _ in 1..self.tries {
                if self.told || began.elapsed() > TRIED {
                    break;
                }
                replies = self.once_in_turn(name, next)?;
            }
            if !self.told {
                self.tries = (self.tries / 2).max(1);
            }
        }
        Ok(replies)
    }

    /// Ends its input, and gives it a moment to end. One that does not is killed; that is no trouble, but worth a note.
    fn end(&mut self) -> Result<Vec<String>, ProgramError> {
        self.lines.end().map_err(|what| ProgramError { place: None, what, stderr: self.lines.last_words() })
    }
}
