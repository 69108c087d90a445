//! What the AI Computer has heard of the VCU.

use adsdv_spec::messages::{AmiState, AnyMessage, AsState, Frame};
use adsdv_spec::{Atom, Edition, Thresholds};

/// What the AI Computer keeps of the VCU's frames: all that its program looks at.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct FromVcu {
    /// HANDSHAKE of 520h.
    pub handshake: bool,
    /// AS_STATE of 520h.
    pub as_state: AsState,
    /// AMI_STATE of 520h.
    pub ami: AmiState,
    /// A torque request is in force at an axle, front and rear, as 521h and 522h return it.
    pub torque: [bool; 2],
    /// A brake request is in force, as 524h returns it.
    pub brake: bool,
    /// A wheel is not at rest, as 525h shows.
    pub turning: bool,
    /// No 525h has arrived since the last change in 521h, 522h or 524h: the wheels may have turned since.
    pub outdated: bool,
}

impl FromVcu {
    /// What is known after one more frame of an edition; one that does not decode changes nothing.
    #[must_use]
    pub fn with(self, frame: &Frame, edition: &Edition) -> Self {
        let message = edition.bus.decode(frame.id, frame.data());
        message.map_or(self, |message| self.with_message(&message, &edition.rules.thresholds))
    }

    /// What is known after one more message.
    #[must_use]
    pub fn with_message(self, message: &AnyMessage, thresholds: &Thresholds) -> Self {
        let after = self.with_values(message, thresholds);
        let outdated = match message {
            AnyMessage::Vcu2AiWheelSpeeds(_) => false,
            _ => self.outdated || (after.torque, after.brake) != (self.torque, self.brake),
        };
        Self { outdated, ..after }
    }

    fn with_values(self, message: &AnyMessage, thresholds: &Thresholds) -> Self {
        let Self { torque: [front, rear], .. } = self;
        match message {
            AnyMessage::Vcu2AiStatus(status) => {
                Self { handshake: status.handshake, as_state: status.as_state, ami: status.ami_state, ..self }
            }
            AnyMessage::Vcu2AiDriveF(drive) => {
                Self { torque: [drive.front_axle_trq_request.raw() > 0, rear], ..self }
            }
            AnyMessage::Vcu2AiDriveR(drive) => {
                Self { torque: [front, drive.rear_axle_trq_request.raw() > 0], ..self }
            }
            AnyMessage::Vcu2AiBrake(brake) => {
                let axles = [brake.hyd_press_f_req.raw(), brake.hyd_press_r_req.raw()];
                Self { brake: !axles.contains(&0), ..self }
            }
            AnyMessage::Vcu2AiWheelSpeeds(speeds) => {
                Self { turning: !speeds.atoms(thresholds).has(Atom::AtRest), ..self }
            }
            _ => self,
        }
    }

    /// Whether the vehicle has stopped for good: the VCU returns the brake request and no torque request, so that none
    /// is on its way that could start the vehicle again, and the wheels have been seen at rest since then.
    pub const fn has_stopped(self) -> bool {
        let [front, rear] = self.torque;
        self.brake && !front && !rear && !self.turning && !self.outdated
    }
}

#[cfg(test)]
mod tests {
    use adsdv_spec::messages::{
        AxleTorqueRequest, BrakePressure, Vcu2AiBrake, Vcu2AiDriveF, Vcu2AiWheelSpeeds, WheelSpeed,
    };

    use super::*;

    fn wheels(rpm: i32) -> AnyMessage {
        Vcu2AiWheelSpeeds { rl_wheel_speed: WheelSpeed::clamped(rpm), ..Vcu2AiWheelSpeeds::default() }.into()
    }

    fn after<const N: usize>(messages: [AnyMessage; N]) -> FromVcu {
        let thresholds = &Edition::DEFAULT.rules.thresholds;
        messages.iter().fold(FromVcu::default(), |heard, message| heard.with_message(message, thresholds))
    }

    #[test]
    fn the_vehicle_has_stopped_when_that_is_measured_after_the_brakes_are_on() {
        let pressure = BrakePressure::MAX;
        let brake =
            Vcu2AiBrake { hyd_press_f_req: pressure, hyd_press_r_req: pressure, ..Vcu2AiBrake::default() };
        let brake = AnyMessage::from(brake);
        let torque = |front_axle_trq_request| {
            AnyMessage::from(Vcu2AiDriveF { front_axle_trq_request, ..Vcu2AiDriveF::default() })
        };
        let (on, off) = (torque(AxleTorqueRequest::MAX), torque(AxleTorqueRequest::MIN));
        assert!(!after([wheels(9), brake]).has_stopped(), "the wheels may have turned since");
        assert!(after([brake, wheels(9)]).has_stopped());
        assert!(!after([brake, wheels(10)]).has_stopped(), "exactly 10 rpm is not at rest (D-24)");
        assert!(!after([brake, on, wheels(9)]).has_stopped(), "a torque request is still in force");
        assert!(!after([brake, on, wheels(9), off]).has_stopped(), "measured before");
        assert!(after([brake, on, wheels(9), off, wheels(9)]).has_stopped());
    }

    #[test]
    fn a_frame_that_does_not_decode_changes_nothing() {
        let edition = Edition::DEFAULT;
        let heard = after([wheels(100)]);
        let short = Frame::new(Vcu2AiWheelSpeeds::ID, &[0; 3]).expect("three bytes fit");
        assert_eq!(heard.with(&short, edition), heard);
        let whole = Frame::new(Vcu2AiWheelSpeeds::ID, &[0; 8]).expect("eight bytes fit");
        assert!(!heard.with(&whole, edition).turning);
    }
}
