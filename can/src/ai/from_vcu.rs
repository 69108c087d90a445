//! What the AI Computer has heard of the VCU.

use adsdv_spec::messages::{
    AnyMessage, DecodeError, Frame, Node, SteerAngle, Vcu2AiStatus, Vcu2AiWheelSpeeds,
};
use adsdv_spec::{Atom, Edition};

/// What it keeps of the VCU's frames.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct FromVcu {
    /// 520h has come.
    pub(super) vcu: bool,
    /// 520h.
    pub(super) status: Vcu2AiStatus,
    /// The actual steer angle of 523h.
    pub(super) steer_angle: SteerAngle,
    /// 525h.
    pub(super) wheel_speeds: Vcu2AiWheelSpeeds,
    /// A torque request is in force at an axle, as 521h and 522h return it.
    torque: [bool; 2],
    /// A brake request is in force, as 524h returns it.
    brake: bool,
    /// The wheels were at rest when all of this was so already.
    at_rest: bool,
}

impl FromVcu {
    /// Keeps what a frame says, and tells whether it was 520h. One that does not decode changes nothing.
    pub(super) fn frame(&mut self, frame: &Frame, edition: &Edition) -> Result<bool, DecodeError> {
        if edition.bus.message(frame.id).is_none_or(|message| message.sender != Node::Vcu) {
            return Ok(false);
        }
        let before = (self.torque, self.brake);
        let [front, rear] = self.torque;
        match edition.bus.decode(frame.id, frame.data())? {
            AnyMessage::Vcu2AiStatus(status) => {
                self.vcu = true;
                self.status = status;
                return Ok(true);
            }
            AnyMessage::Vcu2AiDriveF(drive) => {
                self.torque = [drive.front_axle_trq_request.raw() > 0, rear];
            }
            AnyMessage::Vcu2AiDriveR(drive) => {
                self.torque = [front, drive.rear_axle_trq_request.raw() > 0];
            }
            AnyMessage::Vcu2AiSteer(steer) => self.steer_angle = steer.steer_angle,
            AnyMessage::Vcu2AiBrake(brake) => {
                self.brake = brake.hyd_press_f_req.raw() > 0 && brake.hyd_press_r_req.raw() > 0;
            }
            AnyMessage::Vcu2AiWheelSpeeds(speeds) => {
                self.wheel_speeds = speeds;
                self.at_rest = speeds.atoms(&edition.rules.thresholds).has(Atom::AtRest);
            }
            _ => {}
        }
        if before != (self.torque, self.brake) {
            // What was measured before may be outdated.
            self.at_rest = false;
        }
        Ok(false)
    }

    /// Whether the vehicle has stopped for good: the VCU returns the brake request and no torque request, so that none is on
    /// its way that could start the vehicle again, and the wheels have been seen at rest since then.
    pub(super) fn has_stopped(&self) -> bool {
        self.brake && self.torque == [false; 2] && self.at_rest
    }
}
