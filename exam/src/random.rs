//! Scenarios by chance: what an operator may do in each state, one thing after the other, and what may go wrong meanwhile.

use adsdv_can::car::{Physics, Switch};
use adsdv_can::scenario::When::{self, After, At, State};
use adsdv_spec::messages::AsState;
use fastrand::Rng;

use crate::disturbance::{Disturbance, Effect, Onset, Sensors};
use crate::scenario::ExamScenario;
use crate::scenarios::completes;

/// The seed where nobody asks for another.
pub const SEED: u64 = 1;

/// An operator does no more than this many things in a row; then the scenario ends.
const TURNS: usize = 5;

/// So many scenarios by chance: the same seed has the same ones, on every machine.
///
/// ```
/// use adsdv_exam::random_scenarios;
///
/// let scenarios = random_scenarios(1, 3);
/// assert_eq!(scenarios[2].name, "random-2");
/// assert_eq!(scenarios[2].to_string(), random_scenarios(1, 3)[2].to_string());
/// ```
pub fn random_scenarios(seed: u64, runs: u32) -> Vec<ExamScenario> {
    let start = Rng::with_seed(seed).u64(..);
    let one = |number: u32| {
        let rng = Rng::with_seed(start ^ u64::from(number).wrapping_mul(0x9E37_79B9_7F4A_7C15));
        Draft { rng, lines: Vec::new(), disturbances: Vec::new() }.scenario(seed, number)
    };
    (0..runs).map(one).collect()
}

struct Draft {
    rng: Rng,
    lines: Vec<String>,
    disturbances: Vec<Disturbance>,
}

/// What the operator waits for next.
enum Next {
    Ready,
    Driving,
    Emergency,
    End,
}

impl Draft {
    fn scenario(mut self, seed: u64, number: u32) -> ExamScenario {
        let late = [0, 0, 0, 0, 0, 0, 0, 0, 1000, 3000];
        let vcu_starts_ms = self.one_of(&late);
        let ai_starts_ms = if vcu_starts_ms == 0 { self.one_of(&late) } else { 0 };
        self.switches_on(vcu_starts_ms.max(ai_starts_ms));
        let mut next = Next::Ready;
        for _ in 0..TURNS {
            next = match next {
                Next::Ready => self.in_ready(),
                Next::Driving => self.in_driving(),
                Next::Emergency => self.in_emergency(),
                Next::End => break,
            };
        }
        if !matches!(next, Next::End) {
            let ms = self.between(500, 2000);
            self.line(After(ms), "end");
        }
        for _ in 0..self.one_of(&[0, 0, 1, 1, 2]) {
            let disturbance = self.disturbance();
            self.disturbances.push(disturbance);
        }
        ExamScenario {
            name: format!("random-{number}"),
            about: format!("scenario {number} of seed {seed}"),
            operator: self.lines.concat(),
            disturbances: self.disturbances,
            expects: completes(),
            vcu_starts_ms,
            ai_starts_ms,
            physics: Physics::DEFAULT,
        }
    }

    /// A time in milliseconds, at a cycle.
    fn between(&mut self, from_ms: u32, to_ms: u32) -> u32 {
        self.rng.u32(from_ms / 10..=to_ms / 10) * 10
    }

    fn one_of<T: Copy + Default>(&mut self, from: &[T]) -> T {
        self.rng.choice(from).copied().unwrap_or_default()
    }

    fn line(&mut self, when: When, doing: &str) {
        self.lines.push(format!("{when} {doing}\n"));
    }

    fn after(&mut self, from_ms: u32, to_ms: u32, doing: &str) {
        let ms = self.between(from_ms, to_ms);
        self.line(After(ms), doing);
    }

    fn when(&mut self, state: AsState, from_ms: u32, to_ms: u32, doing: &str) {
        let ms = self.between(from_ms, to_ms);
        self.line(State(state, ms), doing);
    }

    fn mission(&mut self) -> String {
        let Some(ami) = Switch::named("ami") else { return String::new() };
        let missions: Vec<i32> = ami.positions().into_iter().filter(|raw| *raw != 0).collect();
        ami.position(self.one_of(&missions))
    }

