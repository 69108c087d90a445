//! What the CAN database of 2026 has otherwise than version 4.0. All other messages are laid out by the layouts of 4.0, or of
//! 3.0 before it, as one theorem here says, and theorems on those say how.
//!
//! The bounds of the loops: 520h has 27 signals, no other message more than 9; 8 bytes are put together to a word, 9 are
//! drawn; there are 15 messages, 33 of devices, 15 entries of section 2.3, and names have up to 41 letters.

use adsdv_spec::editions::{V4_0, V2026};
use adsdv_spec::messages::{
    Ai2VcuSteer, AnyMessage, DecodeError, Node, Vcu2AiDriveR, Vcu2AiStatus, Vcu2AiSteer, Vcu2LogDynamics1,
    VcuStatus,
};

use super::data::{Data, Layout, any_is_written_in};
use super::names;
use super::v4_0::{alike, section_2_3};
use crate::outputs_of_4_0::{NAMES, same};
use crate::prelude::*;

/// **513h in 2026, AI2VCU_Steer.** The steer angle, -30.0 to 30.0 degrees in tenths and with a sign, is read as it is written.
/// More to either side is refused.
///
/// Requirements: MSG-23, MSG-105, MSG-113, D-19, D-30, D-31, D-33, D-34, D-66.
#[cfg_attr(kani, kani::proof, kani::unwind(10))]
pub fn ai2vcu_steer_513h_in_2026() {
    let layout = Layout { id: 0x513, len: 2, used: [0xFF, 0xFF, 0, 0, 0, 0, 0, 0] };
    let data = Data::any_in::<V2026, Ai2VcuSteer>();
    let angle = data.i16_at(0);
    kani::cover!(angle == -301, "too far to the right");
    kani::cover!(angle == 300, "farther to the left than 4.0 allows");
    if let Some(steer) = data.read_in::<V2026, Ai2VcuSteer>(&layout, (-300..=300).contains(&angle)) {
        assert!(steer.steer_request.raw() == angle, "STEER_REQUEST");
    }
    any_is_written_in::<V2026, Ai2VcuSteer>(&layout);
}

