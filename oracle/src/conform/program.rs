//! A program under test: started once, asked line by line, many lines ahead.

use std::ffi::OsString;
use std::io::Write as _;
use std::sync::Arc;
use std::sync::mpsc::{Sender, channel};
use std::thread;
use std::time::{Duration, Instant};

use adsdv_spec::{Edition, Inputs};

use super::child::Process;
use super::lines::{LineBuffer, Lines, Missing};
use super::program_error::{Place, ProgramError, ProgramErrorKind, excerpt};
use super::stderr::LastWords;
use super::vcu::{Reply, Vcu};
use super::wall_clock::PATIENCE;
use crate::protocol::{About, Answer, Protocol, Request, UNSAID};
use crate::suite::{Scenario, Step};

/// So many lines are sent before the answer to the first of them has come.
const AHEAD: usize = 4096;
/// How long a program may take to end when its input has, whatever it may take to answer.
const FAREWELL: Duration = Duration::from_secs(1);

/// A child process that speaks the protocol. It is killed, with everything that it started, when it is dropped.
#[derive(Debug)]
pub struct Program {
    // The order matters: the process is gone before anything else is dropped.
    process: Process,
    /// To the thread that writes to the program; `None` after the end of its input.
    requests: Option<Sender<Vec<u8>>>,
    lines: Lines,
    last_words: LastWords,
    timeout: Duration,
    /// Since when it runs, and how long it may take for all of it.
    limit: Option<(Instant, Duration)>,
    /// Whether `{}` is an answer to a step.
    late: bool,
    /// What its answers may say.
    protocol: Arc<Protocol>,
    /// Whether it has just been reset, and nothing was asked since.
    is_reset: bool,
    /// Since when its last step lasts, if its time is that of a clock on the wall.
    clock: Option<Instant>,
}

impl Program {
    /// Starts a program that has `timeout` for each answer. One that is `late` may answer `{}` to a step.
    pub fn start(
        program: &OsString,
        args: &[OsString],
        timeout: Duration,
        late: bool,
    ) -> Result<Self, ProgramError> {
        let started = Process::start(program, args);
        let (process, (mut stdin, stdout, stderr)) =
            started.map_err(|error| ProgramError::new(ProgramErrorKind::NoStart(error)))?;
        let (requests, to_write) = channel::<Vec<u8>>();
        // It ends with the requests, or with the program, which nobody writes to any more.
        thread::spawn(move || to_write.iter().try_for_each(|lines| stdin.write_all(&lines)));
        let (lines, last_words) = (Lines::of(stdout), LastWords::of(stderr));
        let protocol = Arc::new(Protocol::of(UNSAID));
        Ok(Self {
            process,
            requests: Some(requests),
            lines,
            last_words,
            timeout,
            limit: None,
            late,
            protocol,
            is_reset: false,
            clock: None,
        })
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

    /// Power on, and waits for the answer; for who asks one thing after the other, each by the answer before.
    pub fn reset(&mut self) -> Result<(), ProgramError> {
        if std::mem::take(&mut self.is_reset) {
            return Ok(());
        }
        self.asked(&Request::Reset, |line, _| Reply::to_reset(line))
    }

    /// One step, and waits for its answer.
    pub fn step(&mut self, dt_ms: u32, inputs: &Inputs) -> Result<Answer, ProgramError> {
        let inputs = *inputs;
        self.asked(&Request::Step { dt_ms, inputs }, |line, protocol| {
            match Reply::to_step(line, false, protocol)? {
                Reply::Answer(answer) => Ok(answer),
                Reply::Nothing => Err(ProgramErrorKind::Closed),
            }
        })
    }

    fn asked<T>(
        &mut self,
        request: &Request,
        read: impl FnOnce(&[u8], &Protocol) -> Result<T, ProgramErrorKind>,
    ) -> Result<T, ProgramError> {
        let protocol = Arc::clone(&self.protocol);
        let sent = protocol.line(request).to_string();
        self.write(format!("{sent}\n").into_bytes());
        self.line().and_then(|line| read(line, &protocol)).map_err(|what| {
            let place = Some(Box::new(Place { scenario: "the diagnosis".to_owned(), step: 1, sent }));
            ProgramError { place, what, stderr: self.last_words.lines() }
        })
    }

    /// Waits until this time has passed since the last step, if that is what the program goes by.
    fn wait_for(&mut self, dt_ms: u32) {
        let Some(since) = self.clock else { return };
        let due = since + Duration::from_millis(dt_ms.into()) + PATIENCE;
        thread::sleep(due.saturating_duration_since(Instant::now()));
        self.clock = Some(Instant::now());
    }

    /// The first reset, before which a program may say something of itself.
    fn first_reset(&mut self) -> Result<Option<About>, ProgramErrorKind> {
        let protocol = Arc::clone(&self.protocol);
        self.write(format!("{}\n", protocol.line(&Request::Reset)).into_bytes());
        let line = self.line()?.to_vec();
        let about = Reply::about(&line, &protocol)?;
        Reply::to_reset(if about.is_some() { self.line()? } else { &line })?;
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
        self.write(lines);
        scenario.steps.len() + 1 - written
    }

    fn write(&self, lines: Vec<u8>) {
        if let Some(requests) = &self.requests {
            // That the program has ended shows where its answer is missing.
            let _ = requests.send(lines);
        }
    }

    /// The next line.
    fn line(&mut self) -> Result<&[u8], ProgramErrorKind> {
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

    /// What it is that has no more lines. A program that has just closed its output may be about to end.
    fn gone(&mut self) -> ProgramErrorKind {
        match self.wait(Duration::from_millis(200)) {
            Some(ended) => ProgramErrorKind::Ended(ended.how),
            None => ProgramErrorKind::Closed,
        }
    }

    /// Waits for the end of the program.
    fn wait(&mut self, limit: Duration) -> Option<super::child::Ended> {
        let start = Instant::now();
        loop {
            let ended = self.process.ended();
            if ended.is_some() || start.elapsed() >= limit {
                return ended;
            }
            thread::sleep(Duration::from_millis(2));
        }
    }

    /// What is wrong with the answer to a step of a scenario, or with that to the reset before it.
    fn trouble(&self, what: ProgramErrorKind, name: &str, scenario: &Scenario, step: usize) -> ProgramError {
        let sent = scenario.requests().nth(step).map(|request| self.protocol.line(&request).to_string());
        let sent = sent.unwrap_or_default();
        let place = Some(Box::new(Place { scenario: name.to_owned(), step, sent }));
        ProgramError { place, what, stderr: self.last_words.lines() }
    }
}

impl Vcu for Program {
    /// One that is asked about [`UNSAID`] is told nothing: so programs that know no hello are judged as they always were.
    fn hello(&mut self, edition: &Edition) -> Result<About, ProgramError> {
        self.protocol = Arc::new(Protocol::of(edition));
        let protocol = Arc::clone(&self.protocol);
        let mut about = None;
        if edition.version != UNSAID.version {
            let sent = Request::Hello { edition: edition.version.to_owned() }.to_string();
            self.write(format!("{sent}\n").into_bytes());
            let answered = self.line().and_then(|line| {
                let about = Reply::about(line, &protocol)?;
                Ok((about, Reply::to_hello(line, edition)))
            });
            let answered = answered.and_then(|(said, answer)| {
                about = said;
                match answer {
                    // It says something of itself before it answers.
                    Err(_) if about.is_some() => self.line().and_then(|line| Reply::to_hello(line, edition)),
                    answer => answer,
                }
            });
            answered.map_err(|what| {
                let place = Some(Box::new(Place { scenario: String::new(), step: 0, sent }));
                ProgramError { place, what, stderr: self.last_words.lines() }
            })?;
        }
        let first = self.first_reset().map_err(|what| {
            let sent = Request::Reset.to_string();
            let place = Some(Box::new(Place { scenario: "the beginning".to_owned(), step: 0, sent }));
            ProgramError { place, what, stderr: self.last_words.lines() }
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
                let replies = self.ask_in_turn(name, &mut |place, _| scenario.steps.get(place).copied())?;
                answered(place, &replies);
            }
            return Ok(());
        }
        let protocol = Arc::clone(&self.protocol);
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
                let reset = self.line().and_then(Reply::to_reset);
                reset.map_err(|what| self.trouble(what, name, scenario, 0))?;
                in_flight -= 1;
            }
            replies.clear();
            for step in 1..=scenario.steps.len() {
                let late = self.late;
                let reply = self.line().and_then(|line| Reply::to_step(line, late, &protocol));
                replies.push(reply.map_err(|what| self.trouble(what, name, scenario, step))?);
            }
            in_flight -= scenario.steps.len();
            answered(place, &replies);
        }
        Ok(())
    }

