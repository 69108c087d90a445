//! Exams in "real" time on a bus of the tests, whose time goes as fast as it is looked at.

use std::collections::VecDeque;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant, SystemTime};

use adsdv_can::bus::{Bus, Disturbance, Event, Listen, Received};
use adsdv_oracle::candump::FrameKind;
use adsdv_spec::Edition;
use adsdv_spec::messages::Frame;

use super::error::LiveError;
use super::exam;
use super::options::{LiveBus, LiveOptions};
use super::session::{LiveRan, run};
use super::under_test::UnderTest;
use crate::exam::ExamOptions;
use crate::scenarios::scenarios;
use crate::stack::{Reference, Stack as _};

/// What goes wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum WrongProgram {
    Nothing,
    /// The program sends nothing.
    Silent,
    /// And this machine is late with each cycle.
    SilentAndLate,
    /// It sends each frame twenty times.
    Floods,
    /// It ends after so many milliseconds.
    Ends(u64),
    /// Its frames of a while are of another kind.
    Extended,
    /// The interface goes down after so many milliseconds.
    Down(u64),
    /// This machine does nothing for 200 ms.
    Sleeps(u64),
    /// Somebody else is on the bus.
    Other,
}

/// A bus with the reference on it.
struct TestBus {
    wrong: WrongProgram,
    begun: Instant,
    now: Duration,
    /// When the program takes its next step, while it runs.
    next: Option<Duration>,
    started: Duration,
    ai: Reference,
    to_ai: Vec<Frame>,
    from_ai: VecDeque<Frame>,
    runs: bool,
}

impl TestBus {
    fn new(edition: &'static Edition, wrong: WrongProgram) -> Self {
        let mut ai = Reference::default();
        ai.hello(edition).expect("it knows every edition");
        Self {
            wrong,
            begun: Instant::now(),
            now: Duration::ZERO,
            next: None,
            started: Duration::ZERO,
            ai,
            to_ai: Vec::new(),
            from_ai: VecDeque::new(),
            runs: false,
        }
    }

    fn start(&mut self) {
        self.ai.reset().expect("it starts");
        (self.runs, self.started) = (true, self.now);
        // It takes some time.
        self.next = Some(self.now + Duration::from_millis(303));
    }

    /// So long since it started.
    fn since(&self, ms: u64) -> bool {
        self.runs && self.now >= self.started + Duration::from_millis(ms)
    }

    fn step(&mut self, at: Duration) {
        self.next = Some(at + Duration::from_millis(10));
        let heard = std::mem::take(&mut self.to_ai);
        let frames = self.ai.step(0, &heard).expect("it answers");
        let times = match self.wrong {
            WrongProgram::Silent | WrongProgram::SilentAndLate => 0,
            WrongProgram::Floods => 20,
            _ => 1,
        };
        (0..times).for_each(|_| self.from_ai.extend(&frames));
    }

    fn received(frame: &Frame, kind: FrameKind) -> Received {
        let since = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH).expect("after 1970");
        let time_ns = i64::try_from(since.as_nanos()).expect("before 2262");
        Received { time_ns, kind, id: frame.id.into(), len: frame.len, data: frame.data }
    }
}

impl Listen for TestBus {
    fn name(&self) -> &'static str {
        "test"
    }

    fn receive(&mut self, until: Instant) -> Event {
        let until = until.saturating_duration_since(self.begun);
        match self.wrong {
            WrongProgram::Down(ms) if self.since(ms) => return Event::Disturbance(Disturbance::Down),
            WrongProgram::Ends(ms) if self.since(ms) => self.next = None,
            WrongProgram::Sleeps(ms) if self.since(ms) => {
                self.wrong = WrongProgram::Nothing;
                self.now += Duration::from_millis(200);
                self.next = self.next.map(|next| next + Duration::from_millis(200));
            }
            WrongProgram::Other if !self.runs => {
                self.now = until;
                let frame = Frame::new(0x520, &[0; 8]).expect("a frame");
                return Event::Frame(Self::received(&frame, FrameKind::Standard));
            }
            _ => {}
        }
        if let Some(frame) = self.from_ai.pop_front() {
            let kind = match self.wrong {
                WrongProgram::Extended if frame.id == 0x514 => FrameKind::Extended,
                _ => FrameKind::Standard,
            };
            return Event::Frame(Self::received(&frame, kind));
        }
        match self.next {
            Some(next) if next <= until => {
                self.now = self.now.max(next);
                self.step(next);
                // What it sent comes when somebody asks again.
                if self.from_ai.is_empty() { Event::Nothing } else { self.receive(self.begun + until) }
            }
            _ => {
                let late_ms = if self.wrong == WrongProgram::SilentAndLate { 6 } else { 0 };
                self.now = self.now.max(until + Duration::from_millis(late_ms));
                Event::Nothing
            }
        }
    }

    fn dropped(&self) -> u64 {
        0
    }

    fn now(&self) -> Instant {
        self.begun + self.now
    }
}

