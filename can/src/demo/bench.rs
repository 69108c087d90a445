//! The car and the AI Computer on a bus in simulated time, frame by frame: who calls decides what the operator does, and for how long.

use adsdv_spec::Machine;
use adsdv_spec::messages::Frame;

use super::slip::Slip;
use super::wire::{Node, Wire};
use crate::BITRATE;
use crate::ai::Ai;
use crate::car::{Car, Cycle};

/// A millisecond in nanoseconds.
const MS: i64 = 1_000_000;

/// The car, the AI Computer and the bus between them. It knows no clock: time goes on from frame to frame.
///
/// ```
/// use adsdv_can::ai::Ai;
/// use adsdv_can::demo::{Bench, Due};
/// use adsdv_spec::Machine;
///
/// let mut bench = Bench::new(Machine::REFERENCE, Ai::default(), 4);
/// let mut frames = 0;
/// while bench.time_ns() < 1_000_000_000 {
///     match bench.advance() {
///         Due::Frame(..) => frames += 1,
///         Due::VcuCycle => drop(bench.vcu_cycle()),
///     }
/// }
/// assert!(frames > 1000);
/// ```
#[derive(Debug)]
pub struct Bench {
    car: Car,
    ai: Ai,
    wire: Wire,
    /// When the next cycle of each begins.
    vcu_ns: i64,
    ai_ns: i64,
    slips: Vec<Slip>,
}

/// What comes next on the bench.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Due {
    /// A frame is complete on the bus, at a time in nanoseconds since the start; the other side has it.
    Frame(i64, Frame),
    /// The VCU's next cycle is due: whatever the operator does before it, it sees.
    VcuCycle,
}

impl Bench {
    /// Both have just been switched on. The AI Computer's cycle begins so many milliseconds after the VCU's.
    pub fn new(machine: Machine, ai: Ai, phase_ms: u32) -> Self {
        Self {
            car: Car::new(machine),
            ai,
            wire: Wire::new(BITRATE.into()),
            vcu_ns: 0,
            ai_ns: i64::from(phase_ms) * MS,
            slips: Vec::new(),
        }
    }

    /// Goes on to the next frame, or to the VCU's next cycle.
    pub fn advance(&mut self) -> Due {
        loop {
            if let Some((time_ns, from, frame)) = self.wire.complete(self.vcu_ns.min(self.ai_ns)) {
                match from {
                    // Both send what the document allows; were it otherwise, the judge would tell.
                    Node::Vcu => drop(self.ai.receive(&frame)),
                    Node::Ai => drop(self.car.receive(&frame)),
                }
                return Due::Frame(time_ns, frame);
            }
            if self.vcu_ns <= self.ai_ns {
                return Due::VcuCycle;
            }
            self.ai_cycle();
        }
    }

    /// The VCU's next cycle.
    pub fn vcu_cycle(&mut self) -> Cycle {
        let dt_ms = self.car.cycle_ms();
        let mut cycle = self.car.cycle(dt_ms);
        self.wire.send(self.vcu_ns, Node::Vcu, std::mem::take(&mut cycle.frames));
        self.vcu_ns += i64::from(dt_ms) * MS;
        cycle
    }

    fn ai_cycle(&mut self) {
        // The AI Computer's cycle is as long as the VCU's.
        let dt_ms = self.car.cycle_ms();
        let mut frames = self.ai.cycle(dt_ms);
        for slip in &self.slips {
            slip.spoil(&self.ai.edition().bus, &mut frames);
        }
        self.wire.send(self.ai_ns, Node::Ai, frames);
        self.ai_ns += i64::from(dt_ms) * MS;
    }

    /// When the VCU's next cycle begins, in nanoseconds since the start.
    pub const fn time_ns(&self) -> i64 {
        self.vcu_ns
    }

    /// The same in whole milliseconds.
    pub fn time_ms(&self) -> u64 {
        u64::try_from(self.vcu_ns / MS).unwrap_or_default()
    }

    /// The car.
    pub const fn car(&self) -> &Car {
        &self.car
    }

    /// The car, for the operator.
    pub const fn car_mut(&mut self) -> &mut Car {
        &mut self.car
    }

    /// What the AI Computer does wrong from its next cycle on.
    pub fn slips(&mut self, slips: &[Slip]) {
        self.slips = slips.to_vec();
    }
}
