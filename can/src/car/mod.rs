//! The car beside the AI Computer: the reference VCU, the operator's switches, and a simple vehicle.
//!
//! ```text
//! operator's actions --> inputs --> Machine::step --> outputs --> frames
//! AI's frames --------->   ^                             |
//!                          +--- vehicle <--- actuation --+
//! ```
//!
//! A [`Car`] is pure: it gets the frames that came, what the operator does and how much time has passed, and answers with
//! the frames to send. What reaches the actuators and what stands in the frames is for [`adsdv_spec::Outputs`] to say.
//!
//! Where an edition has the vehicle's devices on the bus, the car sends the remote control's message as well, since its switches
//! are the operator's. It knows nothing of what the others measure, and sends nothing of it.

mod action;
mod missing;
mod remote;
mod slow;
mod vehicle;

use adsdv_spec::messages::{AsState, DecodeError, Frame};
use adsdv_spec::{Actuation, AiMessages, AiSilence, Control, Edition, Inputs, Machine, Outputs};

pub(crate) use action::Excerpt;
pub use action::{Action, Expected, Switch, UnknownSwitch};
pub use missing::{Condition, Missing, missing, missing_for};
use slow::Slow;
pub use vehicle::{Physics, Vehicle};

/// For so long the VCU is without power when it is cycled, in milliseconds: long enough for everybody to notice.
pub const POWER_CYCLE_MS: u32 = 1000;

/// The VCU with its operator and its vehicle.
///
/// ```
/// use adsdv_can::car::{Action, Car};
/// use adsdv_spec::messages::AsState;
///
/// let mut car = Car::new(adsdv_spec::Machine::REFERENCE);
/// car.act(&"tsms on".parse::<Action>()?);
/// let cycle = car.cycle(10);
/// assert_eq!(cycle.state(), Some(AsState::Off));
/// assert_eq!(cycle.frames.len(), 9); // 502h as well: it comes with the first cycle, and then with every tenth
/// assert_eq!(car.cycle(10).frames.len(), 8);
/// # Ok::<(), adsdv_can::car::UnknownSwitch>(())
/// ```
#[derive(Clone, Debug)]
pub struct Car {
    machine: Machine,
    control: Control,
    inputs: Inputs,
    vehicle: Vehicle,
    /// What the last step came to; `None` while the VCU is without power.
    outputs: Option<Outputs>,
    /// For how long it will still be without power, in milliseconds.
    dark_ms: u32,
    /// When the slow messages were sent.
    slow: Slow,
    /// The AI Computer's messages that have come since the last step, by identifier.
    received: Vec<u16>,
}

/// What came of a cycle.
#[derive(Clone, Debug)]
pub struct Cycle {
    /// The outputs of the step; `None` if the VCU is without power.
    pub outputs: Option<Outputs>,
    /// The frames to send, in order.
    pub frames: Vec<Frame>,
}

impl Cycle {
    /// The AS state after the cycle; `None` if the VCU is without power.
    pub fn state(&self) -> Option<AsState> {
        self.outputs.map(|outputs| outputs.state)
    }
}

impl Car {
    /// A car at rest, just switched on, everything else off.
    pub fn new(machine: Machine) -> Self {
        Self::with_physics(machine, Physics::DEFAULT)
    }

    /// The same with another vehicle.
    pub fn with_physics(machine: Machine, physics: Physics) -> Self {
        let mut inputs = Inputs::default();
        let vehicle = Vehicle::new(physics);
        vehicle.measure(&mut inputs.vehicle);
        Self {
            machine,
            control: Control::INITIAL,
            inputs,
            vehicle,
            outputs: None,
            dark_ms: 0,
            slow: Slow::default(),
            received: Vec::new(),
        }
    }

    /// What the operator does.
    pub fn act(&mut self, action: &Action) {
        match action {
            Action::Set(switch, raw) => switch.set(&mut self.inputs, *raw),
            Action::PowerCycle => self.dark_ms = POWER_CYCLE_MS,
        }
    }