impl Bus for TestBus {
    fn send(&mut self, frame: &Frame) -> Result<(), Disturbance> {
        self.to_ai.push(*frame);
        Ok(())
    }
}

/// The program on such a bus. Both are one, which is why the bus is behind a lock.
#[derive(Clone)]
struct Shared(Arc<std::sync::Mutex<TestBus>>);

impl Shared {
    fn bus(&self) -> std::sync::MutexGuard<'_, TestBus> {
        self.0.lock().expect("nobody panics")
    }
}

impl Listen for Shared {
    fn name(&self) -> &'static str {
        "test"
    }

    fn receive(&mut self, until: Instant) -> Event {
        self.bus().receive(until)
    }

    fn dropped(&self) -> u64 {
        0
    }

    fn now(&self) -> Instant {
        self.bus().now()
    }
}

impl Bus for Shared {
    fn send(&mut self, frame: &Frame) -> Result<(), Disturbance> {
        self.bus().send(frame)
    }
}

struct TestProgram {
    bus: Shared,
    attached: bool,
    stopped: usize,
}

impl UnderTest for TestProgram {
    fn starts(&self) -> bool {
        !self.attached
    }

    fn start(&mut self) -> Result<(), LiveError> {
        self.bus.bus().start();
        Ok(())
    }

    fn ended(&mut self) -> Option<String> {
        let bus = self.bus.bus();
        let ended = matches!(bus.wrong, WrongProgram::Ends(ms) if bus.since(ms));
        ended.then(|| "signal 11".to_owned())
    }

    fn stop(&mut self) {
        self.stopped += 1;
        if !self.attached {
            let mut bus = self.bus.bus();
            (bus.runs, bus.next) = (false, None);
            bus.from_ai.clear();
        }
    }
}

fn options(edition: &'static Edition) -> LiveOptions {
    LiveOptions {
        exam: ExamOptions::of(edition),
        bus: LiveBus::Interface("test".to_owned()),
        startup: Duration::from_secs(1),
        jobs: 1,
        stop: Arc::new(AtomicBool::new(false)),
    }
}

fn ran(edition: &'static Edition, wrong: WrongProgram, names: &[&str]) -> Vec<LiveRan> {
    let mut bus = Shared(Arc::new(std::sync::Mutex::new(TestBus::new(edition, wrong))));
    let mut program = TestProgram { bus: bus.clone(), attached: false, stopped: 0 };
    let chosen = scenarios().into_iter().filter(|one| names.contains(&one.name.as_str()));
    let ran: Vec<LiveRan> = chosen
        .map(|scenario| {
            let operator = scenario.operator.parse().expect("it reads");
            run(&scenario, &operator, &options(edition), &mut bus, &mut program)
        })
        .collect();
    assert_eq!((ran.len(), program.stopped), (names.len(), names.len()));
    ran
}

fn one(wrong: WrongProgram, name: &str) -> LiveRan {
    ran(&Edition::V4_0, wrong, &[name]).remove(0)
}

fn against(ran: &LiveRan) -> Vec<&'static str> {
    let mut ids: Vec<_> = ran.findings.iter().flat_map(|one| one.requirements.iter().copied()).collect();
    ids.sort_unstable();
    ids.dedup();
    ids
}

fn is_clean(ran: &LiveRan, what: &str) {
    let mut all = ran.findings.iter().chain(ran.in_doubt.iter().map(|(finding, _)| finding));
    if let Some(finding) = all.next() {
        panic!("{what}: {} ms: {}; expected {}", finding.t_ns / 1_000_000, finding.seen, finding.expected);
    }
    assert_eq!((&ran.error, &ran.ran.stuck.is_some(), ran.late_ms), (&None, &false, 0), "{what}");
}

#[test]
fn the_reference_passes_every_scenario_in_every_edition() {
    let all = scenarios();
    let names: Vec<&str> = all.iter().map(|one| one.name.as_str()).collect();
    for edition in Edition::ALL {
        for (ran, name) in ran(edition, WrongProgram::Nothing, &names).iter().zip(&names) {
            is_clean(ran, &format!("{} {name}", edition.version));
            assert!(ran.notes.is_empty());
        }
    }
}

