//! A small AI Computer that drives one mission.
//!
//! It does what the document asks of an AI Computer, and no more: it answers the handshake, confirms the mission that is
//! selected on the AMI, holds its requests at zero until the car drives, drives a bit, stops with the service brake, and says
//! so. What it looks at on the way is one straight road without a cone.
//!
//! ```text
//! Idle -> Selected -> Started -> Driving -> Braking -> Finished -> Neutral
//!  (AMI)        (AS_DRIVING)  (so far)      (at rest)  (AS_FINISHED)
//! ```
//!
//! Like the car it is pure: it gets the frames that came and how much time has passed.

mod from_vcu;
mod motion;

use adsdv_spec::messages::{
    Ai2VcuBrake, Ai2VcuDriveF, Ai2VcuDriveR, Ai2VcuStatus, Ai2VcuSteer, AmiState, AsState, AxleTorqueRequest,
    BrakePressure, DecodeError, DirectionRequest, Frame, MissionStatus, MotorSpeedMax, SpeedKmh, SteerAngle,
};
use adsdv_spec::{AiMessages, Edition};

use crate::car::Physics;
use from_vcu::FromVcu;
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

/// How far it has come with its mission.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Stage {
    /// No mission is selected.
    #[default]
    Idle,
    /// The selected mission is confirmed (RDY-7); all requests are zero (DRV-5 to DRV-8).
    Selected,
    /// The car drives: RUNNING and FORWARD (DRV-10), but no torque yet.
    Started,
    /// It drives.
    Driving,
    /// It stops the vehicle with the service brake (FIN-2).
    Braking,
    /// The vehicle has stopped: FINISHED (FIN-3). The brakes stay on.
    Finished,
    /// FINISHED and NEUTRAL, the brakes still on.
    Neutral,
    /// An emergency: nothing is requested.
    Stopped,
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
    stage: Stage,
    heard: FromVcu,
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
            stage: Stage::Idle,
            heard: FromVcu::default(),
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
        self.stage
    }

    /// A frame that came from the bus. What is not of the VCU changes nothing; what is, and does not decode, neither, and is an
    /// error.
    pub fn receive(&mut self, frame: &Frame) -> Result<(), DecodeError> {
        if self.heard.frame(frame, &self.edition)? {
            self.silent_ms = 0;
        }
        Ok(())
    }

    /// One cycle, `dt_ms` after the last one: the frames to send, in the order in which they win the bus.
    ///
    /// Until it has heard the VCU it sends none: it cannot know what would be right in the state that the car is in.
    pub fn cycle(&mut self, dt_ms: u32) -> Vec<Frame> {
        self.silent_ms = self.silent_ms.saturating_add(dt_ms);
        self.motion.measure(&self.heard, &self.physics, dt_ms);
        self.advance(dt_ms);
        if !self.heard.vcu {
            return Vec::new();
        }
        let bus = &self.edition.bus;
        bus.encode(self.motion.logged()).into_iter().chain(self.messages().frames(bus)).collect()
    }

    fn advance(&mut self, dt_ms: u32) {
        if self.stage == Stage::Driving {
            self.driven_ms = self.driven_ms.saturating_add(dt_ms);
            self.driven_m += self.motion.speed_mps * f64::from(dt_ms) / 1000.0;
        }
        let at_rest = self.stage == Stage::Braking && self.heard.has_stopped();
        self.rested_ms = if at_rest { self.rested_ms.saturating_add(dt_ms) } else { 0 };
        self.stage = self.next_stage();
        if self.stage < Stage::Started {
            self.driven_ms = 0;
            self.driven_m = 0.0;
        }
    }

    fn next_stage(&self) -> Stage {
        let status = &self.heard.status;
        match (status.as_state, self.stage) {
            (AsState::Off | AsState::Ready, _) => match status.ami_state {
                AmiState::NotSelected => Stage::Idle,
                _ => Stage::Selected,
            },
            // Somebody else has selected it, or it has been switched off and on again on the way.
            (AsState::Driving, Stage::Idle) => Stage::Braking,
            (AsState::Driving, Stage::Selected) => Stage::Started,
            (AsState::Driving, Stage::Started | Stage::Driving) if self.must_stop() => Stage::Braking,
            (AsState::Driving, Stage::Started) => Stage::Driving,
            (AsState::Driving, Stage::Driving) if self.driven_m >= self.plan.distance_m => Stage::Braking,
            (AsState::Driving, Stage::Braking) if self.rested_ms > self.plan.settle_ms => Stage::Finished,
            (AsState::Driving, stage) => stage,
            (AsState::Finished, _) => Stage::Neutral,
            (AsState::EmergencyBrake, _) => Stage::Stopped,
        }
    }

    /// Whether it is no longer safe to drive: the VCU asks it to stop, or is not heard for so long that it would count the
    /// AI Computer as lost.
    fn must_stop(&self) -> bool {
        self.heard.status.shutdown_request || self.silent_ms > self.edition.rules.timing.handshake_ms.into()
    }

    /// What it says to the VCU (section 2.1).
    fn messages(&self) -> AiMessages {
        let torque = AxleTorqueRequest::from_nm(self.torque_nm()).unwrap_or_default();
        let limit = self.motor_speed_max();
        let pressure = match self.stage {
            //= FIN-2
            Stage::Braking | Stage::Finished | Stage::Neutral => {
                BrakePressure::from_pct(self.plan.brake_pct).unwrap_or(BrakePressure::MAX)
            }
            _ => BrakePressure::MIN,
        };
        let driving = self.stage == Stage::Driving;
        let speed = |mps: f64| SpeedKmh::from_kmh(mps * 3.6).unwrap_or(SpeedKmh::MAX);
        AiMessages {
            status: Ai2VcuStatus {
                handshake: self.heard.status.handshake, //= HS-5
                mission_status: match self.stage {
                    Stage::Idle | Stage::Stopped => MissionStatus::NotSelected,
                    Stage::Selected => MissionStatus::Selected, //= RDY-7
                    Stage::Started | Stage::Driving | Stage::Braking => MissionStatus::Running,
                    Stage::Finished | Stage::Neutral => MissionStatus::Finished, //= FIN-1, FIN-3
                },
                direction_request: match self.stage {
                    Stage::Idle | Stage::Selected | Stage::Neutral | Stage::Stopped => {
                        DirectionRequest::Neutral
                    }
                    Stage::Started | Stage::Driving | Stage::Braking | Stage::Finished => {
                        //= DRV-10
                        DirectionRequest::Forward
                    }
                },
                veh_speed_actual: speed(self.motion.speed_mps),
                veh_speed_demand: speed(if driving { self.plan.speed_mps } else { 0.0 }),
                ..Ai2VcuStatus::default()
            },
            drive_f: Ai2VcuDriveF { front_axle_trq_request: torque, front_motor_speed_max: limit },
            drive_r: Ai2VcuDriveR { rear_axle_trq_request: torque, rear_motor_speed_max: limit },
            steer: Ai2VcuSteer { steer_request: SteerAngle::from_deg(self.steer_deg()).unwrap_or_default() },
            brake: Ai2VcuBrake { hyd_press_f_req: pressure, hyd_press_r_req: pressure },
        }
    }

    /// Less and less torque as it gets faster, so that it never gets to the limit of the motors, where torque brakes.
    fn torque_nm(&self) -> f64 {
        if self.stage != Stage::Driving {
            return 0.0;
        }
        let missing = 1.0 - self.motion.speed_mps / self.plan.speed_mps;
        // Full torque up to three quarters of the speed.
        (4.0 * missing * self.plan.torque_nm).max(0.0).min(self.plan.torque_nm)
    }

    fn motor_speed_max(&self) -> MotorSpeedMax {
        if self.stage != Stage::Driving {
            return MotorSpeedMax::MIN;
        }
        // The outer wheel is faster, and the regulation has some room.
        let rpm = 1.25 * self.plan.speed_mps * self.physics.rpm_per_mps() * self.physics.gear_ratio;
        MotorSpeedMax::from_rpm(rpm).unwrap_or(MotorSpeedMax::MAX)
    }

    fn steer_deg(&self) -> f64 {
        if self.stage != Stage::Driving {
            return 0.0;
        }
        let turn = f64::from(self.driven_ms) / self.plan.sway_ms;
        self.plan.sway_deg * (std::f64::consts::TAU * turn).sin()
    }
}
