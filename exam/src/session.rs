//! One scenario: the car, its operator and its judge, cycle after cycle, with an AI Computer on the bus.
//!
//! [`Session`] is all of it but the bus and the time. In simulated time, which is here, a cycle is
//!
//! ```text
//! 0 ms    the operator acts, the VCU steps and sends
//! 4 ms    the stack receives the frames that have come, and sends
//! 10 ms   the cycle is over: it is looked at
//! ```
//!
//! and in real time it is what `live/session.rs` makes it.

use adsdv_can::BITRATE;
use adsdv_can::car::{Action, Car, missing_for};
use adsdv_can::demo::wire::{Node, Wire};
use adsdv_can::scenario::{Player, Scenario, Stuck, Unreadable};
use adsdv_oracle::judge::{Judge, JudgeOptions, Report};
use adsdv_spec::messages::{self, AsState, Frame, ShutdownCause};
use adsdv_spec::{Edition, Machine};

use crate::course::Course;
use crate::expectation::Followed;
use crate::look::Look;
use crate::program_error::{Failure, StackError, StackErrorKind};
use crate::scenario::ExamScenario;
use crate::stack::Stack;
use crate::tally::Tally;

/// How long after the VCU's cycle the AI Computer is asked, in milliseconds.
const PHASE_MS: u64 = 4;
/// A millisecond in nanoseconds.
const MS: i64 = 1_000_000;
/// More frames of the AI Computer than this waiting for the bus are a flood: it takes a tenth of a second to send them.
const FLOOD: usize = 400;
/// How long a scenario waits in vain for a state, in milliseconds; for the end of a mission it waits as long as that may take.
const PATIENCE_MS: u64 = 8000;

/// A frame that was on the bus.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sent {
    /// When it was complete, in nanoseconds since the start of the scenario.
    pub t_ns: i64,
    /// Whether the AI Computer sent it.
    pub by_ai: bool,
    /// The frame.
    pub frame: Frame,
}

/// A change of the AS state; no state is a VCU without power.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Change {
    /// When, in milliseconds since the start of the scenario.
    pub time_ms: u64,
    /// Before.
    pub from: Option<AsState>,
    /// After.
    pub to: Option<AsState>,
    /// What SHUTDOWN_CAUSE says.
    pub cause: ShutdownCause,
}

/// What came of a scenario.
#[derive(Debug)]
pub(crate) struct Ran {
    pub(crate) duration_ms: u64,
    pub(crate) sent: Vec<Sent>,
    pub(crate) actions: Vec<(u64, Action)>,
    pub(crate) changes: Vec<Change>,
    pub(crate) followed: Vec<Followed>,
    pub(crate) report: Report,
    pub(crate) tally: Tally,
    pub(crate) stuck: Option<Stuck>,
    /// When the AI Computer sent so much that the bus could not carry it, and how many frames waited.
    pub(crate) flood: Option<(u64, usize)>,
    /// When the stack failed, and how.
    pub(crate) failed: Option<(u64, Failure)>,
}

/// A scenario that does not read is a mistake of this crate: the tests read all of them.
pub(crate) fn run(
    scenario: &ExamScenario,
    edition: &'static Edition,
    mission_ms: u64,
    stack: &mut dyn Stack,
) -> Result<Ran, SessionError> {
    let operator: Scenario = scenario.operator.parse().map_err(SessionError::Scenario)?;
    let session = Session::new(scenario, &operator, edition, mission_ms);
    if let Err(error) = stack.reset() {
        return failed(session, 0, error.during(&scenario.name, 0));
    }
    let mut simulated = Simulated { session, wire: Wire::new(BITRATE.into()), inbox: Vec::new() };
    loop {
        let (begun, cycle_ms) = (simulated.session.time_ms, simulated.session.cycle_ms());
        let frames = simulated.session.begin(begun, cycle_ms);
        simulated.wire.send(ns(begun), Node::Vcu, frames);
        simulated.bus_until(begun + PHASE_MS);
        if let Err(error) = simulated.ask(stack) {
            return failed(simulated.session, begun + PHASE_MS, error.during(&scenario.name, begun));
        }
        simulated.bus_until(begun + u64::from(cycle_ms));
        let runs = simulated.stack_runs();
        if simulated.session.end(runs) {
            return Ok(simulated.session.finish());
        }
    }
}