    /// From nothing to AS_READY, once both sides are on.
    fn switches_on(&mut self, both_ms: u64) {
        let mission = self.mission();
        let select = format!("ami {mission}");
        let armed_ms = u32::try_from(both_ms).unwrap_or_default();
        if self.rng.u8(..20) == 0 {
            // It has to be turned off again for the car to drive.
            self.line(At(0), "go on");
            self.line(At(armed_ms), "ebs ARMED");
            self.after(500, 3000, "go off");
        } else {
            self.line(At(armed_ms), "ebs ARMED");
        }
        let mut steps = [select.as_str(), "tsms on", "asms on"];
        self.rng.shuffle(&mut steps);
        for step in steps {
            self.after(0, 1500, step);
        }
        if self.rng.u8(..10) == 0 {
            let select = format!("ami {}", self.mission());
            // Not in AS_READY yet, or just so.
            self.after(0, 1500, &select);
        }
    }

    fn in_ready(&mut self) -> Next {
        let ready = AsState::Ready;
        match self.rng.u8(..20) {
            0..10 => self.when(ready, 5100, 9000, "go on"),
            10..12 => self.when(ready, 10_000, 40_000, "go on"),
            12..15 => {
                self.when(ready, 0, 4900, "go on");
                self.after(20, 1000, "go off");
                self.after(5100, 8000, "go on");
            }
            15..17 => {
                self.when(ready, 0, 8000, "asms off");
                self.when(AsState::Off, 20, 3000, "asms on");
                return Next::Ready;
            }
            17 => {
                self.when(ready, 0, 8000, "power cycle");
                self.after(3000, 5000, "asms off");
                self.after(500, 3000, "asms on");
                return Next::Ready;
            }
            18 => {
                self.when(ready, 0, 8000, "remote_estop on");
                return Next::Emergency;
            }
            _ => {
                self.when(ready, 0, 3000, "end");
                return Next::End;
            }
        }
        Next::Driving
    }

    fn in_driving(&mut self) -> Next {
        let (driving, finished) = (AsState::Driving, AsState::Finished);
        match self.rng.u8(..10) {
            0..4 => {
                self.when(finished, 0, 2000, "go off, asms off");
                let select = format!("ami {}", self.mission());
                self.after(100, 500, "ami NOT_SELECTED");
                self.after(500, 2000, &select);
                self.after(500, 3000, "asms on");
                Next::Ready
            }
            4 => {
                self.when(finished, 0, 2000, "remote_estop on");
                Next::Emergency
            }
            5 => {
                self.when(driving, 0, 6000, "go off, asms off, power cycle");
                // The car rolls out meanwhile.
                self.line(After(30_000), "asms on");
                Next::Ready
            }
            _ => {
                let stop = self.rng.choice(["go off", "asms off", "remote_estop on", "vehicle_estop on"]);
                self.when(driving, 0, 6000, stop.unwrap_or("go off"));
                Next::Emergency
            }
        }
    }

    fn in_emergency(&mut self) -> Next {
        if self.rng.bool() {
            self.when(AsState::EmergencyBrake, 500, 3000, "end");
            return Next::End;
        }
        self.when(AsState::EmergencyBrake, 15_500, 17_000, "asms off, go off");
        self.after(100, 500, "remote_estop off, vehicle_estop off, power cycle");
        self.after(2500, 4000, "asms on");
        Next::Ready
    }

    fn disturbance(&mut self) -> Disturbance {
        let from =
            self.rng.choice([Onset::Start, Onset::State(AsState::Ready), Onset::State(AsState::Driving)]);
        let from = from.unwrap_or(Onset::Start);
        let after_ms = u64::from(self.between(0, 6000));
        let long_ms = u64::from(self.between(100, 30_000));
        let short_ms = u64::from(self.between(10, 50));
        let of = |effect, for_ms| Disturbance { from, after_ms, for_ms, effect };
        match self.rng.u8(..10) {
            0..2 => of(Effect::Loses(self.rng.u64(2..=5)), long_ms),
            2..4 => of(Effect::Delays(10 * self.rng.u64(1..=2)), long_ms),
            4 => of(Effect::Gathers(20), long_ms),
            5 => of(Effect::Silences, short_ms),
            6 => of(Effect::Silences, long_ms.min(2000)),
            7 => of(Effect::HoldsHandshake, short_ms),
            8 => of(Effect::Sensors(Sensors::WheelStands), long_ms),
            _ => {
                let sensors = self.rng.choice([Sensors::WheelSpins, Sensors::SpeedStays]);
                let effect = Effect::Sensors(sensors.unwrap_or(Sensors::WheelSpins));
                Disturbance { from: Onset::Braking, after_ms: 0, for_ms: long_ms.min(4000), effect }
            }
        }
    }
}
