//! A small AI Computer that drives one mission.
//!
//! It does what the document asks of an AI Computer, and no more: it answers the handshake, confirms the mission that is
//! selected on the AMI, holds its requests at zero until the car drives, drives a bit, stops with the service brake, and says
//! so. What it looks at on the way is one straight road without a cone.
//!
//! Its program is that of [`adsdv_ai`], which the model explores as well. Here it gets a plan, a road, and what else a stack on a bus
//! sends: speeds and accelerations as it measures them.
//!
//! Like the car it is pure: it gets the frames that came and how much time has passed.

mod measured;
mod motion;

pub use adsdv_ai::Stage;
use adsdv_ai::{AiComputer, Decisions, Wanted};
use adsdv_spec::messages::{
    Ai2VcuStatus, AxleTorqueRequest, BrakePressure, DecodeError, Frame, MotorSpeedMax, SpeedKmh, SteerAngle,
};
use adsdv_spec::{AiMessages, Edition};

use crate::car::Physics;
use measured::Measured;
use motion::Motion;

/// What it drives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plan {
    /// The speed, in metres per second.
    pub speed_mps: f64,
    /// How far it drives before it brakes, in metres.
    pub distance_m: f64,
    /// The most torque at each axle, in newton metres.
    pub torque_nm: f64,
    /// How far it steers to either side on the way, in degrees.
    pub sway_deg: f64,
    /// How long it takes to steer to both sides once, in milliseconds.
    pub sway_ms: f64,
    /// The pressure of the service brake, in percent.
    pub brake_pct: f64,
    /// For how long the vehicle has to have been at rest before the mission is finished, in milliseconds.
    pub settle_ms: u32,
}

impl Plan {
    /// Forty metres at 18 km/h.
    pub const DEFAULT: Self = Self {
        speed_mps: 5.0,
        distance_m: 40.0,
        torque_nm: 60.0,
        sway_deg: 4.0,
        sway_ms: 4000.0,
        brake_pct: 50.0,
        settle_ms: 200,
    };
}

/// The AI Computer.
///
/// ```
/// use adsdv_can::ai::Ai;
/// use adsdv_can::car::Car;
///
/// let mut car = Car::new(adsdv_spec::Machine::REFERENCE);
/// let mut ai = Ai::default();
/// for action in ["ami TRACK_DRIVE", "ebs ARMED", "tsms on", "asms on"] {
///     car.act(&action.parse()?);
/// }
/// for _ in 0..5 {
///     for frame in car.cycle(10).frames {
///         ai.receive(&frame).expect("so does the VCU");
///     }
///     for frame in ai.cycle(10) {
///         car.receive(&frame).expect("the AI Computer sends what the document allows");
///     }
/// }
/// assert_eq!(car.control().state.name(), "AS_READY");
/// # Ok::<(), adsdv_can::car::UnknownSwitch>(())
/// ```
#[derive(Clone, Debug)]
pub struct Ai {
    edition: Edition,
    physics: Physics,
    plan: Plan,
    program: AiComputer,
    measured: Measured,
    motion: Motion,
    /// For how long the VCU has said nothing, in milliseconds.
    silent_ms: u32,
    /// For how long it has driven, in milliseconds.
    driven_ms: u32,
    /// How far, in metres.
    driven_m: f64,
    /// For how long the vehicle has been at rest behind the brakes, in milliseconds.
    rested_ms: u32,
}

impl Default for Ai {
    /// One of the [default edition](Edition::DEFAULT), with the plan that it has where nobody gives another.
    fn default() -> Self {
        Self::new(Edition::DEFAULT, Plan::DEFAULT)
    }
}

impl Ai {
    /// An AI Computer that was just switched on, in a car of [`Physics::DEFAULT`].
    pub fn new(edition: &Edition, plan: Plan) -> Self {
        Self {
            edition: *edition,
            physics: Physics::DEFAULT,
            plan,
            program: AiComputer::default(),
            measured: Measured::default(),
            motion: Motion::default(),
            silent_ms: 0,
            driven_ms: 0,
            driven_m: 0.0,
            rested_ms: 0,
        }
    }

    /// The edition of the interface that it follows.
    pub const fn edition(&self) -> &Edition {
        &self.edition
    }

    /// How far it has come with its mission.
    pub const fn stage(&self) -> Stage {
        self.program.stage
    }

