//! One scenario in real time.
//!
//! ```text
//! before     the bus is quiet; the program starts, and has some time until its first frame
//! 0 ms       the operator acts, the VCU steps and sends
//! to 10 ms   what comes is heard, as of when the kernel had it; then the cycle is looked at
//! behind     the program is ended, with all that it started
//! ```

use std::time::{Duration, Instant, SystemTime};

use adsdv_can::BITRATE;
use adsdv_can::bus::{Bus, Disturbance, Event, Received};
use adsdv_can::clock::Clock;
use adsdv_can::demo::wire::{Node, Wire};
use adsdv_can::scenario::Scenario;
use adsdv_oracle::candump::FrameKind;
use adsdv_oracle::judge::JudgeOptions;
use adsdv_spec::messages::Frame;

use super::error::LiveError;
use super::late::Lateness;
use super::odd::OddFrames;
use super::options::LiveOptions;
use super::under_test::UnderTest;
use crate::findings::{CYCLE_MS, findings};
use crate::report::{ExamFinding, FoundBy};
use crate::scenario::ExamScenario;
use crate::session::{Ran, Session};

/// What was sent before the program before it ended may still come in this time.
const DRAIN: Duration = Duration::from_millis(20);
/// On a bus that is used, something comes in this time.
const QUIET: Duration = Duration::from_millis(60);
/// For so long the VCU has no power between the scenarios of a program that runs all the time.
const POWERLESS: Duration = Duration::from_millis(1500);
/// How often it is looked at whether the program still runs while it starts.
const PACE: Duration = Duration::from_millis(10);
/// A scenario goes on for so long when the program has ended, so that it shows what is missing.
const AFTERWARDS_MS: u64 = 200;
/// A bus that takes nothing for so many cycles takes nothing at all.
const STUFFED: u32 = 100;
/// No cycle takes longer to hear what came in it: there is no end to a flood.
const LONGEST_HEARING: Duration = Duration::from_millis(5);

/// What came of a scenario in real time.
#[derive(Debug)]
pub(super) struct LiveRan {
    pub(super) ran: Ran,
    /// What is wrong for certain.
    pub(super) findings: Vec<ExamFinding>,
    /// What seemed wrong, and how late this machine was then, in milliseconds.
    pub(super) in_doubt: Vec<(ExamFinding, u64)>,
    /// How late it was at worst.
    pub(super) late_ms: u64,
    pub(super) notes: Vec<String>,
    /// Why it ended before its end.
    pub(super) error: Option<LiveError>,
}

impl LiveRan {
    /// Whether this machine was late so that something seemed wrong, or did not come to its end.
    pub(super) fn is_disturbed(&self) -> bool {
        !self.in_doubt.is_empty() || self.ran.stuck.is_some() && self.late_ms >= CYCLE_MS
    }

    /// Whether it is to be run again: not where the program fails anyway.
    pub(super) fn is_worth_another(&self) -> bool {
        self.is_disturbed() && self.findings.is_empty() && self.error.is_none()
    }
}

/// Runs a scenario, from a bus that is quiet to a program that has ended.
pub(super) fn run<B: Bus>(
    scenario: &ExamScenario,
    operator: &Scenario,
    options: &LiveOptions,
    bus: &mut B,
    under_test: &mut dyn UnderTest,
) -> LiveRan {
    let jitter_ms = JudgeOptions::of(options.exam.edition).window_ms.into();
    let session = Session::new(scenario, operator, options.exam.edition, options.exam.mission_ms);
    let mut live = Live {
        session: session.with_jitter(jitter_ms),
        dropped: bus.dropped(),
        start: bus.now(),
        bus,
        under_test,
        options,
        wire: Wire::new(BITRATE.into()),
        last_ns: 0,
        late: Lateness::default(),
        odd: OddFrames::default(),
        lost: 0,
        started: None,
        heard: false,
        stuffed: 0,
        ended: None,
    };
    let error = live.before().and_then(|()| live.cycles()).err();
    live.under_test.stop();
    live.finish(error)
}

struct Live<'a, B> {
    session: Session<'a>,
    bus: &'a mut B,
    under_test: &'a mut dyn UnderTest,
    options: &'a LiveOptions,
    /// What a bus of 500 kbit/s would carry: a virtual one carries everything.
    wire: Wire,
    /// The time at which the scenario is at 0.
    start: Instant,
    /// When the last frame came, in nanoseconds since then.
    last_ns: i64,
    late: Lateness,
    odd: OddFrames,
    /// How many frames the kernel has dropped.
    dropped: u64,
    /// How many of these were of this scenario.
    lost: u64,
    /// Since when the program runs.
    started: Option<Instant>,
    /// Whether it has sent something since.
    heard: bool,
    /// For how many cycles the bus has not taken all frames.
    stuffed: u32,
    /// When and how the program ended by itself.
    ended: Option<(u64, String)>,
}

