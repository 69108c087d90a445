//! A whole mission without any CAN.
//!
//! [`run`] has the car and the AI Computer on a bus within the program, in simulated time: a mission of half a minute takes a
//! few hundredths of a second. [`LocalBus`] is a bus with the AI Computer on it in real time, for the loop that otherwise has
//! SocketCAN before it.

mod local;
mod wire;

use std::fmt;

use adsdv_spec::Machine;
use adsdv_spec::messages::{AsState, Frame};

use crate::ai::Ai;
use crate::car::{Action, Car, Missing, missing};
use crate::scenario::{Player, Scenario, Waiting};

pub use local::LocalBus;
use wire::{Node, Wire};

/// The name of the bus in logs.
pub const BUS: &str = "demo";

/// The bit rate of the bus, in bits per second (section 1).
pub const BIT_RATE: i64 = 500_000;

/// A millisecond in nanoseconds.
const MS: i64 = 1_000_000;

/// How a run is made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Options {
    /// For how long a scenario may wait for a state, in milliseconds of simulated time.
    pub patience_ms: u64,
    /// How long after the VCU's cycle that of the AI Computer begins, in milliseconds.
    pub phase_ms: u32,
    /// For how long the run goes on after the last line of a scenario that has no `end`, in milliseconds.
    pub tail_ms: u64,
}

impl Default for Options {
    /// Ten minutes of patience, 4 ms, and a second.
    fn default() -> Self {
        Self { patience_ms: 600_000, phase_ms: 4, tail_ms: 1000 }
    }
}

/// What came of a run.
#[derive(Clone, Debug)]
pub struct Run {
    /// How long it was, in milliseconds of simulated time.
    pub duration_ms: u64,
    /// How many frames were on the bus.
    pub frames: u64,
    /// What the operator did, and when, in milliseconds since the start.
    pub actions: Vec<(u64, Action)>,
    /// The state at the end; `None` if the VCU was without power.
    pub state: Option<AsState>,
    /// How far the car came, in metres.
    pub distance_m: f64,
}

/// Why a run did not come to its end.
#[derive(Debug)]
pub enum RunError<E> {
    /// The scenario waits for a state that does not come.
    Waits {
        /// What it waits for.
        waiting: Waiting,
        /// The state that it has instead; `None` if the VCU is without power.
        state: Option<AsState>,
        /// For how long it has waited, in milliseconds of simulated time.
        waited_ms: u64,
        /// What is missing for the next arrow on the way to `AS_DRIVING`.
        missing: Option<Missing>,
    },
    /// The frames could not be taken.
    Sink(E),
}

impl<E: fmt::Display> fmt::Display for RunError<E> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Waits { waiting: Waiting { line, state: wanted, .. }, state, waited_ms, missing } => {
                let found = state.map_or("a VCU without power", AsState::name);
                let seconds = waited_ms / 1000;
                write!(f, "line {line}: expected {wanted}, found {found} after {seconds} s")?;
                match missing {
                    Some(Missing { to, clause, conditions }) if !conditions.is_empty() => {
                        write!(f, "; {to} (section {clause}) still needs: {}", conditions.join(", "))
                    }
                    _ => Ok(()),
                }
            }
            Self::Sink(error) => write!(f, "{error}"),
        }
    }
}

impl<E: std::error::Error + 'static> std::error::Error for RunError<E> {}

