//! What the AI Computer measures beside what its program looks at.

use adsdv_ai::FromVcu;
use adsdv_spec::Edition;
use adsdv_spec::messages::{
    AnyMessage, DecodeError, Frame, Node, SteerAngle, Vcu2AiStatus, Vcu2AiWheelSpeeds,
};

/// What it keeps of the VCU's frames.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Measured {
    /// 520h has come.
    pub(super) vcu: bool,
    /// 520h.
    pub(super) status: Vcu2AiStatus,
    /// The actual steer angle of 523h.
    pub(super) steer_angle: SteerAngle,
    /// 525h.
    pub(super) wheel_speeds: Vcu2AiWheelSpeeds,
}

impl Measured {
    /// Keeps what a frame says, for the program as well, and tells whether it was 520h. One that does not decode changes nothing.
    pub(super) fn frame(
        &mut self,
        frame: &Frame,
        edition: &Edition,
        heard: &mut FromVcu,
    ) -> Result<bool, DecodeError> {
        if edition.bus.message(frame.id).is_none_or(|message| message.sender != Node::Vcu) {
            return Ok(false);
        }
        let message = edition.bus.decode(frame.id, frame.data())?;
        *heard = heard.with_message(&message, &edition.rules.thresholds);
        match message {
            AnyMessage::Vcu2AiStatus(status) => (self.vcu, self.status) = (true, status),
            AnyMessage::Vcu2AiSteer(steer) => self.steer_angle = steer.steer_angle,
            AnyMessage::Vcu2AiWheelSpeeds(speeds) => self.wheel_speeds = speeds,
            _ => {}
        }
        Ok(matches!(message, AnyMessage::Vcu2AiStatus(_)))
    }
}