    /// A frame that came from the bus. Tells whether it is one that the VCU acts on; see
    /// [`AiMessages::receive`](adsdv_spec::AiMessages::receive). A VCU without power hears nothing.
    ///
    /// # Errors
    ///
    /// Fails if the frame is one of the AI Computer's and does not decode; then it changes nothing.
    pub fn receive(&mut self, frame: &Frame) -> Result<bool, DecodeError> {
        if self.dark_ms > 0 {
            return Ok(false);
        }
        let taken = self.inputs.ai.receive(&self.machine.edition().bus, frame.id, frame.data())?;
        if taken && !self.received.contains(&frame.id) {
            self.received.push(frame.id);
        }
        Ok(taken)
    }

    /// One cycle, `dt_ms` after the last one: a step of the VCU, the frames that are due, and the vehicle that obeys.
    pub fn cycle(&mut self, dt_ms: u32) -> Cycle {
        if self.dark_ms > 0 {
            return self.without_power(dt_ms);
        }
        self.listen(dt_ms);
        let (control, outputs) = self.machine.step(&self.control, &self.inputs, dt_ms);
        self.control = control;
        self.outputs = Some(outputs);
        let frames = self.due(&outputs, dt_ms);
        self.vehicle.advance(&outputs.actuation(&self.inputs), dt_ms);
        self.vehicle.measure(&mut self.inputs.vehicle);
        Cycle { outputs: Some(outputs), frames }
    }

    /// What has not come since the last step has been missing for longer.
    fn listen(&mut self, dt_ms: u32) {
        let silence = &mut self.inputs.ai_silence;
        *silence = silence.after(dt_ms);
        self.received.drain(..).for_each(|id| silence.end(id));
    }

    /// The VCU forgets, the AI's last words among it; the switches stay as they are, and the vehicle rolls on.
    fn without_power(&mut self, dt_ms: u32) -> Cycle {
        self.dark_ms = self.dark_ms.saturating_sub(dt_ms);
        self.control = Control::INITIAL;
        self.outputs = None;
        self.inputs.ai = AiMessages::default();
        self.inputs.ai_silence = AiSilence::default();
        self.received.clear();
        self.slow = Slow::default();
        self.vehicle.advance(&Actuation::default(), dt_ms);
        self.vehicle.measure(&mut self.inputs.vehicle);
        Cycle { outputs: None, frames: Vec::new() }
    }

    /// The frames of a step, each message at its own rate; the remote control's first, which has the lowest identifier.
    fn due(&mut self, outputs: &Outputs, dt_ms: u32) -> Vec<Frame> {
        let Edition { rules, bus, .. } = *self.machine.edition();
        let cycle_ms = |frame: &Frame| bus.message(frame.id).map_or(0, |message| message.cycle_ms);
        let slow = |frame: &Frame| cycle_ms(frame) > rules.timing.cycle_ms;
        let remote = remote::due(&bus, &self.inputs, &mut self.slow, dt_ms);
        let frames = outputs.messages(&self.inputs).frames(&bus);
        let due =
            frames.filter(|frame| !slow(frame) || self.slow.is_due(frame.id, cycle_ms(frame).into(), dt_ms));
        remote.into_iter().chain(due).collect()
    }

    /// The specification that the VCU follows.
    pub fn machine(&self) -> &Machine {
        &self.machine
    }

    /// What the sensors say, to be falsified: until the next cycle is over, the VCU sees what is written here.
    pub fn sensors(&mut self) -> &mut adsdv_spec::Vehicle {
        &mut self.inputs.vehicle
    }

    /// What the VCU remembers.
    pub fn control(&self) -> &Control {
        &self.control
    }

    /// What the VCU sees.
    pub fn inputs(&self) -> &Inputs {
        &self.inputs
    }

    /// What the last cycle came to; `None` before the first, and while the VCU is without power.
    pub fn outputs(&self) -> Option<&Outputs> {
        self.outputs.as_ref()
    }

    /// What the vehicle does.
    pub fn vehicle(&self) -> &Vehicle {
        &self.vehicle
    }

    /// The cycle of the VCU, in milliseconds.
    pub fn cycle_ms(&self) -> u32 {
        self.machine.edition().rules.timing.cycle_ms.into()
    }
}