/// **520h in 2026, VCU2AI_Status.** As version 4.0 has it, with the states of the operation, of the tractive system and of the
/// EBS in the upper halves of three bytes, of which 15 is the fault. AS_INIT, 0, is read as AS_OFF and never written. A number
/// without a name is refused.
///
/// Requirements: MSG-41 to MSG-64, MSG-84, MSG-85, MSG-106 to MSG-109, MSG-113, HS-3, D-19, D-30, D-31, D-33, D-34, D-68 to
/// D-70.
#[cfg_attr(kani, kani::proof, kani::unwind(29))]
pub fn vcu2ai_status_520h_in_2026() {
    let layout = Layout { id: 0x520, len: 8, used: [0xF1, 0x3F, 0xFF, 0xF3, 0xF3, 0xFF, 0x07, 0xFF] };
    let data = Data::any_in::<V2026, Vcu2AiStatus>();
    let steering = data.bits(1, 4, 2);
    let as_state = names::as_state_of_2026(data.bits(2, 0, 4));
    let ami_state = names::ami_state(data.bits(2, 4, 4));
    let shutdown_cause = names::shutdown_cause_of_4_0(data.u8_at(7));
    let op_state = names::op_state(data.bits(0, 4, 4));
    let ts_state = names::ts_state(data.bits(3, 4, 4));
    let ebs_state = names::ebs_stage(data.bits(4, 4, 4));
    let as_in_4_0 = steering <= 1 && as_state.is_some() && ami_state.is_some() && shutdown_cause.is_some();
    let allowed = as_in_4_0 && op_state.is_some() && ts_state.is_some() && ebs_state.is_some();
    let init = data.bits(2, 0, 4) == 0;
    let initialises = allowed && init;
    kani::cover!(initialises, "AS_INIT");
    let fault = allowed && (data.bits(0, 4, 4) == 15) && (data.bits(4, 4, 4) == 4);
    kani::cover!(fault, "a fault, and an EBS that discharges");
    let no_name = as_in_4_0 && op_state.is_some() && ebs_state.is_some() && (data.bits(3, 4, 4) == 5);
    kani::cover!(no_name, "a tractive system without a name");
    let meant = data.word() | u64::from(init) << 16;
    if let Some(status) = data.read_as_in::<V2026, Vcu2AiStatus>(&layout, allowed, meant) {
        assert!(status.handshake == data.bit(0, 0), "HANDSHAKE");
        assert!(Some(status.op_state) == op_state, "OP_STATE");
        assert!(status.shutdown_request == data.bit(1, 0), "SHUTDOWN_REQUEST");
        assert!(status.as_switch_status == data.bit(1, 1), "AS_SWITCH_STATUS");
        assert!(status.ts_switch_status == data.bit(1, 2), "TS_SWITCH_STATUS");
        assert!(status.go_signal == data.bit(1, 3), "GO_SIGNAL");
        assert!(status.steering_status == (steering == 1), "STEERING_STATUS");
        assert!(Some(status.as_state) == as_state, "AS_STATE");
        assert!(Some(status.ami_state) == ami_state, "AMI_STATE");
        assert!(status.fault_status == data.bit(3, 0), "FAULT_STATUS");
        assert!(status.warning_status == data.bit(3, 1), "WARNING_STATUS");
        assert!(Some(status.ts_state) == ts_state, "TS_STATE");
        assert!(status.warn_batt_temp_high == data.bit(4, 0), "WARN_BATT_TEMP_HIGH");
        assert!(status.warn_batt_soc_low == data.bit(4, 1), "WARN_BATT_SOC_LOW");
        assert!(Some(status.ebs_state) == ebs_state, "EBS_STATE");
        assert!(status.ai_estop_request == data.bit(5, 0), "AI_ESTOP_REQUEST");
        assert!(status.hvil_open_fault == data.bit(5, 1), "HVIL_OPEN_FAULT");
        assert!(status.hvil_short_fault == data.bit(5, 2), "HVIL_SHORT_FAULT");
        assert!(status.ebs_fault == data.bit(5, 3), "EBS_FAULT");
        assert!(status.offboard_charger_fault == data.bit(5, 4), "OFFBOARD_CHARGER_FAULT");
        assert!(status.ai_comms_lost == data.bit(5, 5), "AI_COMMS_LOST");
        assert!(status.autonomous_braking_fault == data.bit(5, 6), "AUTONOMOUS_BRAKING_FAULT");
        assert!(status.mission_status_fault == data.bit(5, 7), "MISSION_STATUS_FAULT");
        assert!(status.charge_procedure_fault == data.bit(6, 0), "CHARGE_PROCEDURE_FAULT");
        assert!(status.bms_fault == data.bit(6, 1), "BMS_FAULT");
        assert!(status.brake_plausibility_fault == data.bit(6, 2), "BRAKE_PLAUSIBILITY_FAULT");
        assert!(Some(status.shutdown_cause) == shutdown_cause, "SHUTDOWN_CAUSE");
    }
    any_is_written_in::<V2026, Vcu2AiStatus>(&layout);
}

/// **522h in 2026, VCU2AI_Drive_R, is read and written as in 4.0**, but for the names of its signals.
///
/// Requirements: MSG-69 to MSG-72, MSG-113.
#[cfg_attr(kani, kani::proof, kani::unwind(10))]
pub fn vcu2ai_drive_r_522h_in_2026() {
    alike::<V4_0, V2026, Vcu2AiDriveR>(0x522, 6);
}

/// **523h in 2026, VCU2AI_Steer.** The steer angle and the one asked for, -30.0 to 30.0 degrees in tenths, and the largest
/// allowed, 0 to 30.0 degrees, are read as they are written. More is refused.
///
/// Requirements: MSG-73, MSG-75, MSG-76, MSG-110, MSG-113, D-19, D-30, D-31, D-33, D-34, D-66.
#[cfg_attr(kani, kani::proof, kani::unwind(10))]
pub fn vcu2ai_steer_523h_in_2026() {
    let layout = Layout { id: 0x523, len: 6, used: [0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0, 0] };
    let data = Data::any_in::<V2026, Vcu2AiSteer>();
    let (actual, largest, requested) = (data.i16_at(0), data.u16_at(2), data.i16_at(4));
    let angles = (-300..=300).contains(&actual) && (-300..=300).contains(&requested);
    let too_large = !angles && (largest <= 300);
    kani::cover!(too_large, "an angle is too large");
    let limit_too_large = angles && (largest > 300);
    kani::cover!(limit_too_large, "the limit is too large");
    if let Some(steer) = data.read_in::<V2026, Vcu2AiSteer>(&layout, angles && largest <= 300) {
        assert!(steer.steer_angle.raw() == actual, "ANGLE");
        assert!(steer.steer_angle_max.raw() == largest, "ANGLE_MAX");
        assert!(steer.steer_angle_request.raw() == requested, "ANGLE_REQUEST");
    }
    any_is_written_in::<V2026, Vcu2AiSteer>(&layout);
}

