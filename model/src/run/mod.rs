//! A path through the open model as the run of a vehicle: raw inputs for its observations, and the frames on the bus.
//!
//! ```text
//! actions --> what each step reads --> raw inputs --> Machine::step --> frames, as a recorder sees them
//! ```
//!
//! A path says only what each step depends on. What it leaves open is chosen so that the log of the run tells what the
//! path does: see [`Run::new`]. A judge of logs knows that it sees samples, and that effects come late, so it says nothing
//! of what lasts for a cycle only. Conditions that hold for as long as they can, before and after the step that matters,
//! let it.

mod bus;

use adsdv_spec::{Atoms, Control, Edition, Faults, Inputs, Knowledge, Machine, Observation, Outputs, Reads};

use crate::action::Action;
use crate::cycle::cycle_ms;
use crate::document::Document;
use crate::vectors::{Vectors, varied};

/// Nanoseconds in a millisecond.
const MS: i64 = 1_000_000;

/// The cycle of the slowest message of all editions: of 502h.
const SLOWEST_MS: u32 = {
    let (mut slowest, mut place) = (0, 0);
    while place < Edition::ALL.len() {
        let (messages, mut message) = (Edition::ALL[place].bus.messages, 0);
        while message < messages.len() {
            if messages[message].cycle_ms > slowest {
                slowest = messages[message].cycle_ms;
            }
            message += 1;
        }
        place += 1;
    }
    slowest as u32
};

/// For how long a VCU shows `AS_OFF` after it was switched on, before it acts: 502h comes often enough to be known.
const POWER_UP_MS: u32 = 3 * SLOWEST_MS;

/// For how long nobody sends when the power is cycled. After half a second of silence a judge of logs takes nothing for
/// granted that the VCU may have remembered; this is twice as long.
const POWERLESS_MS: u32 = 1000;

/// For how many cycles before the first step its inputs are seen: longer than a judge's window, so that it is certain what
/// the VCU saw, and shorter than its deadline, so that it does not wonder why the VCU waits.
const LOOK_AHEAD_CYCLES: usize = 4;

/// For how many steps before the last one a condition that the machine does not read is as the last step wants it, even
/// if a property looks at it there: longer than a judge of logs holds possible that the VCU sees late what is on the bus.
const UNHEEDED_STEPS: usize = 6;

/// The run of a vehicle.
#[derive(Clone, Debug)]
pub struct Run {
    machine: Machine,
    cycles: Vec<Cycle>,
}

/// One cycle of a run: what the VCU saw, and what it made of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cycle {
    /// Which part of the run this is.
    pub phase: Phase,
    /// When the VCU makes its step, in nanoseconds since the log begins.
    pub t_ns: i64,
    /// What the VCU sees.
    pub inputs: Inputs,
    /// The control state before the step.
    pub before: Control,
    /// The control state after the step.
    pub after: Control,
    /// What the step shows to the outside.
    pub outputs: Outputs,
}

/// The parts of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Phase {
    /// The VCU was just switched on: it sends, but does not step yet. Every switch is off.
    PowerUp,
    /// A step of the path.
    Path,
    /// The path has ended; its last inputs stay.
    Persisting,
}

impl Run {
    /// How long inputs should stay after the last step, in milliseconds, for a judge of logs to see what that step was:
    /// longer than its deadline, and than some cycles of 502h, the slowest message.
    pub const AFTERMATH_MS: u32 = 5 * SLOWEST_MS;

    /// The run of a machine along a path from the power cycle.
    ///
    /// The steps are those of the path: [`Machine::step`] on the raw inputs leads to the control states that
    /// [`Machine::react`] leads to on the path's observations.
    ///
    /// A condition that neither the machine nor a property reads at a step is already as the next step that reads it wants
    /// it, so that it is seen to hold (or to fail) for longer than a cycle; where none does it stays as it was. Just before
    /// the last step it is enough that the machine does not read it: what a counterexample is about is seen for longer
    /// than a judge's window. Faults come and go only where they are read. A power cycle is a second in which nobody sends; all switches are off after it, and a VCU that comes back
    /// shows `AS_OFF` for a while before its first step, as at the beginning. To a judge of logs that is a gap, not a
    /// violation.
    ///
    /// ```
    /// use adsdv_model::{Action, Run};
    /// use adsdv_spec::{Atom, Atoms, Faults, Machine, Observation};
    ///
    /// let tsms = Observation::new(Atoms::NONE.with(Atom::Tsms), Faults::NONE);
    /// let run = Run::new(&Machine::REFERENCE, [Action::Step(tsms)]);
    /// let step = run.steps().next().expect("the path has a step");
    /// assert!(step.inputs.tsms && step.after.handshake.bit);
    /// ```
    pub fn new(machine: &Machine, path: impl IntoIterator<Item = Action>) -> Self {
        let path = plan(machine, path);
        let mut run = Self { machine: *machine, cycles: Vec::with_capacity(path.len()) };
        run.power_up(0);
        let mut powered_up = true;
        for planned in path {
            if let Some(step) = planned {
                let inputs = run.seen_by(&step);
                if std::mem::take(&mut powered_up) {
                    run.look_ahead(&inputs);
                }
                run.step(Phase::Path, inputs);
            } else {
                run.power_up(POWERLESS_MS);
                powered_up = true;
            }
        }
        run
    }

    /// The run of a machine that sees these inputs, one after the other.
    pub fn seeing(machine: &Machine, inputs: impl IntoIterator<Item = Inputs>) -> Self {
        let mut run = Self { machine: *machine, cycles: Vec::new() };
        run.power_up(0);
        for inputs in inputs {
            run.step(Phase::Path, inputs);
        }
        run
    }