/// What was seen until a stack failed; an error if it is another one, after which there is nothing to say.
fn failed(session: Session<'_>, time_ms: u64, error: StackError) -> Result<Ran, SessionError> {
    match error.what {
        StackErrorKind::Failed(failure) => Ok(Ran { failed: Some((time_ms, failure)), ..session.finish() }),
        _ => Err(SessionError::Stack(error)),
    }
}

/// A session on a bus in simulated time.
struct Simulated<'a> {
    session: Session<'a>,
    wire: Wire,
    /// What the stack has not been told yet.
    inbox: Vec<Frame>,
}

impl Simulated<'_> {
    /// The frames that are complete up to this time.
    fn bus_until(&mut self, until_ms: u64) {
        while let Some((t_ns, from, frame)) = self.wire.complete(ns(until_ms)) {
            self.session.came(t_ns, from, frame);
            if from == Node::Vcu {
                self.inbox.push(frame);
            }
        }
    }

    fn stack_runs(&self) -> bool {
        self.session.time_ms >= self.session.scenario.ai_starts_ms
    }

    fn ask(&mut self, stack: &mut dyn Stack) -> Result<(), StackError> {
        let inbox = std::mem::take(&mut self.inbox);
        if self.stack_runs() {
            let at = self.session.time_ms + PHASE_MS;
            self.wire.send(ns(at), Node::Ai, stack.step(at, &inbox)?);
            self.session.carries(at, &self.wire);
        }
        Ok(())
    }
}

/// Why there is nothing to say of a scenario.
#[derive(Debug)]
pub(crate) enum SessionError {
    Stack(StackError),
    Scenario(Unreadable),
}

/// The car, its operator and its judge, whatever the bus and the time are.
pub(crate) struct Session<'a> {
    pub(crate) scenario: &'a ExamScenario,
    edition: &'static Edition,
    mission_ms: u64,
    /// When the cycle that lasts began; behind its end, when the next begins.
    pub(crate) time_ms: u64,
    car: Car,
    player: Player,
    judge: Judge,
    look: Look,
    courses: Vec<Course>,
    followed: Vec<Followed>,
    /// Frames of the VCU that come later, and when.
    delayed: Vec<(u64, Vec<Frame>)>,
    sent: Vec<Sent>,
    actions: Vec<(u64, Action)>,
    changes: Vec<Change>,
    tally: Tally,
    stuck: Option<Stuck>,
    flood: Option<(u64, usize)>,
}

impl<'a> Session<'a> {
    pub(crate) fn new(
        scenario: &'a ExamScenario,
        operator: &Scenario,
        edition: &'static Edition,
        mission_ms: u64,
    ) -> Self {
        let machine = Machine::new(*edition, edition.readings);
        let car = Car::with_physics(machine, scenario.physics);
        Self {
            scenario,
            edition,
            mission_ms,
            time_ms: 0,
            car,
            player: Player::new(operator),
            judge: Judge::new(JudgeOptions::of(edition)),
            look: Look::new(),
            courses: scenario.disturbances.iter().map(Course::new).collect(),
            followed: scenario.expects.iter().copied().map(Followed::new).collect(),
            delayed: Vec::new(),
            sent: Vec::new(),
            actions: Vec::new(),
            changes: Vec::new(),
            tally: Tally::default(),
            stuck: None,
            flood: None,
        }
    }

    fn state(&self) -> Option<AsState> {
        self.car.outputs().map(|outputs| outputs.state)
    }

    /// The same in real time, in which a frame may be seen so much later than it was sent.
    pub(crate) fn with_jitter(mut self, jitter_ms: u64) -> Self {
        self.look.jitter_ms = jitter_ms;
        self
    }

    /// How long a cycle is, in milliseconds.
    pub(crate) fn cycle_ms(&self) -> u32 {
        self.car.cycle_ms()
    }

