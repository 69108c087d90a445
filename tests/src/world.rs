//! A simulated bus: a VCU, an AI Computer and an operator, recorded as a log would be.
//!
//! The VCU steps every 10 ms on what it last received, and sends its frames; the AI Computer answers half a cycle
//! later. What it records can be jittered and thinned as a real recorder does.

use adsdv_oracle::judge::{Judge, Options, Report};
use adsdv_spec::messages::{
    AmiState, DirectionRequest, EbsState, Frame, Message, MissionStatus, Vcu2AiStatus, Vcu2AiWheelSpeeds,
    WheelSpeed,
};
use adsdv_spec::{AiMessages, Choice, Control, Inputs, Interface, Machine, Readings};

/// Nanoseconds in a millisecond.
pub const MS: i64 = 1_000_000;
const CYCLE: i64 = 10 * MS;

/// A small generator of random numbers (SplitMix64), so that every run is the same.
#[derive(Clone, Debug)]
pub struct Random(pub u64);

impl Random {
    /// The next 64 random bits.
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// A number below `n`.
    pub fn below(&mut self, n: u64) -> u64 {
        self.bits() % n.max(1)
    }

    /// True once in `n` times.
    pub fn one_in(&mut self, n: u64) -> bool {
        self.below(n) == 0
    }

    /// One of the values.
    pub fn pick<T: Copy>(&mut self, values: &[T]) -> T {
        values[usize::try_from(self.below(values.len() as u64)).unwrap_or(0)]
    }
}

/// A frame of the recording.
#[derive(Clone, Copy, Debug)]
pub struct Recorded {
    /// When, in nanoseconds.
    pub t: i64,
    /// What.
    pub frame: Frame,
}

/// The simulated world.
#[derive(Clone, Debug)]
pub struct World {
    /// The VCU under test.
    pub vcu: Machine,
    /// What it remembers.
    pub control: Control,
    /// What it sees; the AI Computer's messages are replaced by those that it received.
    pub inputs: Inputs,
    /// What the AI Computer sends.
    pub ai: AiMessages,
    /// Whether the AI Computer sends at all.
    pub ai_sends: bool,
    /// Whether the AI Computer answers the handshake.
    pub ai_answers: bool,
    /// Changes each message of 520h before it is sent: for a VCU that tells something else than it does.
    pub tells: fn(&mut Vcu2AiStatus),
    /// The time.
    pub t: i64,
    /// What was recorded.
    pub log: Vec<Recorded>,
}

impl World {
    /// A world with this VCU, everything off, the AI Computer running.
    pub fn new(vcu: Machine) -> Self {
        Self {
            vcu,
            control: Control::INITIAL,
            inputs: Inputs::default(),
            ai: AiMessages::default(),
            ai_sends: true,
            ai_answers: true,
            tells: |_| {},
            t: 0,
            log: Vec::new(),
        }
    }

    /// A world with the reference VCU.
    pub fn reference() -> Self {
        Self::new(Machine::REFERENCE)
    }

    /// A world with a VCU that takes one reading differently.
    pub fn with_reading(choice: Choice) -> Self {
        Self::new(Machine::new(Interface::V3_0, Readings::DEFAULT.with(choice)))
    }

    /// One cycle.
    pub fn cycle(&mut self) {
        let (control, outputs) = self.vcu.step(&self.control, &self.inputs, 10);
        self.control = control;
        let mut messages = outputs.messages(&self.inputs);
        (self.tells)(&mut messages.status);
        let slow = self.t % (100 * MS) == 0;
        for (place, frame) in (0..).zip(messages.frames()) {
            if slow || frame.id != adsdv_spec::messages::Vcu2LogStatus::ID {
                self.log.push(Recorded { t: self.t + place * MS / 4, frame });
            }
        }
        if self.ai_answers {
            self.ai.status.handshake = messages.status.handshake;
        }
        if self.ai_sends {
            let AiMessages { status, drive_f, drive_r, steer, brake } = self.ai;
            let frames =
                [status.encode(), drive_f.encode(), drive_r.encode(), steer.encode(), brake.encode()];
            for (place, frame) in (0..).zip(frames) {
                self.log.push(Recorded { t: self.t + CYCLE / 2 + place * MS / 4, frame });
            }
            self.inputs.ai = self.ai;
        }
        self.t += CYCLE;
    }