    /// The run with its last inputs staying as they are for some time, so that what is wrong goes on being so: see
    /// [`AFTERMATH_MS`](Self::AFTERMATH_MS). The machine goes on stepping.
    ///
    /// The AI Computer goes on answering the handshake, unless it has left an edge unanswered for so long that the
    /// communication is lost: then it goes on not answering.
    #[must_use]
    pub fn persisting(mut self, ms: u32) -> Self {
        let limit = self.machine.edition().rules.timing.handshake_ms;
        let lost = self.control().handshake.is_lost(limit);
        let mut inputs = self.inputs();
        for _ in 0..ms.div_ceil(cycle_ms(&self.machine).max(1)) {
            if !lost {
                inputs.ai.status.handshake = self.control().handshake.bit;
            }
            self.step(Phase::Persisting, inputs);
        }
        self
    }

    /// The machine that runs.
    pub const fn machine(&self) -> &Machine {
        &self.machine
    }

    /// Every cycle, in the order of time.
    pub fn cycles(&self) -> &[Cycle] {
        &self.cycles
    }

    /// The steps of the path, one for each [`Action::Step`].
    pub fn steps(&self) -> impl Iterator<Item = &Cycle> {
        self.cycles.iter().filter(|cycle| cycle.phase == Phase::Path)
    }

    fn control(&self) -> Control {
        self.cycles.last().map_or(Control::INITIAL, |cycle| cycle.after)
    }

    fn inputs(&self) -> Inputs {
        self.cycles.last().map_or_else(Inputs::default, |cycle| cycle.inputs)
    }

    /// The VCU's cycle in nanoseconds.
    fn cycle_ns(&self) -> i64 {
        i64::from(cycle_ms(&self.machine)) * MS
    }

    /// When the next step is made, if nothing is in between. The AI Computer's frames take the half cycle before it.
    fn next_ns(&self) -> i64 {
        self.cycles.last().map_or(self.cycle_ns() / 2, |cycle| cycle.t_ns + self.cycle_ns())
    }

    /// The VCU was switched on, after this many milliseconds without power.
    fn power_up(&mut self, powerless_ms: u32) {
        let begin_ns = self.next_ns() + i64::from(powerless_ms) * MS;
        let control = Control::INITIAL;
        let outputs = Outputs {
            from: control.state,
            state: control.state,
            taken: None,
            atoms: Atoms::NONE,
            faults: Faults::NONE,
            shutdown_cause: control.shutdown_cause,
            handshake: control.handshake.bit,
            go_signal: false,
            handshake_lost: false,
            missed_ms: None,
        };
        let cycle_ns = self.cycle_ns();
        let cycles = (0..i64::from(POWER_UP_MS / cycle_ms(&self.machine).max(1))).map(|cycle| Cycle {
            phase: Phase::PowerUp,
            t_ns: begin_ns + cycle * cycle_ns,
            inputs: Inputs::default(),
            before: control,
            after: control,
            outputs,
        });
        self.cycles.extend(cycles);
    }

    /// What the first step after a power-up sees is already so shortly before it.
    fn look_ahead(&mut self, inputs: &Inputs) {
        let cycles = self.cycles.iter_mut().rev().take(LOOK_AHEAD_CYCLES);
        cycles.for_each(|cycle| cycle.inputs = *inputs);
    }

    /// What a step of the path sees.
    fn seen_by(&self, planned: &Planned) -> Inputs {
        let Planned { seen, reads, ahead } = planned;
        let thresholds = &self.machine.edition().rules.thresholds;
        let prepared = Reads { atoms: ahead.on().union(ahead.off()), faults: Faults::NONE };
        self.inputs()
            .showing(Observation::new(ahead.on(), Faults::NONE), &prepared, thresholds)
            .showing(*seen, reads, thresholds)
    }

    fn step(&mut self, phase: Phase, inputs: Inputs) {
        let (t_ns, before) = (self.next_ns(), self.control());
        let (after, outputs) = self.machine.step(&before, &inputs, cycle_ms(&self.machine));
        self.cycles.push(Cycle { phase, t_ns, inputs, before, after, outputs });
    }
}

/// A step of the path with what it reads.
struct Planned {
    seen: Observation,
    reads: Reads,
    /// Of each condition that this step or one after it reads, until the next power cycle, how it is read first.
    ahead: Knowledge,
}

/// The steps of a path; `None` is a power cycle.
fn plan(machine: &Machine, path: impl IntoIterator<Item = Action>) -> Vec<Option<Planned>> {
    let path: Vec<Action> = path.into_iter().collect();
    let document = Document::of_machine(machine).timing();
    let last = path.len().saturating_sub(1);
    let unheeded = last.saturating_sub(UNHEEDED_STEPS)..last;
    let mut control = Control::INITIAL;
    let mut planned: Vec<Option<Planned>> = path
        .into_iter()
        .enumerate()
        .map(|(place, action)| match action {
            Action::Step(seen) => {
                let reads = if unheeded.contains(&place) {
                    machine.reads(&control, cycle_ms(machine))
                } else {
                    varied(machine, document, &control, Vectors::Read)
                };
                control = machine.react(&control, seen, cycle_ms(machine)).control;
                Some(Planned { seen, reads, ahead: Knowledge::NOTHING })
            }
            Action::PowerCycle => {
                control = Control::INITIAL;
                None
            }
        })
        .collect();
    let mut ahead = Knowledge::NOTHING;
    for step in planned.iter_mut().rev() {
        match step {
            Some(Planned { seen, reads, ahead: of_step }) => {
                ahead = ahead.learn(reads.atoms, seen.atoms());
                *of_step = ahead;
            }
            None => ahead = Knowledge::NOTHING,
        }
    }
    planned
}
