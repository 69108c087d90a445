//! Frames of which it is not known what they are.
//!
//! The bounds of the loops are those of [`vcu`](super::vcu).

use adsdv_spec::AiMessages;
use adsdv_spec::messages::{
    Ai2LogDynamics2, Ai2VcuBrake, Ai2VcuDriveF, Ai2VcuDriveR, Ai2VcuStatus, Ai2VcuSteer, AnyMessage,
    DecodeError, Vcu2AiBrake, Vcu2AiDriveF, Vcu2AiDriveR, Vcu2AiStatus, Vcu2AiSteer, Vcu2AiWheelCounts,
    Vcu2AiWheelSpeeds, Vcu2LogDynamics1, Vcu2LogStatus,
};

use super::data::Data;
use crate::prelude::*;

/// Whether a frame was read, or refused, as this message is.
fn read_as<M: Coded + Into<AnyMessage>>(read: Result<AnyMessage, DecodeError>, data: &Data) -> bool {
    match (read, M::decode(data.given())) {
        (Ok(read), Ok(message)) => read == message.into(),
        (
            Err(DecodeError::TooShort { id, given, needed, .. }),
            Err(DecodeError::TooShort { id: said, given: was_given, needed: is_needed, .. }),
        ) => id == said && given == was_given && needed == is_needed,
        (Err(DecodeError::Value(refused)), Err(DecodeError::Value(said))) => {
            refused.id == said.id && refused.given == said.given
        }
        _ => false,
    }
}

/// **A frame is read as the message of its identifier.** With any identifier and any data it is read, or refused, as that
/// message by itself is; and where no message has the identifier, it is refused for that. Nothing panics, overflows or
/// reads out of bounds, whatever the identifier, the length and the bytes are.
///
/// Requirements: D-19, D-33.
#[cfg_attr(kani, kani::proof, kani::unwind(24))]
pub fn a_frame_is_read_as_the_message_of_its_identifier() {
    let (id, data) = Data::any_with_id();
    let read = Layouts::read(id, data.received(id).given());
    kani::cover!(read.is_ok(), "it is a message");
    kani::cover!(matches!(read, Err(DecodeError::Value(_))), "a value is refused");
    kani::cover!(matches!(read, Err(DecodeError::UnknownId { .. })), "no message has the identifier");
    let as_it_should_be = match id {
        0x500 => read_as::<Vcu2LogDynamics1>(read, &data),
        0x501 => read_as::<Ai2LogDynamics2>(read, &data),
        0x502 => read_as::<Vcu2LogStatus>(read, &data),
        0x510 => read_as::<Ai2VcuStatus>(read, &data),
        0x511 => read_as::<Ai2VcuDriveF>(read, &data),
        0x512 => read_as::<Ai2VcuDriveR>(read, &data),
        0x513 => read_as::<Ai2VcuSteer>(read, &data),
        0x514 => read_as::<Ai2VcuBrake>(read, &data),
        0x520 => read_as::<Vcu2AiStatus>(read, &data),
        0x521 => read_as::<Vcu2AiDriveF>(read, &data),
        0x522 => read_as::<Vcu2AiDriveR>(read, &data),
        0x523 => read_as::<Vcu2AiSteer>(read, &data),
        0x524 => read_as::<Vcu2AiBrake>(read, &data),
        0x525 => read_as::<Vcu2AiWheelSpeeds>(read, &data),
        0x526 => read_as::<Vcu2AiWheelCounts>(read, &data),
        _ => matches!(read, Err(DecodeError::UnknownId { id: unknown }) if unknown == id),
    };
    assert!(as_it_should_be, "as the message of the identifier by itself");
}

