//! One scenario: the car, its operator and its judge, cycle after cycle, with an AI Computer on the bus.
//!
//! ```text
//! 0 ms    the operator acts, the VCU steps and sends
//! 4 ms    the stack receives the frames that have come, and sends
//! 10 ms   the cycle is over: it is looked at
//! ```

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
use crate::program_error::StackError;
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
}

/// A scenario that does not read is a mistake of this crate: the tests read all of them.
pub(crate) fn run(
    scenario: &ExamScenario,
    edition: &'static Edition,
    mission_ms: u64,
    stack: &mut dyn Stack,
) -> Result<Ran, SessionError> {
    let operator: Scenario = scenario.operator.parse().map_err(SessionError::Scenario)?;
    let mut session = Session::new(scenario, &operator, edition, mission_ms);
    stack.reset().map_err(|error| SessionError::Stack(error.during(&scenario.name, 0)))?;
    loop {
        session.begin();
        session.bus_until(session.time_ms + PHASE_MS);
        session
            .ask(stack)
            .map_err(|error| SessionError::Stack(error.during(&scenario.name, session.time_ms)))?;
        session.bus_until(session.time_ms + session.cycle_ms);
        if session.end() {
            return Ok(session.finish());
        }
    }
}

/// Why there is nothing to say of a scenario.
#[derive(Debug)]
pub(crate) enum SessionError {
    Stack(StackError),
    Scenario(Unreadable),
}

struct Session<'a> {
    scenario: &'a ExamScenario,
    edition: &'static Edition,
    mission_ms: u64,
    cycle_ms: u64,
    time_ms: u64,
    car: Car,
    player: Player,
    wire: Wire,
    judge: Judge,
    look: Look,
    courses: Vec<Course>,
    followed: Vec<Followed>,
    /// Frames of the VCU that come later, and when.
    delayed: Vec<(u64, Vec<Frame>)>,
    /// The frames that the stack has not received yet.
    inbox: Vec<Frame>,
    sent: Vec<Sent>,
    actions: Vec<(u64, Action)>,
    changes: Vec<Change>,
    tally: Tally,
    stuck: Option<Stuck>,
    flood: Option<(u64, usize)>,
}

impl<'a> Session<'a> {
    fn new(
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
            cycle_ms: car.cycle_ms().into(),
            time_ms: 0,
            car,
            player: Player::new(operator),
            wire: Wire::new(BITRATE.into()),
            judge: Judge::new(JudgeOptions::of(edition)),
            look: Look::new(),
            courses: scenario.disturbances.iter().map(Course::new).collect(),
            followed: scenario.expects.iter().copied().map(Followed::new).collect(),
            delayed: Vec::new(),
            inbox: Vec::new(),
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

    /// The operator and the VCU.
    fn begin(&mut self) {
        let (time_ms, before) = (self.time_ms, self.state());
        for action in self.player.due(time_ms, before) {
            self.car.act(&action);
            self.actions.push((time_ms, action));
        }
        if time_ms < self.scenario.vcu_starts_ms {
            return;
        }
        let mut frames = self.car.cycle(self.car.cycle_ms()).frames;
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
        for (_, frames) in now {
            self.wire.send(ns(time_ms), Node::Vcu, frames);
        }
        self.note_change(before);
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

    /// The frames that are complete up to this time.
    fn bus_until(&mut self, until_ms: u64) {
        while let Some((t_ns, from, frame)) = self.wire.complete(ns(until_ms)) {
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
            } else {
                self.inbox.push(frame);
            }
        }
    }

    fn stack_runs(&self) -> bool {
        self.time_ms >= self.scenario.ai_starts_ms
    }

    fn ask(&mut self, stack: &mut dyn Stack) -> Result<(), StackError> {
        let inbox = std::mem::take(&mut self.inbox);
        if self.stack_runs() {
            let at = self.time_ms + PHASE_MS;
            self.wire.send(ns(at), Node::Ai, stack.step(at, &inbox)?);
            let waiting = self.wire.waiting(Node::Ai);
            if waiting > FLOOD {
                self.flood = Some((at, waiting));
            }
        }
        Ok(())
    }

    /// The cycle is over; whether the scenario is.
    fn end(&mut self) -> bool {
        self.look.cycle(self.time_ms, &self.car, self.stack_runs());
        for course in &mut self.courses {
            course.look(&self.look);
        }
        for followed in &mut self.followed {
            followed.look(&self.look, self.edition, self.mission_ms);
        }
        self.tally.look(&self.look);
        self.time_ms += self.cycle_ms;
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

    fn finish(self) -> Ran {
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
        }
    }
}

fn ns(ms: u64) -> i64 {
    i64::try_from(ms).unwrap_or(i64::MAX / MS).saturating_mul(MS)
}
