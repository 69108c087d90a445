//! All scenarios in real time: one after the other on a bus that is there, or several at once, each on a bus of its own.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::thread;
use std::time::{Duration, Instant};

use adsdv_can::bus::Bus;
use adsdv_can::scenario::Scenario;
use adsdv_can::socket;

use super::error::LiveError;
use super::namespace;
use super::options::{LiveBus, LiveOptions, LiveProgram};
use super::session::{LiveRan, run};
use super::under_test::{Afresh, UnderTest};
use crate::exam::Collector;
use crate::length::{BESIDE, estimate};
use crate::report::{ExamFinding, ExamReport};
use crate::scenario::ExamScenario;
use crate::session::Sent;

/// A scenario in which this machine was late is run so often at most.
const ATTEMPTS: usize = 3;
/// How often the exam reports how long it will be.
const PACE: Duration = Duration::from_millis(250);

/// How far it is.
#[derive(Debug)]
pub struct LiveProgress<'a> {
    /// The name of the scenario that has just ended, or of one that runs.
    pub name: &'a str,
    /// How many are done, and how many there are.
    pub done: (usize, usize),
    /// How long it will still take, where the program drives as the reference does.
    pub left: Duration,
    /// All frames of it, if it has just ended.
    pub sent: Option<&'a [Sent]>,
}

/// What came of an exam in real time.
#[derive(Debug)]
pub struct LiveReport {
    /// What was seen.
    pub report: ExamReport,
    /// Why it ended before all was seen.
    pub error: Option<LiveError>,
}

/// Examines what is on a bus, in real time.
pub fn exam_live(
    program: &LiveProgram,
    scenarios: &[ExamScenario],
    options: &LiveOptions,
    progress: &mut dyn FnMut(&LiveProgress<'_>),
) -> LiveReport {
    let mut collector = Collector::new(options.exam.edition);
    let mut readable = Vec::new();
    for scenario in scenarios {
        let needs_start = scenario.ai_starts_ms > 0 && *program == LiveProgram::Attached;
        match scenario.operator.parse::<Scenario>() {
            _ if needs_start => collector.note(format!(
                "{}: not run, since it needs a program that is started afresh, and --attach is for one that runs",
                scenario.name
            )),
            Ok(operator) => readable.push((scenario, operator)),
            Err(wrong) => collector.note(format!("{}: {wrong}", scenario.name)),
        }
    }
    let lengths = readable.iter().map(|(scenario, _)| scenario.length(&options.exam)).collect();
    let queue = Queue { scenarios: &readable, next: AtomicUsize::new(0), stop: AtomicBool::new(false) };
    let mut schedule = Schedule::new(lengths, options.at_once());
    let error = thread::scope(|scope| {
        let (sender, messages) = channel();
        for _ in 0..options.at_once() {
            let (sender, queue) = (sender.clone(), &queue);
            scope.spawn(move || work(queue, program, options, &sender));
        }
        drop(sender);
        let mut error = None;
        loop {
            match messages.recv_timeout(PACE) {
                Ok(Message::Begun(place)) => schedule.begins(place),
                Ok(Message::Ended(place, ran)) => {
                    schedule.ends(place);
                    let name = &queue.scenarios[place].0.name;
                    progress(&schedule.progress(name, Some(&ran.ran.sent)));
                    schedule.ran[place] = Some(*ran);
                }
                Ok(Message::Failed(failed)) => error = error.or(Some(failed)),
                Err(RecvTimeoutError::Timeout) => {
                    if let Some(place) = schedule.running() {
                        progress(&schedule.progress(&queue.scenarios[place].0.name, None));
                    }
                }
                Err(RecvTimeoutError::Disconnected) => return error,
            }
        }
    });
    for ((scenario, _), ran) in readable.iter().zip(schedule.ran) {
        if let Some(ran) = ran {
            collect(&mut collector, scenario, ran);
        }
    }
    LiveReport { report: collector.finish(), error }
}

/// What a scenario adds to the report.
fn collect(collector: &mut Collector, scenario: &ExamScenario, ran: LiveRan) {
    let is_disturbed = ran.is_disturbed();
    let LiveRan { ran, findings, in_doubt, late_ms, notes, .. } = ran;
    for doubted in &in_doubt {
        collector.in_doubt(&doubted.0.requirements, &doubt(doubted, &scenario.name));
    }
    if is_disturbed {
        collector.note(format!(
            "{}: this machine was late by up to {late_ms} ms; end what else runs here, or lower --jobs",
            scenario.name
        ));
    }
    for note in notes {
        collector.note(note);
    }
    collector.ran(scenario, &ran, findings);
}

/// Why a finding does not count.
pub(super) fn doubt((_, by): &(ExamFinding, u64), scenario: &str) -> String {
    format!("this machine was late by {by} ms in {scenario}, when it seemed not to be kept")
}

/// What is to be done.
struct Queue<'a> {
    scenarios: &'a [(&'a ExamScenario, Scenario)],
    next: AtomicUsize,
    /// Set where something failed that fails again.
    stop: AtomicBool,
}