    /// A frame that came from the bus. What is not of the VCU changes nothing; what is, and does not decode, neither, and is an
    /// error.
    ///
    /// # Errors
    ///
    /// Fails if the frame is of the VCU and its data says what the message cannot say.
    pub fn receive(&mut self, frame: &Frame) -> Result<(), DecodeError> {
        if self.measured.frame(frame, &self.edition, &mut self.program.heard)? {
            self.silent_ms = 0;
        }
        Ok(())
    }

    /// One cycle, `dt_ms` after the last one: the frames to send, in the order in which they win the bus.
    ///
    /// Until it has heard the VCU it sends none: it cannot know what would be right in the state that the car is in.
    pub fn cycle(&mut self, dt_ms: u32) -> Vec<Frame> {
        self.silent_ms = self.silent_ms.saturating_add(dt_ms);
        self.motion.measure(&self.measured, &self.physics, dt_ms);
        self.advance(dt_ms);
        if !self.measured.vcu {
            return Vec::new();
        }
        let bus = &self.edition.bus;
        bus.encode(self.motion.logged()).into_iter().chain(self.messages().frames(bus)).collect()
    }

    fn advance(&mut self, dt_ms: u32) {
        if self.program.stage == Stage::Driving {
            self.driven_ms = self.driven_ms.saturating_add(dt_ms);
            self.driven_m += self.motion.speed_mps * f64::from(dt_ms) / 1000.0;
        }
        let at_rest = self.program.stage == Stage::Braking && self.program.heard.has_stopped();
        self.rested_ms = if at_rest { self.rested_ms.saturating_add(dt_ms) } else { 0 };
        self.program = self.program.cycle(Decisions {
            stop: self.must_stop() || self.driven_m >= self.plan.distance_m,
            settled: self.rested_ms > self.plan.settle_ms,
        });
        if self.program.stage < Stage::Started {
            self.driven_ms = 0;
            self.driven_m = 0.0;
        }
    }

    /// Whether it is no longer safe to drive: the VCU asks it to stop, or is not heard for so long that it would count the
    /// AI Computer as lost.
    fn must_stop(&self) -> bool {
        self.measured.status.shutdown_request
            || self.silent_ms > self.edition.rules.timing.handshake_ms.into()
    }

    /// What it says to the VCU (section 2.1).
    fn messages(&self) -> AiMessages {
        let driving = self.program.stage == Stage::Driving;
        let speed = |mps: f64| SpeedKmh::from_kmh(mps * 3.6).unwrap_or(SpeedKmh::MAX);
        let messages = self.program.messages(&Wanted {
            torque: AxleTorqueRequest::from_nm(self.torque_nm()).unwrap_or_default(),
            motor_speed_max: self.motor_speed_max(),
            steer: SteerAngle::from_deg(self.steer_deg()).unwrap_or_default(),
            pressure: match self.program.stage {
                // The EBS stops the vehicle.
                Stage::Stopped => BrakePressure::MIN,
                _ => BrakePressure::from_pct(self.plan.brake_pct).unwrap_or(BrakePressure::MAX),
            },
        });
        AiMessages {
            status: Ai2VcuStatus {
                veh_speed_actual: speed(self.motion.speed_mps),
                veh_speed_demand: speed(if driving { self.plan.speed_mps } else { 0.0 }),
                ..messages.status
            },
            ..messages
        }
    }

    /// Less and less torque as it gets faster, so that it never gets to the limit of the motors, where torque brakes.
    fn torque_nm(&self) -> f64 {
        let missing = 1.0 - self.motion.speed_mps / self.plan.speed_mps;
        // Full torque up to three quarters of the speed.
        (4.0 * missing * self.plan.torque_nm).max(0.0).min(self.plan.torque_nm)
    }

    fn motor_speed_max(&self) -> MotorSpeedMax {
        // The outer wheel is faster, and the regulation has some room.
        let rpm = 1.25 * self.plan.speed_mps * self.physics.rpm_per_mps() * self.physics.gear_ratio;
        MotorSpeedMax::from_rpm(rpm).unwrap_or(MotorSpeedMax::MAX)
    }

    fn steer_deg(&self) -> f64 {
        let turn = f64::from(self.driven_ms) / self.plan.sway_ms;
        self.plan.sway_deg * (std::f64::consts::TAU * turn).sin()
    }
}
