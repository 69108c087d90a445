//! The program of the AI Computer.

use adsdv_spec::AiMessages;
use adsdv_spec::messages::{
    Ai2VcuBrake, Ai2VcuDriveF, Ai2VcuDriveR, Ai2VcuStatus, Ai2VcuSteer, AxleTorqueRequest, BrakePressure,
    MotorSpeedMax, SteerAngle,
};

use crate::{Decisions, FromVcu, Stage};

/// The AI Computer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct AiComputer {
    /// What it has heard of the VCU.
    pub heard: FromVcu,
    /// The HANDSHAKE bit that it sends.
    pub handshake: bool,
    /// How far it has come.
    pub stage: Stage,
}

/// What the AI Computer asks for in the stages in which it may; zero in all others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Wanted {
    /// The torque at each axle, where it drives.
    pub torque: AxleTorqueRequest,
    /// The motors' speed limit, where it drives.
    pub motor_speed_max: MotorSpeedMax,
    /// The steer angle, where it drives.
    pub steer: SteerAngle,
    /// The pressure at each axle, where it brakes.
    pub pressure: BrakePressure,
}

impl Wanted {
    /// All that can be asked for, straight ahead.
    pub const MOST: Self = Self {
        torque: AxleTorqueRequest::MAX,
        motor_speed_max: MotorSpeedMax::MAX,
        steer: SteerAngle::clamped(0),
        pressure: BrakePressure::MAX,
    };
}

impl AiComputer {
    /// The AI Computer after one cycle of its program.
    #[must_use]
    pub const fn cycle(self, decided: Decisions) -> Self {
        let Self { heard, stage, .. } = self;
        Self { heard, stage: stage.next(heard, decided), handshake: heard.handshake } //= HS-5
    }

    /// What it sends (section 2.1).
    pub fn messages(self, wanted: &Wanted) -> AiMessages {
        let moves = if self.stage == Stage::Driving {
            *wanted
        } else {
            Wanted {
                torque: AxleTorqueRequest::MIN,
                motor_speed_max: MotorSpeedMax::MIN,
                steer: SteerAngle::default(),
                ..*wanted
            }
        };
        let pressure = if self.stage.brakes() { wanted.pressure } else { BrakePressure::MIN };
        AiMessages {
            status: Ai2VcuStatus {
                handshake: self.handshake,
                mission_status: self.stage.mission_status(),
                direction_request: self.stage.direction(),
                ..Ai2VcuStatus::default()
            },
            drive_f: Ai2VcuDriveF {
                front_axle_trq_request: moves.torque,
                front_motor_speed_max: moves.motor_speed_max,
            },
            drive_r: Ai2VcuDriveR {
                rear_axle_trq_request: moves.torque,
                rear_motor_speed_max: moves.motor_speed_max,
            },
            steer: Ai2VcuSteer { steer_request: moves.steer },
            brake: Ai2VcuBrake { hyd_press_f_req: pressure, hyd_press_r_req: pressure },
        }
    }
}

#[cfg(test)]
mod tests {
    use adsdv_spec::Edition;
    use adsdv_spec::messages::{
        AmiState, AsState, DirectionRequest, MissionStatus, Vcu2AiBrake, Vcu2AiStatus, Vcu2AiWheelSpeeds,
        WheelSpeed,
    };

    use super::*;

    const NOTHING: Decisions = Decisions { stop: false, settled: false };

    fn hears(ai: AiComputer, message: impl Into<adsdv_spec::messages::AnyMessage>) -> AiComputer {
        let heard = ai.heard.with_message(&message.into(), &Edition::DEFAULT.rules.thresholds);
        AiComputer { heard, ..ai }
    }

    /// After one cycle in a state, with a mission.
    fn after(ai: AiComputer, as_state: AsState, ami_state: AmiState, decided: Decisions) -> AiComputer {
        hears(ai, Vcu2AiStatus { as_state, ami_state, ..Vcu2AiStatus::default() }).cycle(decided)
    }

    //= HS-5
    #[test]
    fn the_handshake_is_echoed_and_no_emergency_stop_is_asked_for() {
        for as_state in AsState::ALL {
            for handshake in [false, true] {
                let status = Vcu2AiStatus { as_state, handshake, ..Vcu2AiStatus::default() };
                let mut ai = hears(AiComputer::default(), status);
                for _ in 0..8 {
                    ai = ai.cycle(NOTHING);
                    let status = ai.messages(&Wanted::MOST).status;
                    assert_eq!((status.handshake, status.estop_request), (handshake, false));
                }
            }
        }
    }

    /// From the mission on the AMI to FINISHED; the brakes are on before the vehicle stands, FINISHED comes after.
    //= RDY-7, DRV-10, FIN-1 to FIN-3
    #[test]
    fn it_follows_the_mission() {
        let says = |ai: AiComputer| {
            let AiMessages { status, drive_f, brake, .. } = ai.messages(&Wanted::MOST);
            let asks = (drive_f.front_axle_trq_request.raw() > 0, brake.hyd_press_f_req.raw() > 0);
            (status.mission_status, status.direction_request, asks)
        };
        let (neutral, forward) = (DirectionRequest::Neutral, DirectionRequest::Forward);
        let (nothing, drives, brakes) = ((false, false), (true, false), (false, true));
        let mission = AmiState::TrackDrive;
        let ai = after(AiComputer::default(), AsState::Off, AmiState::NotSelected, NOTHING);
        assert_eq!(says(ai), (MissionStatus::NotSelected, neutral, nothing));
        let ai = after(ai, AsState::Off, mission, NOTHING);
        assert_eq!(says(ai), (MissionStatus::Selected, neutral, nothing));
        let ai = after(ai, AsState::Driving, mission, NOTHING);
        assert_eq!(says(ai), (MissionStatus::Running, forward, nothing));
        let ai = after(ai, AsState::Driving, mission, NOTHING);
        assert_eq!(says(ai), (MissionStatus::Running, forward, drives));
        let ai = after(ai, AsState::Driving, mission, Decisions { stop: true, ..NOTHING });
        assert_eq!(says(ai), (MissionStatus::Running, forward, brakes));
        let turning =
            Vcu2AiWheelSpeeds { rl_wheel_speed: WheelSpeed::clamped(11), ..Vcu2AiWheelSpeeds::default() };
        let on = BrakePressure::MAX;
        let returned = Vcu2AiBrake { hyd_press_f_req: on, hyd_press_r_req: on, ..Vcu2AiBrake::default() };
        let ai = hears(hears(ai, returned), turning);
        let settles = |ai: AiComputer| Decisions { settled: ai.heard.has_stopped(), ..NOTHING };
        assert_eq!(says(after(ai, AsState::Driving, mission, settles(ai))).0, MissionStatus::Running);
        let ai = hears(ai, Vcu2AiWheelSpeeds::default());
        let ai = after(ai, AsState::Driving, mission, settles(ai));
        assert_eq!(says(ai), (MissionStatus::Finished, forward, brakes));
        let ai = after(ai, AsState::Finished, mission, NOTHING);
        assert_eq!(says(ai), (MissionStatus::Finished, neutral, brakes));
        let ai = after(ai, AsState::EmergencyBrake, mission, NOTHING);
        assert_eq!(says(ai), (MissionStatus::NotSelected, neutral, brakes));
    }

    #[test]
    fn a_mission_that_it_has_not_selected_is_stopped() {
        let ai = after(AiComputer::default(), AsState::Driving, AmiState::TrackDrive, NOTHING);
        assert_eq!(ai.stage, Stage::Braking);
    }
}
