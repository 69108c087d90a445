//! Making a condition of Figure 2 true or false, by what the operator, the vehicle or the AI Computer does.

use adsdv_spec::Atom;
use adsdv_spec::messages::{
    AmiState, AxleTorqueRequest, DirectionRequest, EbsState, MissionStatus, SteerAngle,
};

use super::World;

impl World {
    /// Makes a condition true or false from now on. Where a threshold decides, the value is the one next to it.
    ///
    /// # Panics
    ///
    /// What only time or the past decides cannot be set: it must be so already.
    pub fn set(&mut self, atom: Atom, value: bool) {
        let thresholds = self.vcu.interface().thresholds;
        let limit = thresholds.wheel_speed.raw();
        let (inputs, ai) = (&mut self.inputs, &mut self.ai);
        let least = AxleTorqueRequest::clamped(i32::from(!value));
        match atom {
            Atom::Asms => inputs.asms = value,
            Atom::Tsms => inputs.tsms = value,
            Atom::AmiSelected => inputs.ami = either(value, AmiState::TrackDrive, AmiState::NotSelected),
            Atom::EbsArmed => inputs.ebs = either(value, EbsState::Armed, EbsState::Unavailable),
            Atom::SdcOpen => inputs.reports.hvil_open = value,
            Atom::GoOn | Atom::GoEdge => inputs.go = value,
            Atom::SteerStraight => {
                let off = either(value, 1, 0);
                inputs.vehicle.steer_angle = SteerAngle::clamped(thresholds.straight.raw() - off);
            }
            Atom::Moving => self.wheels(limit + i32::from(value)),
            Atom::AtRest => self.wheels(limit - i32::from(value)),
            Atom::MissionSelected => {
                ai.status.mission_status = either(value, MissionStatus::Selected, MissionStatus::NotSelected);
            }
            Atom::MissionRunning => {
                ai.status.mission_status = either(value, MissionStatus::Running, MissionStatus::Selected);
            }
            Atom::MissionFinished | Atom::MissionFinishedEdge => {
                ai.status.mission_status = either(value, MissionStatus::Finished, MissionStatus::Running);
            }
            Atom::DirectionNeutral | Atom::DirectionNeutralEdge => {
                ai.status.direction_request =
                    either(value, DirectionRequest::Neutral, DirectionRequest::Forward);
            }
            Atom::FrontTorqueZero => ai.drive_f.front_axle_trq_request = least,
            Atom::RearTorqueZero => ai.drive_r.rear_axle_trq_request = least,
            Atom::SteerRequestZero => ai.steer.steer_request = SteerAngle::clamped(i32::from(!value)),
            Atom::AiHandshake => {
                self.ai_answers = false;
                ai.status.handshake = value;
            }
            Atom::AiCommsLost => self.ai_answers = !value,
            Atom::AiEstop => ai.status.estop_request = value,
            Atom::DwellElapsed | Atom::EbsTimerComplete => {
                let timing = &self.vcu.interface().timing;
                let elapsed = self.control.in_state_ms >= timing.in_state_limit(self.control.state);
                assert_eq!(elapsed, value, "{atom} is decided by how long the state has lasted");
            }
            Atom::PowerCycleNeeded => {
                assert_eq!(self.control.power_cycle_needed, value, "{atom} is decided by the past");
            }
        }
    }
}

fn either<T>(value: bool, yes: T, no: T) -> T {
    if value { yes } else { no }
}
