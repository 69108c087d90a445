//! A simulated bus: a VCU, an AI Computer and an operator, recorded as a log would be.
//!
//! The VCU steps every 10 ms on what it last received, and sends its frames; the AI Computer answers half a cycle
//! later. What it records can be jittered and thinned as a real recorder does.
//!
//! `routes.rs` leads to every state, `atoms.rs` makes any condition true or false, `deeds.rs` does anything at all, `forced.rs`
//! is a VCU that does what a test forces on it instead of what the table says, `deviating.rs` one that remembers or shows something
//! else than the specification, and `recording.rs` is what a recorder and the judge
//! make of it all.

mod atoms;
mod deeds;
mod deviating;
mod forced;
mod random;
mod recording;
mod routes;

use adsdv_oracle::judge::{JudgeOptions, Report};
use adsdv_oracle::remote::{Remote, Switches};
use adsdv_spec::messages::{
    Ai2VcuBrake, Ai2VcuDriveF, Ai2VcuDriveR, Ai2VcuStatus, Ai2VcuSteer, Vcu2AiStatus,
};
use adsdv_spec::{AiMessages, Choice, Control, Edition, Inputs, Machine, Outputs, Readings};

use deviating::Deviating;

pub use deeds::{Chance, any_readings};
pub use random::Random;
pub use recording::{Recorded, judge, violations};

/// Nanoseconds in a millisecond.
pub const MS: i64 = 1_000_000;
const CYCLE_MS: u16 = Edition::DEFAULT.rules.timing.cycle_ms;
const CYCLE: i64 = CYCLE_MS as i64 * MS;

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
    /// The level of the remote control's E-stop bit while the button is pressed, where an edition has the remote control.
    pub estop_pressed: bool,
    /// Whether the AI Computer sends at all.
    pub ai_sends: bool,
    /// Whether the AI Computer answers the handshake.
    pub ai_answers: bool,
    /// The identifiers of those of its messages that it leaves out.
    pub mutes: Vec<u16>,
    /// Changes each message of 520h before it is sent: for a VCU that shows something else than it does.
    pub shows: fn(&mut Vcu2AiStatus),
    /// What it does otherwise than the specification, where that is no change of its table, its times or its thresholds.
    deviating: Option<Deviating>,
    /// The time.
    pub t: i64,
    /// When the EBS last changed.
    ebs_changed: i64,
    /// What was recorded.
    pub log: Vec<Recorded>,
    /// Each step: what the VCU remembered, and what it saw.
    pub steps: Vec<(Control, Inputs)>,
}

impl World {
    /// A world with this VCU, everything off, the AI Computer running.
    pub fn new(vcu: Machine) -> Self {
        Self {
            vcu,
            control: Control::INITIAL,
            inputs: Inputs::default(),
            ai: AiMessages::default(),
            estop_pressed: true,
            ai_sends: true,
            ai_answers: true,
            mutes: Vec::new(),
            shows: |_| {},
            deviating: None,
            t: 0,
            ebs_changed: 0,
            log: Vec::new(),
            steps: Vec::new(),
        }
    }

    /// A world with the reference VCU.
    pub fn reference() -> Self {
        Self::new(Machine::REFERENCE)
    }

    /// A world with the VCU of an edition.
    pub fn of(edition: &Edition) -> Self {
        Self::new(Machine::new(*edition, edition.readings))
    }

    /// A world with a VCU that takes one reading differently.
    pub fn with_reading(choice: Choice) -> Self {
        Self::new(Machine::new(*Edition::DEFAULT, Readings::DEFAULT.with(choice)))
    }

    /// The remote control's frame, on its way to the VCU shortly before its step.
    fn remote(&mut self) {
        let remote = Remote::of(&self.vcu.edition().bus).filter(|_| self.t > 0);
        let estop = self.inputs.sdc.remote_estop == self.estop_pressed;
        let frame = remote.and_then(|remote| remote.frame(Switches { go: self.inputs.go, estop }, 100));
        self.log.extend(frame.map(|frame| Recorded { t: self.t - 2 * MS, frame }));
    }

    /// One cycle.
    pub fn cycle(&mut self) {
        self.remote();
        self.steps.push((self.control, self.inputs));
        let outputs = self.step();
        let mut messages = outputs.messages(&self.inputs);
        (self.shows)(&mut messages.status);
        let bus = &self.vcu.edition().bus;
        for (place, mut frame) in (0..).zip(messages.frames(bus)) {
            if let Some(deviating) = &mut self.deviating {
                deviating.shows(&mut frame, &outputs, &self.inputs, self.t);
                messages.status.handshake = deviating.handshake(&frame).unwrap_or(messages.status.handshake);
            }
            if bus.message(frame.id).is_some_and(|message| self.t % (i64::from(message.cycle_ms) * MS) == 0) {
                self.log.push(Recorded { t: self.t + place * MS / 4, frame });
            }
        }
        if self.ai_answers {
            self.ai.status.handshake = messages.status.handshake;
        }
        self.inputs.ai_silence = self.inputs.ai_silence.after(CYCLE_MS.into());
        let sent = self.ai.frames(bus);
        for (place, frame) in (0..).zip(sent) {
            if !self.sends(frame.id) {
                continue;
            }
            self.log.push(Recorded { t: self.t + CYCLE / 2 + place * MS / 4, frame });
            self.inputs.ai_silence.end(frame.id);
            match frame.id {
                Ai2VcuStatus::ID => self.inputs.ai.status = self.ai.status,
                Ai2VcuDriveF::ID => self.inputs.ai.drive_f = self.ai.drive_f,
                Ai2VcuDriveR::ID => self.inputs.ai.drive_r = self.ai.drive_r,
                Ai2VcuSteer::ID => self.inputs.ai.steer = self.ai.steer,
                Ai2VcuBrake::ID => self.inputs.ai.brake = self.ai.brake,
                _ => {}
            }
        }
        self.t += CYCLE;
    }

    /// A step of the VCU.
    fn step(&mut self) -> Outputs {
        let dt_ms = CYCLE_MS.into();
        let (control, outputs) = match &mut self.deviating {
            Some(deviating) => deviating.step(&self.inputs, dt_ms),
            None => self.vcu.step(&self.control, &self.inputs, dt_ms),
        };
        self.control = control;
        outputs
    }

    /// Whether the AI Computer sends messages of this identifier.
    fn sends(&self, id: u16) -> bool {
        self.ai_sends && !self.mutes.contains(&id)
    }

    /// Lets this many milliseconds pass.
    pub fn wait(&mut self, ms: i64) {
        let end = self.t + ms * MS;
        while self.t < end {
            self.cycle();
        }
    }

    /// What the judge says of the recording.
    pub fn judge(&self, options: JudgeOptions) -> Report {
        judge(&self.log, options)
    }
}