/// What a thread with a bus tells.
enum Message {
    Begun(usize),
    Ended(usize, Box<LiveRan>),
    Failed(LiveError),
}

/// The receiver of messages waits until all threads have ended, and is there when one is sent.
fn work(queue: &Queue<'_>, program: &LiveProgram, options: &LiveOptions, sender: &Sender<Message>) {
    let name = match &options.bus {
        LiveBus::Interface(name) => Ok(name),
        LiveBus::Namespace(name) => namespace::enter(name).map(|()| name),
    };
    let opened = name.and_then(|name| socket::open(name).map_err(LiveError::from));
    let failed = opened.and_then(|mut bus| all(queue, &mut bus, &mut Afresh::new(program), options, sender));
    if let Err(error) = failed {
        queue.stop.store(true, Ordering::Release);
        let _ = sender.send(Message::Failed(error));
    }
}

/// Runs scenarios until none is left.
fn all<B: Bus>(
    queue: &Queue<'_>,
    bus: &mut B,
    under_test: &mut dyn UnderTest,
    options: &LiveOptions,
    sender: &Sender<Message>,
) -> Result<(), LiveError> {
    while !queue.stop.load(Ordering::Acquire) {
        let place = queue.next.fetch_add(1, Ordering::Relaxed);
        let Some((scenario, operator)) = queue.scenarios.get(place) else { break };
        let _ = sender.send(Message::Begun(place));
        let mut ran = run(scenario, operator, options, bus, under_test);
        for _ in 1..ATTEMPTS {
            if !ran.is_worth_another() {
                break;
            }
            ran = run(scenario, operator, options, bus, under_test);
        }
        let error = ran.error.take();
        // In one that could not begin there was nothing to see.
        if ran.ran.duration_ms > 0 {
            let _ = sender.send(Message::Ended(place, Box::new(ran)));
        }
        error.map_or(Ok(()), Err)?;
    }
    Ok(())
}

/// How far all scenarios are.
struct Schedule {
    lengths: Vec<Duration>,
    at_once: usize,
    begun: Vec<Option<Instant>>,
    ended: Vec<bool>,
    ran: Vec<Option<LiveRan>>,
}

impl Schedule {
    fn new(lengths: Vec<Duration>, at_once: usize) -> Self {
        let count = lengths.len();
        let ran = std::iter::repeat_with(|| None).take(count).collect();
        Self { lengths, at_once, begun: vec![None; count], ended: vec![false; count], ran }
    }

    fn begins(&mut self, place: usize) {
        if let Some(begun) = self.begun.get_mut(place) {
            *begun = Some(Instant::now());
        }
    }

    fn ends(&mut self, place: usize) {
        if let Some(ended) = self.ended.get_mut(place) {
            *ended = true;
        }
    }

    /// One that runs.
    fn running(&self) -> Option<usize> {
        (0..self.lengths.len()).find(|place| self.begun[*place].is_some() && !self.ended[*place])
    }

    fn progress<'a>(&self, name: &'a str, sent: Option<&'a [Sent]>) -> LiveProgress<'a> {
        let left: Vec<Duration> = (0..self.lengths.len())
            .filter(|place| !self.ended[*place])
            .map(|place| {
                let since = self.begun[place].map_or(Duration::ZERO, |begun| begun.elapsed());
                self.lengths[place].saturating_sub(since)
            })
            .collect();
        let done = (self.ended.iter().filter(|ended| **ended).count(), self.lengths.len());
        LiveProgress { name, done, left: estimate(&left, BESIDE, self.at_once), sent }
    }
}