/// Runs a scenario to its end: the reference VCU with its car, and the AI Computer, on a bus in simulated time.
///
/// `sink` is given every frame when it is complete on the bus, with the time in nanoseconds since the start.
///
/// ```
/// use adsdv_can::ai::Ai;
/// use adsdv_can::demo::{Options, run};
/// use adsdv_can::scenario::Scenario;
/// use adsdv_oracle::judge::{self, Judge, Verdict};
///
/// let mut judge = Judge::new(judge::Options::default());
/// let run = run(&Scenario::mission(), Ai::default(), &Options::default(), |time_ns, frame| {
///     judge.frame(time_ns, frame.id.into(), frame.data());
///     Ok::<(), std::convert::Infallible>(())
/// })?;
/// assert!(run.distance_m > 40.0);
/// assert_eq!(judge.finish().verdict(), Verdict::Conforms);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn run<E>(
    scenario: &Scenario,
    ai: Ai,
    options: &Options,
    mut sink: impl FnMut(i64, &Frame) -> Result<(), E>,
) -> Result<Run, RunError<E>> {
    let mut run = Running::new(scenario, ai, options);
    loop {
        let vcu = run.vcu_ns;
        let ai = run.ai_ns;
        if let Some((time_ns, from, frame)) = run.wire.complete(vcu.min(ai)) {
            sink(time_ns, &frame).map_err(RunError::Sink)?;
            run.deliver(from, &frame);
        } else if vcu <= ai {
            if run.is_over(options) {
                return Ok(run.result());
            }
            run.is_patient(options)?;
            run.vcu_cycle();
        } else {
            run.ai_cycle();
        }
    }
}

/// A run that is under way.
struct Running {
    car: Car,
    ai: Ai,
    player: Player,
    wire: Wire,
    /// The state of the last cycle.
    state: Option<AsState>,
    /// When the next cycle of each begins.
    vcu_ns: i64,
    ai_ns: i64,
    /// Since when every line of the scenario has taken place, in milliseconds.
    done_at_ms: Option<u64>,
    /// What the operator did, and when.
    actions: Vec<(u64, Action)>,
    frames: u64,
}

impl Running {
    fn new(scenario: &Scenario, ai: Ai, options: &Options) -> Self {
        Self {
            car: Car::new(Machine::REFERENCE),
            ai,
            player: Player::new(scenario),
            wire: Wire::new(BIT_RATE),
            state: None,
            vcu_ns: 0,
            ai_ns: i64::from(options.phase_ms) * MS,
            done_at_ms: None,
            actions: Vec::new(),
            frames: 0,
        }
    }

    fn time_ms(&self) -> u64 {
        u64::try_from(self.vcu_ns / MS).unwrap_or_default()
    }

    fn deliver(&mut self, from: Node, frame: &Frame) {
        self.frames += 1;
        match from {
            Node::Vcu => self.ai.receive(frame),
            // The AI Computer sends what the document allows; were it otherwise, the judge would tell.
            Node::Ai => drop(self.car.receive(frame)),
        }
    }

    fn vcu_cycle(&mut self) {
        let time_ms = self.time_ms();
        for action in self.player.due(time_ms, self.state) {
            self.car.act(&action);
            self.actions.push((time_ms, action));
        }
        if self.player.is_done() {
            self.done_at_ms.get_or_insert(time_ms);
        }
        let dt_ms = self.car.cycle_ms();
        let cycle = self.car.cycle(dt_ms);
        self.state = cycle.state();
        self.wire.send(self.vcu_ns, Node::Vcu, cycle.frames);
        self.vcu_ns += i64::from(dt_ms) * MS;
    }

    fn ai_cycle(&mut self) {
        // The AI Computer's cycle is as long as the VCU's.
        let dt_ms = self.car.cycle_ms();
        let frames = self.ai.cycle(dt_ms);
        self.wire.send(self.ai_ns, Node::Ai, frames);
        self.ai_ns += i64::from(dt_ms) * MS;
    }

    /// Whether the run ends before the next cycle.
    fn is_over(&self, options: &Options) -> bool {
        let over = |done_at: u64| self.time_ms() > done_at.saturating_add(options.tail_ms);
        self.player.is_over() || self.done_at_ms.is_some_and(over)
    }

    fn is_patient<E>(&self, options: &Options) -> Result<(), RunError<E>> {
        let Some(waiting) = self.player.waiting_for() else { return Ok(()) };
        let waited_ms = self.time_ms().saturating_sub(waiting.since_ms);
        if waited_ms < options.patience_ms {
            return Ok(());
        }
        Err(RunError::Waits { waiting, state: self.state, waited_ms, missing: missing(&self.car) })
    }

    fn result(self) -> Run {
        Run {
            duration_ms: self.time_ms(),
            frames: self.frames,
            actions: self.actions,
            state: self.state,
            distance_m: self.car.vehicle().distance_m(),
        }
    }
}