/// **500h in 2026, VCU2LOG_Dynamics1, is read and written as in 4.0**, but more seldom sent.
///
/// Requirements: MSG-29 to MSG-33, MSG-113.
#[cfg_attr(kani, kani::proof, kani::unwind(10))]
pub fn vcu2log_dynamics1_500h_in_2026() {
    alike::<V4_0, V2026, Vcu2LogDynamics1>(0x500, 8);
}

/// **120h is no message of 2026.** Whatever its data, it is refused as unknown; and the VCU_STATUS of 4.0, whatever it says,
/// cannot be said and has no frame.
///
/// Requirements: MSG-116.
#[cfg_attr(kani, kani::proof, kani::unwind(18))]
pub fn vcu_status_120h_is_no_message_of_2026() {
    let data = Data::any_in::<V4_0, VcuStatus>();
    let subject = subject();
    let bus = &subject.machine_of_2026().edition().bus;
    let (in_4_0, in_2026) = (V4_0::read(0x120, data.given()), V2026::read(0x120, data.given()));
    kani::cover!(in_4_0.is_ok(), "it is a message of 4.0");
    assert!(matches!(in_2026, Err(DecodeError::UnknownId { id: 0x120 })), "refused as unknown");
    let status = AnyMessage::VcuStatus(kani::any());
    assert!(!V2026::holds(&status) && V2026::write(&status).is_none(), "it cannot be said");
    assert!(bus.message(0x120).is_none(), "it is not in the table");
}

/// Whether a frame was read, or not, as this message of 2026 is.
fn read_as<M: Coded<V2026> + Into<AnyMessage>>(read: Option<AnyMessage>, data: &Data) -> bool {
    let message = <M as Coded<V2026>>::decode(data.given()).ok();
    read == message.map(Into::into)
}

/// **What 2026 does not lay out anew is read and written as in 4.0.** 513h, 520h and 523h are read and written as these messages
/// by themselves, 120h is neither, and every other identifier, data and message as in 4.0.
///
/// Requirements: MSG-113, MSG-116, D-19, D-33.
#[cfg_attr(kani, kani::proof, kani::unwind(29))]
pub fn what_2026_does_not_lay_out_anew_is_as_in_4_0() {
    let (id, data) = Data::any_with_id();
    let read = V2026::read(id, data.received(id).given()).ok();
    let other = read.is_some() && (id == 0x524);
    kani::cover!(other, "the brakes, as in 4.0");
    let status = read.is_some() && (id == 0x520);
    kani::cover!(status, "the status, as in 2026");
    let as_it_should_be = match id {
        0x120 => read.is_none(),
        0x513 => read_as::<Ai2VcuSteer>(read, &data),
        0x520 => read_as::<Vcu2AiStatus>(read, &data),
        0x523 => read_as::<Vcu2AiSteer>(read, &data),
        _ => read == V4_0::read(id, data.given()).ok(),
    };
    assert!(as_it_should_be, "as the message by itself, or as in 4.0");

    let message: AnyMessage = kani::any();
    let written = V2026::write(&message).map(|frame| subject().sent(frame));
    let expected = match &message {
        AnyMessage::VcuStatus(_) => None,
        AnyMessage::Ai2VcuSteer(steer) => Some(<Ai2VcuSteer as Coded<V2026>>::encode(steer)),
        AnyMessage::Vcu2AiStatus(status) => Some(<Vcu2AiStatus as Coded<V2026>>::encode(status)),
        AnyMessage::Vcu2AiSteer(steer) => Some(<Vcu2AiSteer as Coded<V2026>>::encode(steer)),
        other => V4_0::write(other),
    };
    match (written, expected) {
        (Some(written), Some(expected)) => {
            assert!(written.id == expected.id && written.len == expected.len, "the same message");
            let (written, expected) = (u64::from_le_bytes(written.data), u64::from_le_bytes(expected.data));
            assert!(written == expected, "the same bits");
        }
        (written, expected) => assert!(written.is_none() && expected.is_none(), "no frame"),
    }
}