#[test]
fn one_that_runs_all_the_time_passes_as_well() {
    let edition = &Edition::V4_0;
    let mut bus = Shared(Arc::new(std::sync::Mutex::new(TestBus::new(edition, WrongProgram::Nothing))));
    bus.bus().start();
    let mut program = TestProgram { bus: bus.clone(), attached: true, stopped: 0 };
    for scenario in scenarios().iter().filter(|one| one.ai_starts_ms == 0) {
        let operator = scenario.operator.parse().expect("it reads");
        let ran = run(scenario, &operator, &options(edition), &mut bus, &mut program);
        is_clean(&ran, &scenario.name);
    }
}

#[test]
fn a_silent_program_fails() {
    for wrong in [WrongProgram::Silent, WrongProgram::SilentAndLate] {
        let ran = one(wrong, "ready");
        assert_eq!((&ran.error, ran.late_ms > 0), (&None, wrong == WrongProgram::SilentAndLate));
        let against = against(&ran);
        for id in ["MSG-1", "MSG-5", "MSG-26", "HS-5", "RDY-7"] {
            assert!(against.contains(&id), "{wrong:?} {id}: {against:?}");
        }
    }
}

#[test]
fn a_flood_ends_the_scenario_at_once() {
    let ran = one(WrongProgram::Floods, "mission-skidpad");
    assert!(against(&ran).contains(&"MSG-98"), "{:?}", against(&ran));
    assert!(ran.findings.iter().any(|one| one.seen.contains("the bus cannot carry")));
    assert!(ran.ran.duration_ms < 1000, "{} ms", ran.ran.duration_ms);
}

#[test]
fn a_program_that_ends_is_found_with_how() {
    let ran = one(WrongProgram::Ends(3000), "mission-skidpad");
    let ended = ran.findings.iter().find(|one| one.seen == "the program ended by itself: signal 11");
    let t_ms = ended.expect("it is found").t_ns / 1_000_000;
    // It has sent nothing before the VCU was heard, and so had the whole second to start.
    assert!((1990..2030).contains(&t_ms), "{t_ms} ms");
    assert!(against(&ran).contains(&"MSG-98"), "{:?}", against(&ran));
    assert!(ran.ran.duration_ms < 2500, "{} ms", ran.ran.duration_ms);
}

#[test]
fn what_was_seen_before_the_interface_went_down_is_kept() {
    let ran = one(WrongProgram::Down(3000), "mission-skidpad");
    let error = ran.error.as_ref().expect("it ends with an error");
    assert!(error.why.starts_with("the interface is down, in mission-skidpad at 2.0"), "{error}");
    assert!(ran.ran.sent.len() > 1000 && ran.findings.is_empty(), "{:?}", against(&ran));
}

#[test]
fn frames_of_another_kind_are_no_messages_and_worth_a_note() {
    let ran = one(WrongProgram::Extended, "ready");
    assert!(against(&ran).contains(&"MSG-26"), "{:?}", against(&ran));
    assert!(ran.notes[0].contains("with an extended identifier"), "{:?}", ran.notes);
}

/// The AI Computer of the tests is held up as long as everything is: it is not to blame for that.
#[test]
fn nobody_is_blamed_for_this_machine_being_late() {
    for name in ["ready", "mission-skidpad"] {
        for after_ms in [1000, 2500, 9000, 11_000] {
            let ran = one(WrongProgram::Sleeps(after_ms), name);
            assert!(ran.findings.is_empty(), "{name} {after_ms}: {:?} {:?}", against(&ran), ran.findings);
            assert!(ran.late_ms >= 180 || after_ms > 8000 && name == "ready", "{} ms", ran.late_ms);
        }
    }
    // A stack that never sends anything is.
    let mut ran = one(WrongProgram::Sleeps(1000), "ready");
    assert!(!ran.in_doubt.is_empty());
    let why = exam::doubt(&ran.in_doubt.remove(0), "ready");
    assert!(why.starts_with("this machine was late by ") && why.contains(" ms in ready, when "), "{why}");
}

#[test]
fn a_bus_that_others_use_is_refused() {
    let ran = one(WrongProgram::Other, "ready");
    let error = ran.error.expect("it ends with an error");
    assert!(error.why.starts_with("520h comes before the program runs"), "{error}");
    assert!(error.hint.contains("--namespace") && error.hint.contains("--attach"), "{error}");
    assert_eq!(ran.ran.sent.len(), 0);
}