    /// A cycle begins, so many milliseconds behind the one before: the operator acts, the VCU steps, and these are the frames that
    /// it sends now.
    pub(crate) fn begin(&mut self, time_ms: u64, dt_ms: u32) -> Vec<Frame> {
        self.time_ms = time_ms;
        let before = self.state();
        for action in self.player.due(time_ms, before) {
            self.car.act(&action);
            self.actions.push((time_ms, action));
        }
        if time_ms < self.scenario.vcu_starts_ms {
            return Vec::new();
        }
        let mut frames = self.car.cycle(dt_ms).frames;
        for course in &self.courses {
            course.falsify(time_ms, self.car.sensors());
        }
        let mut due = Some(time_ms);
        for course in &mut self.courses {
            due =
                due.zip(course.frames(time_ms, self.edition, &mut frames)).map(|(one, other)| one.max(other));
        }
        if let Some(due) = due {
            self.delayed.push((due, frames));
        }
        let (now, later): (Vec<_>, Vec<_>) = self.delayed.drain(..).partition(|(due, _)| *due <= time_ms);
        self.delayed = later;
        self.note_change(before);
        now.into_iter().flat_map(|(_, frames)| frames).collect()
    }

    fn note_change(&mut self, from: Option<AsState>) {
        let to = self.state();
        if from != to {
            let inputs = self.car.inputs();
            let cause = self.car.outputs().map(|outputs| outputs.messages(inputs).status.shutdown_cause);
            let cause = cause.unwrap_or_default();
            self.changes.push(Change { time_ms: self.time_ms, from, to, cause });
        }
    }

    /// A frame was on the bus, complete at this time.
    pub(crate) fn came(&mut self, t_ns: i64, from: Node, frame: Frame) {
        self.look.frame(self.edition, from, &frame);
        let by_ai = from == Node::Ai;
        self.sent.push(Sent { t_ns, by_ai, frame });
        let id = u32::from(frame.id);
        let is_its_own =
            self.edition.bus.message(frame.id).is_some_and(|def| def.sender == messages::Node::Ai);
        if by_ai && !is_its_own {
            self.judge.sent_by_ai(t_ns, id);
        } else {
            self.judge.frame(t_ns, id, frame.data());
        }
        if by_ai {
            self.tally.frame(self.edition, &frame);
            // What does not decode is for the judge to tell.
            let _ = self.car.receive(&frame);
        }
    }

    /// So many frames were on the bus that nobody has seen.
    pub(crate) fn lost(&mut self, count: u64) {
        self.judge.lost(count);
    }

    /// Whether a bus can carry what the AI Computer sends, which is a flood if not.
    pub(crate) fn carries(&mut self, time_ms: u64, bus: &Wire) {
        let waiting = bus.waiting(Node::Ai);
        if waiting > FLOOD {
            self.flood.get_or_insert((time_ms, waiting));
        }
    }

    /// The cycle is over; whether the scenario is.
    pub(crate) fn end(&mut self, stack_runs: bool) -> bool {
        self.look.cycle(self.time_ms, &self.car, stack_runs);
        for course in &mut self.courses {
            course.look(&self.look);
        }
        for followed in &mut self.followed {
            followed.look(&self.look, self.edition, self.mission_ms);
        }
        self.tally.look(&self.look);
        self.time_ms += u64::from(self.cycle_ms());
        self.stuck = self.waits_in_vain();
        self.player.is_over() || self.stuck.is_some() || self.flood.is_some()
    }

    fn waits_in_vain(&self) -> Option<Stuck> {
        let waiting = self.player.waiting_for()?;
        let patience = match waiting.state {
            AsState::Finished => self.mission_ms + 2 * PATIENCE_MS,
            // The car may be on its way there.
            _ => PATIENCE_MS,
        };
        let waited_ms = self.time_ms.saturating_sub(waiting.since_ms);
        (waited_ms >= patience).then(|| Stuck {
            waiting,
            state: self.state(),
            waited_ms,
            missing: missing_for(&self.car, waiting.state),
        })
    }

    pub(crate) fn finish(self) -> Ran {
        Ran {
            duration_ms: self.time_ms,
            sent: self.sent,
            actions: self.actions,
            changes: self.changes,
            followed: self.followed,
            report: self.judge.finish(),
            tally: self.tally,
            stuck: self.stuck,
            flood: self.flood,
            failed: None,
        }
    }
}

fn ns(ms: u64) -> i64 {
    i64::try_from(ms).unwrap_or(i64::MAX / MS).saturating_mul(MS)
}