/// **The lengths and cycles of 2026.** Its fifteen messages are sent every 10 ms, 500h and 502h every 100 ms. 120h is not
/// among them, and the others are as long as in 4.0.
///
/// Requirements: MSG-96, MSG-98, MSG-111 to MSG-113, MSG-116, D-34.
#[cfg_attr(kani, kani::proof, kani::unwind(17))]
pub fn lengths_and_cycles_of_2026() {
    let subject = subject();
    let messages = subject.machine_of_2026().edition().bus.messages;
    assert!(messages.len() == 15, "fifteen messages");
    for message in messages {
        let len = match message.id {
            0x500 | 0x510 | 0x520 | 0x525 | 0x526 => 8,
            0x501 | 0x521 | 0x522 | 0x523 => 6,
            0x502 | 0x524 => 5,
            0x511 | 0x512 => 4,
            0x513 | 0x514 => 2,
            _ => 0,
        };
        let slow = matches!(message.id, 0x500 | 0x502);
        kani::cover!(slow, "every 100 ms");
        assert!(len != 0 && message.len == len, "the length");
        assert!(message.cycle_ms == if slow { 100 } else { 10 }, "the cycle");
        let by_ai = matches!(message.id, 0x501 | 0x510..=0x514);
        assert!((message.sender == Node::Ai) == by_ai, "the sender");
    }
}

/// What the database of 2026 calls otherwise than version 4.0: three signals of 522h, by their start bits.
const fn name_in_2026(id: u16, start: u8, name_in_4_0: &'static str) -> &'static str {
    match (id, start) {
        (0x522, 0) => "REAR_AXLE_TRQ_Nm",
        (0x522, 16) => "REAR_AXLE_TRQ_REQUEST_Nm",
        (0x522, 32) => "REAR_AXLE_TRQ_MAX_Nm",
        _ => name_in_4_0,
    }
}

/// **The names of 2026**: those that 4.0 changes are as in 4.0, but for three signals of 522h.
///
/// Requirements: MSG-101, MSG-114.
#[cfg_attr(kani, kani::proof, kani::unwind(43))]
pub fn names_of_2026() {
    let subject = subject();
    let (mut signals, mut speeds) = (0, false);
    for message in subject.machine_of_2026().edition().bus.messages {
        speeds |= message.id == 0x525 && same(message.name, "VCU2AI_Speeds");
        for signal in message.signals {
            for (id, start, name_in_4_0) in NAMES {
                if message.id == id && signal.start == start {
                    let name = name_in_2026(id, start, name_in_4_0);
                    assert!(same(signal.name, name), "the name");
                    signals += 1;
                }
            }
        }
    }
    kani::cover!(speeds, "VCU2AI_Speeds");
    assert!(speeds, "the name of 525h");
    assert!(signals == NAMES.len(), "each of them is there");
}

/// **Who may send what in 2026.** The AI Computer its own messages, and what is neither the VCU's nor a device's nor reserved
/// by section 2.3 of version 4.0; the VCU what is neither the AI Computer's nor a device's.
///
/// Requirements: ID-1, ID-2, ID-4, ID-5, ID-7 to ID-14, ID-17 to ID-20.
#[cfg_attr(kani, kani::proof, kani::unwind(35))]
pub fn who_may_send_what_in_2026() {
    let (node, id): (Node, u16) = (kani::any(), kani::any());
    let of_vcu = matches!(id, 0x000 | 0x080 | 0x300..=0x302);
    let of_others = matches!(
        id,
        0x081
            | 0x084
            | 0x123
            | 0x181
            | 0x184
            | 0x284
            | 0x600
            | 0x610
            | 0x611
            | 0x620..=0x628
            | 0x630
            | 0x640
            | 0x650..=0x657
    );
    let may = match node {
        Node::Ai => !matches!(id, 0x500 | 0x502 | 0x520..=0x526) && !section_2_3(id) && !of_vcu && !of_others,
        Node::Vcu => !matches!(id, 0x501 | 0x510..=0x514) && !of_others,
    };
    let only_here = !may && !section_2_3(id) && (id == 0x302);
    kani::cover!(only_here, "302h, which no list reserves");
    let of_vcu_alone = may && of_vcu;
    kani::cover!(of_vcu_alone, "from the VCU to a device");
    let subject = subject();
    assert!(subject.machine_of_2026().edition().bus.may_send(node, id) == may, "as the database says");
}

theorems![
    ai2vcu_steer_513h_in_2026,
    vcu2ai_status_520h_in_2026,
    vcu2ai_drive_r_522h_in_2026,
    vcu2ai_steer_523h_in_2026,
    vcu2log_dynamics1_500h_in_2026,
    vcu_status_120h_is_no_message_of_2026,
    what_2026_does_not_lay_out_anew_is_as_in_4_0;
    every lengths_and_cycles_of_2026, names_of_2026, who_may_send_what_in_2026
];