    /// Lets this many milliseconds pass.
    pub fn wait(&mut self, ms: i64) {
        let end = self.t + ms * MS;
        while self.t < end {
            self.cycle();
        }
    }

    /// Sets all four wheel speeds.
    pub fn wheels(&mut self, rpm: i32) {
        let speed = WheelSpeed::clamped(rpm);
        self.inputs.vehicle.wheel_speeds = Vcu2AiWheelSpeeds {
            fl_wheel_speed: speed,
            fr_wheel_speed: speed,
            rl_wheel_speed: speed,
            rr_wheel_speed: speed,
        };
    }

    /// The operator prepares: everything that leads to AS_READY but ASMS.
    pub fn prepare(&mut self) {
        self.wait(300);
        self.inputs.tsms = true;
        self.inputs.ami = AmiState::TrackDrive;
        self.inputs.ebs = EbsState::Armed;
        self.wait(500);
        self.ai.status.mission_status = MissionStatus::Selected;
        self.wait(500);
    }

    /// To AS_READY.
    pub fn ready(&mut self) {
        self.prepare();
        self.inputs.asms = true;
        self.wait(500);
    }

    /// To AS_READY, with the dwell over.
    pub fn dwelt(&mut self) {
        self.ready();
        self.wait(6000);
    }

    /// To AS_DRIVING, with the wheels turning.
    pub fn driving(&mut self) {
        self.dwelt();
        self.inputs.go = true;
        self.wait(500);
        self.ai.status.mission_status = MissionStatus::Running;
        self.ai.status.direction_request = DirectionRequest::Forward;
        self.wait(500);
        self.wheels(200);
        self.wait(1000);
    }

    /// To AS_DRIVING, stopped again.
    pub fn stopped(&mut self) {
        self.driving();
        self.wheels(0);
        self.wait(500);
    }

    /// To AS_FINISHED.
    pub fn finished(&mut self) {
        self.stopped();
        self.ai.status.mission_status = MissionStatus::Finished;
        self.wait(500);
    }

    /// What the judge says of the recording.
    pub fn judge(&self, options: Options) -> Report {
        judge(&self.log, options)
    }

    /// The recording with each time stamp late by up to `jitter`, and one in `loss` frames lost.
    pub fn disturbed(&self, seed: u64, jitter: i64, loss: u64) -> Vec<Recorded> {
        let mut random = Random(seed);
        // A recorder may swap messages, but not two of the same identifier.
        let mut last = std::collections::HashMap::new();
        let mut log: Vec<Recorded> = self
            .log
            .iter()
            .filter_map(|recorded| {
                let late = if jitter > 0 { random.below(jitter.unsigned_abs()).cast_signed() } else { 0 };
                let lost = loss > 0 && random.one_in(loss);
                let before = last.entry(recorded.frame.id).or_insert(0);
                let t = (recorded.t + late).max(*before);
                *before = t;
                (!lost).then_some(Recorded { t, ..*recorded })
            })
            .collect();
        log.sort_by_key(|recorded| recorded.t);
        log
    }
}

/// What the judge says of a recording.
pub fn judge(log: &[Recorded], options: Options) -> Report {
    let mut judge = Judge::new(options);
    let origin = log.first().map_or(0, |first| first.t);
    for recorded in log {
        judge.frame(recorded.t - origin, recorded.frame.id.into(), recorded.frame.data());
    }
    judge.finish()
}

/// The findings that matter, a line each.
pub fn violations(report: &Report) -> Vec<String> {
    report
        .findings
        .iter()
        .filter(|finding| finding.severity == adsdv_oracle::judge::Severity::Violation)
        .map(|f| {
            #[allow(clippy::cast_precision_loss)]
            let t = f.t_ns as f64 / 1e9;
            format!("{t:.3} {} {} {}: {}", f.party.name(), f.clause, f.rule.id(), f.message)
        })
        .collect()
}