impl<B: Bus> Live<'_, B> {
    /// What is before the scenario.
    fn before(&mut self) -> Result<(), LiveError> {
        if !self.under_test.starts() {
            let until = self.bus.now() + POWERLESS;
            self.ignore_until(until)?;
            (self.started, self.heard) = (Some(until), true);
            return Ok(());
        }
        self.ignore_until(self.bus.now() + DRAIN)?;
        let until = self.bus.now() + QUIET;
        if let Some(other) = self.frame_until(until)? {
            return Err(LiveError::new(
                self.bus.name(),
                format!(
                    "{:03X}h comes before the program runs; expected a bus on which nobody else is",
                    other.id
                ),
                "stop what sends there, or let the exam make a bus of its own: --namespace; a program that runs already is examined with --attach",
            ));
        }
        if self.session.scenario.ai_starts_ms == 0 {
            self.start()?;
            let latest = self.bus.now() + self.options.startup;
            while !self.heard
                && self.bus.now() < latest
                && !self.options.stops()
                && self.under_test.ended().is_none()
            {
                let until = latest.min(self.bus.now() + PACE);
                self.heard = self.frame_until(until)?.is_some();
            }
            // It has had its time.
            self.heard = true;
        }
        Ok(())
    }

    /// What comes until then is of no scenario. What comes without end is no reason to wait longer.
    fn ignore_until(&mut self, until: Instant) -> Result<(), LiveError> {
        while self.bus.now() < until {
            self.frame_until(until)?;
        }
        Ok(())
    }

    fn start(&mut self) -> Result<(), LiveError> {
        self.under_test.start()?;
        self.started = Some(self.bus.now());
        Ok(())
    }

    /// The scenario, to its end.
    fn cycles(&mut self) -> Result<(), LiveError> {
        self.start = self.bus.now();
        self.dropped = self.bus.dropped();
        let mut clock = Clock::new(self.start, self.session.cycle_ms());
        let mut first = true;
        loop {
            self.hear_until(clock.deadline())?;
            let begun = clock.begin(self.bus.now());
            let time_ms = clock.time_ms();
            self.late.note(time_ms, begun.late_by);
            if !first {
                let now = self.time(self.bus.now());
                while self.wire.complete(now).is_some() {}
                self.session.carries(time_ms, &self.wire);
                let runs = self.runs();
                if self.session.end(runs) || self.is_over(time_ms) {
                    return Ok(());
                }
            }
            first = false;
            if self.options.stops() {
                return Err(self.told_to_stop());
            }
            if self.started.is_none() && time_ms >= self.session.scenario.ai_starts_ms {
                self.start()?;
            }
            let frames = self.session.begin(time_ms, begun.dt_ms);
            self.send(&frames)?;
        }
    }

    /// Whether the program has ended, and what that left behind has been seen.
    fn is_over(&mut self, time_ms: u64) -> bool {
        if self.ended.is_none() {
            self.ended = self.under_test.ended().map(|how| (time_ms, how));
        }
        self.ended.as_ref().is_some_and(|(at, _)| time_ms >= at + AFTERWARDS_MS)
    }

    /// Whether the program runs, and has had its time to start.
    fn runs(&self) -> bool {
        let has_started = |started: Instant| {
            self.heard || self.bus.now().saturating_duration_since(started) >= self.options.startup
        };
        self.started.is_some_and(has_started)
    }

    fn told_to_stop(&self) -> LiveError {
        let (seconds, name) = (self.session.time_ms / 1000, &self.session.scenario.name);
        LiveError::new(
            "the exam",
            format!("it was stopped, in {name} after {seconds} s"),
            "what was seen until then counts; let it come to its end for a verdict",
        )
    }

    /// Sends the frames of a cycle. What the bus does not take is lost, and nobody is blamed for what follows from it.
    fn send(&mut self, frames: &[Frame]) -> Result<(), LiveError> {
        let mut whole = true;
        for frame in frames {
            match self.bus.send(frame) {
                Ok(()) => {
                    let t_ns = self.time(self.bus.now());
                    self.wire.send(t_ns, Node::Vcu, vec![*frame]);
                    self.session.came(t_ns, Node::Vcu, *frame);
                }
                Err(Disturbance::Full) if self.stuffed < STUFFED => {
                    whole = false;
                    self.late
                        .note(self.session.time_ms, Duration::from_millis(self.session.cycle_ms().into()));
                }
                Err(disturbance) => return Err(self.disturbed(&disturbance)),
            }
        }
        self.stuffed = if whole { 0 } else { self.stuffed + 1 };
        Ok(())
    }

    /// What comes until the cycle is over, and what was there already when that was late.
    fn hear_until(&mut self, deadline: Instant) -> Result<(), LiveError> {
        let mut give_up = None;
        loop {
            let now = self.bus.now();
            if now >= deadline && now >= *give_up.get_or_insert(now + LONGEST_HEARING) {
                return Ok(());
            }
            match self.frame_until(deadline)? {
                Some(received) => self.hear(&received),
                None if self.bus.now() >= deadline => return Ok(()),
                None => {}
            }
        }
    }

    /// The next frame of whatever kind until this time.
    fn frame_until(&mut self, until: Instant) -> Result<Option<Received>, LiveError> {
        loop {
            match self.bus.receive(until) {
                Event::Frame(received) if received.kind == FrameKind::Standard => return Ok(Some(received)),
                Event::Frame(received) => self.odd.count(&received),
                Event::Disturbance(disturbance) => return Err(self.disturbed(&disturbance)),
                Event::Up => {}
                Event::Nothing => return Ok(None),
            }
            // There may be no end to frames of other kinds either.
            if self.bus.now() >= until {
                return Ok(None);
            }
        }
    }

    fn disturbed(&self, disturbance: &Disturbance) -> LiveError {
        LiveError::disturbed(self.bus.name(), disturbance, &self.session.scenario.name, self.session.time_ms)
    }

    fn hear(&mut self, received: &Received) {
        let dropped = self.bus.dropped();
        if let Some(count) = dropped.checked_sub(self.dropped).filter(|count| *count > 0) {
            self.dropped = dropped;
            self.lost += count;
            self.session.lost(count);
            self.late.note(self.session.time_ms, Duration::from_secs(1));
        }
        let Some(frame) = received.frame() else { return };
        self.heard = true;
        let now = self.bus.now();
        let t_ns = self.time(now.checked_sub(age(received)).unwrap_or(now));
        self.wire.send(t_ns, Node::Ai, vec![frame]);
        self.session.came(t_ns, Node::Ai, frame);
    }

    /// A time of the scenario, never before that of the last frame.
    fn time(&mut self, at: Instant) -> i64 {
        let since = at.saturating_duration_since(self.start).as_nanos();
        self.last_ns = self.last_ns.max(i64::try_from(since).unwrap_or(i64::MAX));
        self.last_ns
    }

    fn finish(self, error: Option<LiveError>) -> LiveRan {
        let (edition, late) = (self.options.exam.edition, self.late);
        let name = &self.session.scenario.name;
        let mut notes: Vec<String> = self.odd.notes(name).collect();
        if self.lost > 0 {
            notes.push(format!("{name}: this machine dropped {} frames before they were seen", self.lost));
        }
        if let Some((_, how)) = &self.ended {
            notes.push(format!("{name}: the program ended by itself: {how}"));
        }
        let ran = self.session.finish();
        let mut all = findings(&ran, edition);
        if let Some((time_ms, how)) = self.ended {
            let ended = ExamFinding {
                seen: format!("the program ended by itself: {how}"),
                expected: "it to run until it is asked to end".to_owned(),
                ..ExamFinding::new(ns(time_ms), "2.1", FoundBy::Exam, Vec::new())
            };
            all.push(ended.seen_in(&ran));
        }
        // Who has sent nothing at all has not been kept from it, unless this machine was late all the time.
        let is_silent = ran.tally.ids.is_empty() && late.sum_ms() < ran.duration_ms;
        let mut in_doubt = Vec::new();
        let mut certain = Vec::new();
        for finding in all {
            let time_ms = u64::try_from(finding.t_ns / 1_000_000).unwrap_or_default();
            match finding.slack_ms.filter(|_| !is_silent).and_then(|slack_ms| late.around(time_ms, slack_ms))
            {
                Some(by) => in_doubt.push((finding, by)),
                None => certain.push(finding),
            }
        }
        LiveRan { ran, findings: certain, in_doubt, late_ms: late.worst_ms(), notes, error }
    }
}

/// How long ago the kernel had a frame.
fn age(received: &Received) -> Duration {
    /// Older ones are of before somebody set the clock.
    const OLDEST: Duration = Duration::from_secs(1);
    let now = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH).unwrap_or_default();
    let then = Duration::from_nanos(u64::try_from(received.time_ns).unwrap_or_default());
    now.checked_sub(then).filter(|age| *age <= OLDEST).unwrap_or_default()
}

fn ns(ms: u64) -> i64 {
    i64::try_from(ms.saturating_mul(1_000_000)).unwrap_or(i64::MAX)
}