    fn ask_in_turn(
        &mut self,
        name: &str,
        next: &mut dyn FnMut(usize, Option<&Reply>) -> Option<Step>,
    ) -> Result<Vec<Reply>, ProgramError> {
        let protocol = Arc::clone(&self.protocol);
        let mut scenario = Scenario::default();
        let mut replies = Vec::new();
        if !std::mem::take(&mut self.is_reset) {
            self.write(format!("{}\n", protocol.line(&Request::Reset)).into_bytes());
            let reset = self.line().and_then(Reply::to_reset);
            reset.map_err(|what| self.trouble(what, name, &scenario, 0))?;
        }
        self.clock = self.clock.map(|_| Instant::now());
        while let Some(step) = next(replies.len(), replies.last()) {
            scenario.steps.push(step);
            self.wait_for(step.dt_ms);
            let request = Request::Step { dt_ms: step.dt_ms, inputs: step.inputs };
            self.write(format!("{}\n", protocol.line(&request)).into_bytes());
            let late = self.late;
            let reply = self.line().and_then(|line| Reply::to_step(line, late, &protocol));
            replies.push(reply.map_err(|what| self.trouble(what, name, &scenario, replies.len() + 1))?);
        }
        Ok(replies)
    }

    /// Ends its input, and gives it a moment to end. One that does not is killed; that is no trouble, but worth a note.
    fn end(&mut self) -> Result<Vec<String>, ProgramError> {
        self.requests = None;
        let start = Instant::now();
        let process = &mut self.process;
        let rest = self.lines.next(FAREWELL, || process.ended().is_some());
        let unasked = match rest {
            Ok(line) => self.lines.get(line),
            Err(_) => self.lines.rest(),
        };
        if !unasked.trim_ascii().is_empty() {
            let what = ProgramErrorKind::TooMany(excerpt(unasked));
            return Err(ProgramError { place: None, what, stderr: self.last_words.lines() });
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
