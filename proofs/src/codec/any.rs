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

/// Claims it of frames with the identifier of a message.
fn is_read_as<M: Coded + Into<AnyMessage> + kani::Arbitrary>(id: u16) {
    let data = Data::any::<M>();
    let read = Layouts::read(id, data.received(id).given());
    kani::cover!(read.is_ok(), "it is a message");
    kani::cover!(read.is_err(), "it is refused");
    assert!(read_as::<M>(read, &data), "as the message of the identifier by itself");
}

harnesses! {
    /// **A frame is read as the message of its identifier.** With the identifier of a message and any data it is read, or refused, as
    /// that message by itself is. Nothing panics, overflows or reads out of bounds, whatever the length and the bytes are.
    ///
    /// Requirements: D-19, D-33.
    unwind 24;
    a_frame_of_500h_is_read_as_its_message = is_read_as::<Vcu2LogDynamics1>(0x500);
    a_frame_of_501h_is_read_as_its_message = is_read_as::<Ai2LogDynamics2>(0x501);
    a_frame_of_502h_is_read_as_its_message = is_read_as::<Vcu2LogStatus>(0x502);
    a_frame_of_510h_is_read_as_its_message = is_read_as::<Ai2VcuStatus>(0x510);
    a_frame_of_511h_is_read_as_its_message = is_read_as::<Ai2VcuDriveF>(0x511);
    a_frame_of_512h_is_read_as_its_message = is_read_as::<Ai2VcuDriveR>(0x512);
    a_frame_of_513h_is_read_as_its_message = is_read_as::<Ai2VcuSteer>(0x513);
    a_frame_of_514h_is_read_as_its_message = is_read_as::<Ai2VcuBrake>(0x514);
    a_frame_of_520h_is_read_as_its_message = is_read_as::<Vcu2AiStatus>(0x520);
    a_frame_of_521h_is_read_as_its_message = is_read_as::<Vcu2AiDriveF>(0x521);
    a_frame_of_522h_is_read_as_its_message = is_read_as::<Vcu2AiDriveR>(0x522);
    a_frame_of_523h_is_read_as_its_message = is_read_as::<Vcu2AiSteer>(0x523);
    a_frame_of_524h_is_read_as_its_message = is_read_as::<Vcu2AiBrake>(0x524);
    a_frame_of_525h_is_read_as_its_message = is_read_as::<Vcu2AiWheelSpeeds>(0x525);
    a_frame_of_526h_is_read_as_its_message = is_read_as::<Vcu2AiWheelCounts>(0x526);
}

/// **A frame of no message is refused for its identifier**, whatever its data are, and the VCU takes nothing of it.
///
/// Requirements: D-19, D-33.
#[cfg_attr(kani, kani::proof, kani::unwind(24))]
pub fn a_frame_of_no_message_is_refused_for_its_identifier() {
    let (id, data) = Data::any_with_id();
    kani::assume(!matches!(id, 0x500..=0x502 | 0x510..=0x514 | 0x520..=0x526));
    kani::cover!(id == 0x527, "next to one");
    let read = Layouts::read(id, data.received(id).given());
    assert!(matches!(read, Err(DecodeError::UnknownId { id: unknown }) if unknown == id), "no such message");
    let before: AiMessages = kani::any();
    let mut after = before;
    let taken = subject().receive(&mut after, id, data.given());
    assert!(!taken && after == before, "nothing is taken of it");
}

/// Claims it of a message.
fn is_sent_under<M: Coded + Into<AnyMessage> + kani::Arbitrary>(id: u16) {
    let message: M = kani::any_where(Coded::is_held);
    let any: AnyMessage = message.into();
    let frame = subject().sent(Layouts::write(&any).unwrap_or_default());
    let data = Data::of(&frame);
    kani::cover!(data.word() != 0, "something is in it");
    assert!(frame.id == id, "the identifier");
    let data = data.received(id);
    assert!(Layouts::read(id, data.given()).ok() == Some(any), "read as the same message");
}

harnesses! {
    /// **A message is sent under its identifier.** Whatever the edition can say with it, its frame has the identifier of that message,
    /// and is read as the same message where it is not known what it is.
    ///
    /// Requirements: MSG-1, MSG-5, MSG-16, MSG-20, MSG-23, MSG-26, MSG-29, MSG-34, MSG-41, MSG-65, MSG-69, MSG-73, MSG-77,
    /// MSG-80, MSG-82.
    unwind 24;
    a_message_is_sent_as_500h = is_sent_under::<Vcu2LogDynamics1>(0x500);
    a_message_is_sent_as_501h = is_sent_under::<Ai2LogDynamics2>(0x501);
    a_message_is_sent_as_502h = is_sent_under::<Vcu2LogStatus>(0x502);
    a_message_is_sent_as_510h = is_sent_under::<Ai2VcuStatus>(0x510);
    a_message_is_sent_as_511h = is_sent_under::<Ai2VcuDriveF>(0x511);
    a_message_is_sent_as_512h = is_sent_under::<Ai2VcuDriveR>(0x512);
    a_message_is_sent_as_513h = is_sent_under::<Ai2VcuSteer>(0x513);
    a_message_is_sent_as_514h = is_sent_under::<Ai2VcuBrake>(0x514);
    a_message_is_sent_as_520h = is_sent_under::<Vcu2AiStatus>(0x520);
    a_message_is_sent_as_521h = is_sent_under::<Vcu2AiDriveF>(0x521);
    a_message_is_sent_as_522h = is_sent_under::<Vcu2AiDriveR>(0x522);
    a_message_is_sent_as_523h = is_sent_under::<Vcu2AiSteer>(0x523);
    a_message_is_sent_as_524h = is_sent_under::<Vcu2AiBrake>(0x524);
    a_message_is_sent_as_525h = is_sent_under::<Vcu2AiWheelSpeeds>(0x525);
    a_message_is_sent_as_526h = is_sent_under::<Vcu2AiWheelCounts>(0x526);
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
    a_frame_of_500h_is_read_as_its_message,
    a_frame_of_501h_is_read_as_its_message,
    a_frame_of_502h_is_read_as_its_message,
    a_frame_of_510h_is_read_as_its_message,
    a_frame_of_511h_is_read_as_its_message,
    a_frame_of_512h_is_read_as_its_message,
    a_frame_of_513h_is_read_as_its_message,
    a_frame_of_514h_is_read_as_its_message,
    a_frame_of_520h_is_read_as_its_message,
    a_frame_of_521h_is_read_as_its_message,
    a_frame_of_522h_is_read_as_its_message,
    a_frame_of_523h_is_read_as_its_message,
    a_frame_of_524h_is_read_as_its_message,
    a_frame_of_525h_is_read_as_its_message,
    a_frame_of_526h_is_read_as_its_message,
    a_frame_of_no_message_is_refused_for_its_identifier,
    a_message_is_sent_as_500h,
    a_message_is_sent_as_501h,
    a_message_is_sent_as_502h,
    a_message_is_sent_as_510h,
    a_message_is_sent_as_511h,
    a_message_is_sent_as_512h,
    a_message_is_sent_as_513h,
    a_message_is_sent_as_514h,
    a_message_is_sent_as_520h,
    a_message_is_sent_as_521h,
    a_message_is_sent_as_522h,
    a_message_is_sent_as_523h,
    a_message_is_sent_as_524h,
    a_message_is_sent_as_525h,
    a_message_is_sent_as_526h,
    the_vcu_takes_what_it_can_read_of_the_ai_computer,
];