/// **A message is sent under its identifier.** Whatever message it is that the edition can say, its frame has the identifier of that message, and
/// is read as the same message where it is not known what it is.
///
/// Requirements: MSG-1, MSG-5, MSG-16, MSG-20, MSG-23, MSG-26, MSG-29, MSG-34, MSG-41, MSG-65, MSG-69, MSG-73, MSG-77,
/// MSG-80, MSG-82.
#[cfg_attr(kani, kani::proof, kani::unwind(24))]
pub fn a_message_is_sent_under_its_identifier() {
    let message: AnyMessage = kani::any();
    kani::assume(Layouts::holds(&message));
    let frame = subject().sent(Layouts::write(&message).unwrap_or_default());
    let id = match message {
        // Version 3.0 cannot say it.
        AnyMessage::VcuStatus(_) => 0x120,
        AnyMessage::Vcu2LogDynamics1(_) => 0x500,
        AnyMessage::Ai2LogDynamics2(_) => 0x501,
        AnyMessage::Vcu2LogStatus(_) => 0x502,
        AnyMessage::Ai2VcuStatus(_) => 0x510,
        AnyMessage::Ai2VcuDriveF(_) => 0x511,
        AnyMessage::Ai2VcuDriveR(_) => 0x512,
        AnyMessage::Ai2VcuSteer(_) => 0x513,
        AnyMessage::Ai2VcuBrake(_) => 0x514,
        AnyMessage::Vcu2AiStatus(_) => 0x520,
        AnyMessage::Vcu2AiDriveF(_) => 0x521,
        AnyMessage::Vcu2AiDriveR(_) => 0x522,
        AnyMessage::Vcu2AiSteer(_) => 0x523,
        AnyMessage::Vcu2AiBrake(_) => 0x524,
        AnyMessage::Vcu2AiWheelSpeeds(_) => 0x525,
        AnyMessage::Vcu2AiWheelCounts(_) => 0x526,
    };
    kani::cover!(id == 0x526, "the last of them");
    assert!(frame.id == id, "the identifier");
    let data = Data::of(&frame).received(frame.id);
    assert!(Layouts::read(frame.id, data.given()).ok() == Some(message), "read as the same message");
}

/// **The VCU takes what it can read of the AI Computer, and nothing else.** A frame of 510h to 514h that is a message
/// replaces the one that came before, and leaves the others. Any other frame changes nothing, as if it had not come: one
/// that is too short or has a value that is not allowed, and one of another identifier.
///
/// Requirements: MSG-5, MSG-16, MSG-20, MSG-23, MSG-26, D-19, D-20, D-35.
#[cfg_attr(kani, kani::proof, kani::unwind(10))]
pub fn the_vcu_takes_what_it_can_read_of_the_ai_computer() {
    let before: AiMessages = kani::any();
    let (id, data) = Data::any_with_id();
    let mut after = before;
    let taken = subject().receive(&mut after, id, data.given());
    kani::cover!(taken && after.steer != before.steer, "another steer angle");
    kani::cover!(!taken && id == 0x513, "a steer angle that cannot be read");

    let mut read = false;
    assert!(after.status == last(0x510, id, &data, before.status, &mut read), "510h");
    assert!(after.drive_f == last(0x511, id, &data, before.drive_f, &mut read), "511h");
    assert!(after.drive_r == last(0x512, id, &data, before.drive_r, &mut read), "512h");
    assert!(after.steer == last(0x513, id, &data, before.steer, &mut read), "513h");
    assert!(after.brake == last(0x514, id, &data, before.brake, &mut read), "514h");
    assert!(taken == read, "it is taken if it is read as one of these");
}

/// The last message of the identifier `of`, now that this frame has come; `read` if it is this one.
fn last<M: Coded>(of: u16, id: u16, data: &Data, before: M, read: &mut bool) -> M {
    match M::decode(data.given()) {
        Ok(message) if id == of => {
            *read = true;
            message
        }
        _ => before,
    }
}

theorems![
    a_frame_is_read_as_the_message_of_its_identifier,
    a_message_is_sent_under_its_identifier,
    the_vcu_takes_what_it_can_read_of_the_ai_computer,
];
