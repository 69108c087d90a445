//! A whole mission without any CAN.
//!
//! [`run`] has the car and the AI Computer on a bus within the program, in simulated time: a mission of half a minute takes a
//! few hundredths of a second. [`LocalBus`] is a bus with the AI Computer on it in real time, for the loop that otherwise has
//! SocketCAN before it. [`Bench`] is what [`run`] drives, for who drives it otherwise: frame by frame, with an AI Computer that makes
//! mistakes.

mod bench;
mod local;
mod slip;
pub mod wire;

use std::fmt;

use adsdv_oracle::candump::{FrameKind, Record};
use adsdv_spec::Machine;
use adsdv_spec::messages::{AsState, Frame};

use crate::ai::Ai;
use crate::car::{Action, missing_for};
use crate::scenario::{PATIENCE_MS, Player, Scenario, Stuck};

pub use bench::{Bench, Due};
pub use local::LocalBus;
pub use slip::Slip;

/// The name of the bus in logs.
pub const BUS: &str = "demo";

/// A frame of that bus as an entry of a log, at a time in nanoseconds.
pub fn record(time_ns: i64, frame: &Frame) -> Record<'_> {
    Record {
        line: 0,
        time_ns,
        interface: BUS,
        kind: FrameKind::Standard,
        id: frame.id.into(),
        data: frame.data(),
        direction: None,
        terminated: true,
    }
}

/// How a run is made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DemoOptions {
    /// For how long a scenario may wait for a state, in milliseconds of simulated time.
    pub patience_ms: u64,
    /// How long after the VCU's cycle that of the AI Computer begins, in milliseconds.
    pub phase_ms: u32,
    /// For how long the run goes on after the last line of a scenario that has no `end`, in milliseconds.
    pub tail_ms: u64,
}

impl Default for DemoOptions {
    /// Ten minutes of patience, 4 ms, and a second.
    fn default() -> Self {
        Self { patience_ms: PATIENCE_MS, phase_ms: 4, tail_ms: 1000 }
    }
}

/// What came of a run, or has come of it so far.
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
        stuck: Box<Stuck>,
        /// What came of the run until then.
        run: Box<Run>,
    },
    /// The frames could not be taken.
    Sink(E),
}

impl<E: fmt::Display> fmt::Display for RunError<E> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Waits { stuck, .. } => write!(f, "{stuck}"),
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
/// use adsdv_can::demo::{DemoOptions, run};
/// use adsdv_can::scenario::Scenario;
/// use adsdv_oracle::judge::{self, Judge, Verdict};
///
/// let mut judge = Judge::new(judge::JudgeOptions::default());
/// let run = run(&Scenario::mission(), Ai::default(), &DemoOptions::default(), |time_ns, frame| {
///     judge.frame(time_ns, frame.id.into(), frame.data());
///     Ok::<(), std::convert::Infallible>(())
/// })?;
/// assert!(run.distance_m > 40.0);
/// assert_eq!(judge.finish().verdict(), Verdict::Conforms);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
///
/// Fails if `sink` does, or if the scenario waits longer for a state than the options have patience.
pub fn run<E>(
    scenario: &Scenario,
    ai: Ai,
    options: &DemoOptions,
    mut sink: impl FnMut(i64, &Frame) -> Result<(), E>,
) -> Result<Run, RunError<E>> {
    let mut run = Running::new(scenario, ai, options);
    loop {
        match run.bench.advance() {
            Due::Frame(time_ns, frame) => {
                sink(time_ns, &frame).map_err(RunError::Sink)?;
                run.frames += 1;
            }
            Due::VcuCycle if run.is_over(options) => return Ok(run.result()),
            Due::VcuCycle => {
                if let Some(stuck) = run.stuck(options) {
                    return Err(RunError::Waits { stuck: Box::new(stuck), run: Box::new(run.result()) });
                }
                run.vcu_cycle();
            }
        }
    }
}

/// A run that is under way.
struct Running {
    bench: Bench,
    player: Player,
    /// The state of the last cycle.
    state: Option<AsState>,
    /// Since when every line of the scenario has taken place, in milliseconds.
    done_at_ms: Option<u64>,
    /// What the operator did, and when.
    actions: Vec<(u64, Action)>,
    frames: u64,
}

impl Running {
    fn new(scenario: &Scenario, ai: Ai, options: &DemoOptions) -> Self {
        // Both sides follow the edition of the AI Computer.
        let machine = Machine::new(*ai.edition(), ai.edition().readings);
        Self {
            bench: Bench::new(machine, ai, options.phase_ms),
            player: Player::new(scenario),
            state: None,
            done_at_ms: None,
            actions: Vec::new(),
            frames: 0,
        }
    }

    fn time_ms(&self) -> u64 {
        self.bench.time_ms()
    }

    fn vcu_cycle(&mut self) {
        let time_ms = self.time_ms();
        for action in self.player.due(time_ms, self.state) {
            self.bench.car_mut().act(&action);
            self.actions.push((time_ms, action));
        }
        if self.player.is_done() {
            self.done_at_ms.get_or_insert(time_ms);
        }
        self.state = self.bench.vcu_cycle().state();
    }

    /// Whether the run ends before the next cycle.
    fn is_over(&self, options: &DemoOptions) -> bool {
        let over = |done_at: u64| self.time_ms() > done_at.saturating_add(options.tail_ms);
        self.player.is_over() || self.done_at_ms.is_some_and(over)
    }

    fn stuck(&self, options: &DemoOptions) -> Option<Stuck> {
        self.player.stuck(self.time_ms(), options.patience_ms, |state| missing_for(self.bench.car(), state))
    }

    fn result(self) -> Run {
        Run {
            duration_ms: self.time_ms(),
            frames: self.frames,
            actions: self.actions,
            state: self.state,
            distance_m: self.bench.car().vehicle().distance_m(),
        }
    }
}
