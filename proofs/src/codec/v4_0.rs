//! The messages as version 4.0 lays them out (sections 2.1 to 2.3 of that version), and its reserved identifiers.
//!
//! Data of any length is drawn, also of the eight bytes with which version 3.0 sends what is shorter now: a message is read
//! if and only if all of its signals are there. The frame has the length of 4.0.
//!
//! The bounds of the loops: 520h has 25 signals, 120h has 15, no other message more than 9; 8 bytes are put together to a
//! word, 9 are drawn; there are 16 messages, and 15 entries of section 2.3.

use adsdv_spec::editions::V4_0;
use adsdv_spec::messages::{
    Ai2VcuBrake, Ai2VcuDriveF, Ai2VcuDriveR, Ai2VcuStatus, Ai2VcuSteer, Node, Vcu2AiBrake, Vcu2AiDriveF,
    Vcu2AiDriveR, Vcu2AiStatus, Vcu2AiSteer, Vcu2AiWheelSpeeds, Vcu2LogDynamics1, Vcu2LogStatus, VcuStatus,
};

use super::data::{Data, Layout, any_is_written_in};
use super::names;
use crate::prelude::*;

/// **120h, VCU_STATUS.** The modes and the states, the timeouts of the AI Computer's messages one by one, that of the
/// handshake, and the warnings are read as they are written. A number without a name is refused.
///
/// Requirements: MSG-88 to MSG-94, MSG-97, D-19, D-30, D-31, D-33, D-34, D-59, D-66.
#[cfg_attr(kani, kani::proof, kani::unwind(17))]
pub fn vcu_status_120h_in_4_0() {
    let layout = Layout { id: 0x120, len: 8, used: [0x0F, 0xF0, 0, 0, 0xC1, 0xE0, 0x0F, 0xFC] };
    let data = Data::any_in::<V4_0, VcuStatus>();
    let sm_sys = names::sm_sys(data.bits(0, 0, 4));
    let sm_as = names::sm_as(data.bits(1, 4, 4));
    let action = names::sys_action_state(data.bits(6, 0, 4));
    let allowed = sm_sys.is_some() && sm_as.is_some() && action.is_some();
    let ready_to_drive = allowed && (data.bits(1, 4, 4) == 6);
    kani::cover!(ready_to_drive, "AS_R2D, which is read though no VCU of Figure 2 sends it");
    let no_name = sm_sys.is_none() && sm_as.is_some();
    kani::cover!(no_name, "a mode without a name");
    if let Some(status) = data.read_in::<V4_0, VcuStatus>(&layout, allowed) {
        assert!(Some(status.sm_sys) == sm_sys, "SM_SYS");
        assert!(Some(status.sm_as) == sm_as, "SM_AS");
        assert!(status.status_timeout == data.bit(4, 0), "R1_AI2VCU_STATUS_TIMEOUT_ERROR");
        assert!(status.drive_f_timeout == data.bit(4, 6), "R1_AI2VCU_DRIVE_F_TIMEOUT_ERROR");
        assert!(status.drive_r_timeout == data.bit(4, 7), "R1_AI2VCU_DRIVE_R_TIMEOUT_ERROR");
        assert!(status.handshake_timeout == data.bit(5, 5), "R1_AI2VCU_STATUS_HANDSHAKE_TIMEOUT_ERROR");
        assert!(status.steer_timeout == data.bit(5, 6), "R1_AI2VCU_STEER_TIMEOUT_ERROR");
        assert!(status.brake_timeout == data.bit(5, 7), "R1_AI2VCU_BRAKE_TIMEOUT_ERROR");
        assert!(Some(status.sys_action_state) == action, "SYS_ACTION_STATE");
        assert!(status.warn_brake_plausibility == data.bit(7, 2), "WARN_BRAKE_PLAUSIBILITY");
        assert!(status.warn_kl15_under_v == data.bit(7, 3), "WARN_KL15_UNDER_V");
        assert!(status.warn_ai_estop_req == data.bit(7, 4), "WARN_AI_ESTOP_REQ");
        assert!(status.warn_ai_comms_lost == data.bit(7, 5), "WARN_AI_COMMS_LOST");
        assert!(status.warn_auto_braking == data.bit(7, 6), "WARN_AUTO_BRAKING");
        assert!(status.warn_mission_status == data.bit(7, 7), "WARN_MISSION_STATUS");
    }
    any_is_written_in::<V4_0, VcuStatus>(&layout);
}

/// **511h in 4.0, AI2VCU_Drive_F: 4 bytes.** The torque, 0 to 195 Nm in tenths, and the motor speed, 0 to 4000 rpm, stand
/// where they stood. More is refused, and longer data read.
///
/// Requirements: MSG-16, MSG-17, MSG-19, MSG-97, D-19, D-30, D-31, D-33, D-34, D-66.
#[cfg_attr(kani, kani::proof, kani::unwind(10))]
pub fn ai2vcu_drive_f_511h_in_4_0() {
    let layout = Layout { id: 0x511, len: 4, used: [0xFF, 0xFF, 0xFF, 0xFF, 0, 0, 0, 0] };
    let data = Data::any_in::<V4_0, Ai2VcuDriveF>();
    let (torque, speed) = (data.u16_at(0), data.u16_at(2));
    let longer = (data.given().len() == 8) && (torque <= 1950) && (speed <= 4000);
    kani::cover!(longer, "as version 3.0 sends it");
    if let Some(drive) = data.read_in::<V4_0, Ai2VcuDriveF>(&layout, torque <= 1950 && speed <= 4000) {
        assert!(drive.front_axle_trq_request.raw() == torque, "FRONT_AXLE_TRQ_REQUEST");
        assert!(drive.front_motor_speed_max.raw() == speed, "FRONT_MOTOR_SPEED_MAX");
    }
    any_is_written_in::<V4_0, Ai2VcuDriveF>(&layout);
}

/// **512h in 4.0, AI2VCU_Drive_R: 4 bytes.** The torque, 0 to 195 Nm in tenths, and the motor speed, 0 to 4000 rpm, stand
/// where they stood. More is refused, and longer data read.
///
/// Requirements: MSG-20 to MSG-22, MSG-97, D-19, D-30, D-31, D-33, D-34, D-66.
#[cfg_attr(kani, kani::proof, kani::unwind(10))]
pub fn ai2vcu_drive_r_512h_in_4_0() {
    let layout = Layout { id: 0x512, len: 4, used: [0xFF, 0xFF, 0xFF, 0xFF, 0, 0, 0, 0] };
    let data = Data::any_in::<V4_0, Ai2VcuDriveR>();
    let (torque, speed) = (data.u16_at(0), data.u16_at(2));
    let longer = (data.given().len() == 8) && (torque <= 1950) && (speed <= 4000);
    kani::cover!(longer, "as version 3.0 sends it");
    if let Some(drive) = data.read_in::<V4_0, Ai2VcuDriveR>(&layout, torque <= 1950 && speed <= 4000) {
        assert!(drive.rear_axle_trq_request.raw() == torque, "REAR_AXLE_TRQ_REQUEST");
        assert!(drive.rear_motor_speed_max.raw() == speed, "REAR_MOTOR_SPEED_MAX");
    }
    any_is_written_in::<V4_0, Ai2VcuDriveR>(&layout);
}

/// **513h in 4.0, AI2VCU_Steer: 2 bytes.** The steer angle, -21.0 to 21.0 degrees in tenths and with a sign, is read as it is
/// written. More to either side is refused, also what version 3.0 allows.
///
/// Requirements: MSG-23, MSG-99, MSG-97, D-19, D-30, D-31, D-33, D-34, D-66.
#[cfg_attr(kani, kani::proof, kani::unwind(10))]
pub fn ai2vcu_steer_513h_in_4_0() {
    let layout = Layout { id: 0x513, len: 2, used: [0xFF, 0xFF, 0, 0, 0, 0, 0, 0] };
    let data = Data::any_in::<V4_0, Ai2VcuSteer>();
    let angle = data.i16_at(0);
    kani::cover!(angle == -211, "too far to the right");
    kani::cover!(angle == 240, "as far to the left as version 3.0 allows");
    if let Some(steer) = data.read_in::<V4_0, Ai2VcuSteer>(&layout, (-210..=210).contains(&angle)) {
        assert!(steer.steer_request.raw() == angle, "STEER_REQUEST");
    }
    any_is_written_in::<V4_0, Ai2VcuSteer>(&layout);
}

/// **514h in 4.0, AI2VCU_Brake: 2 bytes.** The brake pressures, 0 to 100 % in halves, are read as they are written. More is
/// refused, and longer data read.
///
/// Requirements: MSG-26 to MSG-28, MSG-97, D-19, D-30, D-31, D-33, D-34, D-66.
#[cfg_attr(kani, kani::proof, kani::unwind(10))]
pub fn ai2vcu_brake_514h_in_4_0() {
    let layout = Layout { id: 0x514, len: 2, used: [0xFF, 0xFF, 0, 0, 0, 0, 0, 0] };
    let data = Data::any_in::<V4_0, Ai2VcuBrake>();
    let (front, rear) = (data.u8_at(0), data.u8_at(1));
    let longer = (data.given().len() == 8) && (front <= 200) && (rear <= 200);
    kani::cover!(longer, "as version 3.0 sends it");
    if let Some(brake) = data.read_in::<V4_0, Ai2VcuBrake>(&layout, front <= 200 && rear <= 200) {
        assert!(brake.hyd_press_f_req.raw() == front, "HYD_PRESS_F_REQ_pct");
        assert!(brake.hyd_press_r_req.raw() == rear, "HYD_PRESS_R_REQ_pct");
    }
    any_is_written_in::<V4_0, Ai2VcuBrake>(&layout);
}

/// **520h in 4.0, VCU2AI_Status.** As version 3.0 has it, with BRAKE_PLAUSIBILITY_FAULT in bit 50 and the cause 11. A cause
/// beyond is refused.
///
/// Requirements: MSG-41 to MSG-64, MSG-84, MSG-85, MSG-97, HS-3, D-19, D-30, D-31, D-33, D-34.
#[cfg_attr(kani, kani::proof, kani::unwind(26))]
pub fn vcu2ai_status_520h_in_4_0() {
    let layout = Layout { id: 0x520, len: 8, used: [0x01, 0x3F, 0xFF, 0x03, 0x03, 0xFF, 0x07, 0xFF] };
    let data = Data::any_in::<V4_0, Vcu2AiStatus>();
    let steering = data.bits(1, 4, 2);
    let as_state = names::as_state(data.bits(2, 0, 4));
    let ami_state = names::ami_state(data.bits(2, 4, 4));
    let shutdown_cause = names::shutdown_cause_of_4_0(data.u8_at(7));
    let allowed = steering <= 1 && as_state.is_some() && ami_state.is_some() && shutdown_cause.is_some();
    let new = allowed && (data.u8_at(7) == 11) && data.bit(6, 2);
    kani::cover!(new, "a brake plausibility fault, and its cause");
    let beyond = as_state.is_some() && (data.u8_at(7) == 12);
    kani::cover!(beyond, "a cause beyond");
    if let Some(status) = data.read_in::<V4_0, Vcu2AiStatus>(&layout, allowed) {
        assert!(status.handshake == data.bit(0, 0), "HANDSHAKE");
        assert!(status.shutdown_request == data.bit(1, 0), "SHUTDOWN_REQUEST");
        assert!(status.as_switch_status == data.bit(1, 1), "AS_SWITCH_STATUS");
        assert!(status.ts_switch_status == data.bit(1, 2), "TS_SWITCH_STATUS");
        assert!(status.go_signal == data.bit(1, 3), "GO_SIGNAL");
        assert!(status.steering_status == (steering == 1), "STEERING_STATUS");
        assert!(Some(status.as_state) == as_state, "AS_STATE");
        assert!(Some(status.ami_state) == ami_state, "AMI_STATE");
        assert!(status.fault_status == data.bit(3, 0), "FAULT_STATUS");
        assert!(status.warning_status == data.bit(3, 1), "WARNING_STATUS");
        assert!(status.warn_batt_temp_high == data.bit(4, 0), "WARN_BATT_TEMP_HIGH");
        assert!(status.warn_batt_soc_low == data.bit(4, 1), "WARN_BATT_SOC_LOW");
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
    any_is_written_in::<V4_0, Vcu2AiStatus>(&layout);
}

/// **521h in 4.0, VCU2AI_Drive_F: 6 bytes.** The torque of the front axle with its sign, the one asked for and the highest
/// allowed, up to 195 Nm in tenths, stand where they stood.
///
/// Requirements: MSG-65 to MSG-68, MSG-97, D-19, D-30, D-31, D-33, D-34, D-66.
#[cfg_attr(kani, kani::proof, kani::unwind(10))]
pub fn vcu2ai_drive_f_521h_in_4_0() {
    let layout = Layout { id: 0x521, len: 6, used: [0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0, 0] };
    let data = Data::any_in::<V4_0, Vcu2AiDriveF>();
    let (actual, requested, highest) = (data.i16_at(0), data.u16_at(2), data.u16_at(4));
    let allowed = (-1950..=1950).contains(&actual) && requested <= 1950 && highest <= 1950;
    let negative = allowed && (actual < 0);
    kani::cover!(negative, "it brakes");
    if let Some(drive) = data.read_in::<V4_0, Vcu2AiDriveF>(&layout, allowed) {
        assert!(drive.front_axle_trq.raw() == actual, "FRONT_AXLE_TRQ");
        assert!(drive.front_axle_trq_request.raw() == requested, "FRONT_AXLE_TRQ_REQUEST");
        assert!(drive.front_axle_trq_max.raw() == highest, "FRONT_AXLE_TRQ_MAX");
    }
    any_is_written_in::<V4_0, Vcu2AiDriveF>(&layout);
}

/// **522h in 4.0, VCU2AI_Drive_R: 6 bytes.** The torque of the rear axle with its sign, the one asked for and the highest
/// allowed, up to 195 Nm in tenths, stand where they stood; the one asked for has no sign.
///
/// Requirements: MSG-69 to MSG-72, MSG-97, D-19, D-30, D-31, D-33, D-34, D-66.
#[cfg_attr(kani, kani::proof, kani::unwind(10))]
pub fn vcu2ai_drive_r_522h_in_4_0() {
    let layout = Layout { id: 0x522, len: 6, used: [0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0, 0] };
    let data = Data::any_in::<V4_0, Vcu2AiDriveR>();
    let (actual, requested, highest) = (data.i16_at(0), data.u16_at(2), data.u16_at(4));
    let allowed = (-1950..=1950).contains(&actual) && requested <= 1950 && highest <= 1950;
    let negative = allowed && (actual < 0);
    kani::cover!(negative, "it brakes");
    if let Some(drive) = data.read_in::<V4_0, Vcu2AiDriveR>(&layout, allowed) {
        assert!(drive.rear_axle_trq.raw() == actual, "REAR_AXLE_TRQ");
        assert!(drive.rear_axle_trq_request.raw() == requested, "REAR_AXLE_TRQ_REQUEST");
        assert!(drive.rear_axle_trq_max.raw() == highest, "REAR_AXLE_TRQ_MAX");
    }
    any_is_written_in::<V4_0, Vcu2AiDriveR>(&layout);
}

/// **523h in 4.0, VCU2AI_Steer: 6 bytes.** The steer angle and the one asked for, -21.0 to 21.0 degrees in tenths, and the
/// largest allowed, 0 to 21.0 degrees, are read as they are written. More is refused, also what version 3.0 allows.
///
/// Requirements: MSG-73, MSG-75, MSG-76, MSG-97, MSG-100, D-19, D-30, D-31, D-33, D-34, D-66.
#[cfg_attr(kani, kani::proof, kani::unwind(10))]
pub fn vcu2ai_steer_523h_in_4_0() {
    let layout = Layout { id: 0x523, len: 6, used: [0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0, 0] };
    let data = Data::any_in::<V4_0, Vcu2AiSteer>();
    let (actual, largest, requested) = (data.i16_at(0), data.u16_at(2), data.i16_at(4));
    let angles = (-210..=210).contains(&actual) && (-210..=210).contains(&requested);
    let too_large = !angles && (largest <= 210);
    kani::cover!(too_large, "an angle is too large");
    let limit_too_large = angles && (largest > 210);
    kani::cover!(limit_too_large, "the limit is too large");
    if let Some(steer) = data.read_in::<V4_0, Vcu2AiSteer>(&layout, angles && largest <= 210) {
        assert!(steer.steer_angle.raw() == actual, "ANGLE");
        assert!(steer.steer_angle_max.raw() == largest, "ANGLE_MAX");
        assert!(steer.steer_angle_request.raw() == requested, "ANGLE_REQUEST");
    }
    any_is_written_in::<V4_0, Vcu2AiSteer>(&layout);
}

/// **524h in 4.0, VCU2AI_Brake: 5 bytes.** The pressures stand where they stood; STATUS_BRK is the lower half of the fifth
/// byte, STATUS_EBS its upper half. A number without a name is refused.
///
/// Requirements: MSG-77 to MSG-79, MSG-86, MSG-87, MSG-97, D-19, D-30, D-31, D-33, D-34, D-66.
#[cfg_attr(kani, kani::proof, kani::unwind(10))]
pub fn vcu2ai_brake_524h_in_4_0() {
    let layout = Layout { id: 0x524, len: 5, used: [0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0, 0, 0] };
    let data = Data::any_in::<V4_0, Vcu2AiBrake>();
    let (front, front_requested) = (data.u8_at(0), data.u8_at(1));
    let (rear, rear_requested) = (data.u8_at(2), data.u8_at(3));
    let status_brk = names::status_brk(data.bits(4, 0, 4));
    let status_ebs = names::ebs_state(data.bits(4, 4, 4));
    let pressures = front <= 200 && front_requested <= 200 && rear <= 200 && rear_requested <= 200;
    let no_name = pressures && status_brk.is_some() && status_ebs.is_none();
    kani::cover!(no_name, "an EBS without a name");
    let allowed = pressures && status_brk.is_some() && status_ebs.is_some();
    if let Some(brake) = data.read_in::<V4_0, Vcu2AiBrake>(&layout, allowed) {
        assert!(brake.hyd_press_f.raw() == front, "HYD_PRESS_F_pct");
        assert!(brake.hyd_press_f_req.raw() == front_requested, "HYD_PRESS_F_REQ_pct");
        assert!(brake.hyd_press_r.raw() == rear, "HYD_PRESS_R_pct");
        assert!(brake.hyd_press_r_req.raw() == rear_requested, "HYD_PRESS_R_REQ_pct");
        assert!(Some(brake.status_brk) == status_brk, "STATUS_BRK");
        assert!(Some(brake.status_ebs) == status_ebs, "STATUS_EBS");
    }
    any_is_written_in::<V4_0, Vcu2AiBrake>(&layout);
}

/// A message that two versions lay out alike: any data is read by both as the same or by neither, and any message is written
/// by both as the same frame.
pub(super) fn alike<Old, New, M: Coded<Old> + Coded<New> + kani::Arbitrary>(id: u16, len: u8) {
    let data = Data::any_in::<New, M>();
    let old = <M as Coded<Old>>::decode(data.given()).ok();
    let new = <M as Coded<New>>::decode(data.received(id).given()).ok();
    kani::cover!(new.is_some(), "it is a message");
    kani::cover!(new.is_none(), "it is none");
    assert!(new == old, "read as the same, or by neither");

    let message: M = kani::any();
    let old = <M as Coded<Old>>::encode(&message);
    let new = subject().sent(<M as Coded<New>>::encode(&message));
    assert!(new.id == id && old.id == id, "the identifier");
    assert!(new.len == len && old.len == len, "the length");
    assert!(u64::from_le_bytes(new.data) == u64::from_le_bytes(old.data), "the same bits");
}

/// **500h in 4.0, VCU2LOG_Dynamics1, is read and written as in 3.0**, but for the names of its signals.
///
/// Requirements: MSG-29 to MSG-33, MSG-97.
#[cfg_attr(kani, kani::proof, kani::unwind(10))]
pub fn vcu2log_dynamics1_500h_in_4_0() {
    alike::<Layouts, V4_0, Vcu2LogDynamics1>(0x500, 8);
}

/// **502h in 4.0, VCU2LOG_Status, is read and written as in 3.0**, but for a name.
///
/// Requirements: MSG-34 to MSG-40, MSG-97.
#[cfg_attr(kani, kani::proof, kani::unwind(10))]
pub fn vcu2log_status_502h_in_4_0() {
    alike::<Layouts, V4_0, Vcu2LogStatus>(0x502, 5);
}

/// **510h in 4.0, AI2VCU_Status, is read and written as in 3.0**, but for two names.
///
/// Requirements: MSG-5 to MSG-8, MSG-10 to MSG-15, MSG-97, HS-2.
#[cfg_attr(kani, kani::proof, kani::unwind(10))]
pub fn ai2vcu_status_510h_in_4_0() {
    alike::<Layouts, V4_0, Ai2VcuStatus>(0x510, 8);
}

/// **525h in 4.0, VCU2AI_Speeds, is read and written as VCU2AI_Wheel_speeds in 3.0.**
///
/// Requirements: MSG-81, MSG-97, MSG-101.
#[cfg_attr(kani, kani::proof, kani::unwind(10))]
pub fn vcu2ai_speeds_525h_in_4_0() {
    alike::<Layouts, V4_0, Vcu2AiWheelSpeeds>(0x525, 8);
}

/// **The lengths and cycles of 4.0.** Its sixteen messages are sent every 10 ms, 502h every 100 ms; 120h, 500h, 510h, 520h,
/// 525h and 526h have 8 bytes, 501h, 521h, 522h and 523h 6, 502h and 524h 5, 511h and 512h 4, 513h and 514h 2.
///
/// Requirements: MSG-95 to MSG-98, MSG-102, D-34.
#[cfg_attr(kani, kani::proof, kani::unwind(18))]
pub fn lengths_and_cycles_of_4_0() {
    let subject = subject();
    let messages = subject.machine_of_4_0().edition().bus.messages;
    assert!(messages.len() == 16, "sixteen messages");
    for message in messages {
        let len = match message.id {
            0x120 | 0x500 | 0x510 | 0x520 | 0x525 | 0x526 => 8,
            0x501 | 0x521 | 0x522 | 0x523 => 6,
            0x502 | 0x524 => 5,
            0x511 | 0x512 => 4,
            0x513 | 0x514 => 2,
            _ => 0,
        };
        kani::cover!(len == 2, "two bytes are enough");
        assert!(message.len == len, "the length");
        assert!(message.cycle_ms == if message.id == 0x502 { 100 } else { 10 }, "the cycle");
        let by_ai = matches!(message.id, 0x501 | 0x510..=0x514);
        assert!((message.sender == Node::Ai) == by_ai, "the sender");
    }
}

/// The list of section 2.3 of version 4.0.
pub(super) const fn section_2_3(id: u16) -> bool {
    matches!(
        id,
        0x000
            | 0x080..=0x084
            | 0x120..=0x124
            | 0x181..=0x184
            | 0x284
            | 0x301
            | 0x410..=0x41F
            | 0x450..=0x470
            | 0x4E2
            | 0x4FD..=0x4FF
            | 0x550
            | 0x581..=0x584
            | 0x600..=0x640
            | 0x650..=0x660
            | 0x700..=0x705
    )
}

/// **Reserved in 4.0 is what its section 2.3 lists.** Of all identifiers these, and no others: 600h to 640h and 650h to 660h
/// among them, 100h and 201h no longer.
///
/// Requirements: ID-1, ID-2, ID-4, ID-5, ID-7 to ID-14, ID-17 to ID-19.
#[cfg_attr(kani, kani::proof, kani::unwind(18))]
pub fn reserved_is_what_section_2_3_of_4_0_lists() {
    let id: u16 = kani::any();
    kani::cover!(section_2_3(id), "it is reserved");
    kani::cover!(id == 0x641, "between the two ranges");
    let subject = subject();
    let reserved = subject.machine_of_4_0().edition().bus.is_reserved(id);
    assert!(reserved == section_2_3(id), "as the list says");
}

/// **Who may send what in 4.0.** The AI Computer its own messages, and what is neither the VCU's nor reserved; the VCU, which
/// sends the reserved 120h, all but the messages of the AI Computer.
///
/// Requirements: ID-1, ID-2, ID-4, ID-5, ID-7 to ID-14, ID-17 to ID-19, MSG-88.
#[cfg_attr(kani, kani::proof, kani::unwind(18))]
pub fn who_may_send_what_in_4_0() {
    let (node, id): (Node, u16) = (kani::any(), kani::any());
    let may = match node {
        Node::Ai => !matches!(id, 0x500 | 0x502 | 0x520..=0x526) && !section_2_3(id),
        Node::Vcu => !matches!(id, 0x501 | 0x510..=0x514),
    };
    let status = may && (id == 0x120);
    kani::cover!(status, "120h");
    let subject = subject();
    assert!(subject.machine_of_4_0().edition().bus.may_send(node, id) == may, "as the document says");
}

theorems![
    vcu_status_120h_in_4_0,
    ai2vcu_drive_f_511h_in_4_0,
    ai2vcu_drive_r_512h_in_4_0,
    ai2vcu_steer_513h_in_4_0,
    ai2vcu_brake_514h_in_4_0,
    vcu2ai_status_520h_in_4_0,
    vcu2ai_drive_f_521h_in_4_0,
    vcu2ai_drive_r_522h_in_4_0,
    vcu2ai_steer_523h_in_4_0,
    vcu2ai_brake_524h_in_4_0,
    vcu2log_dynamics1_500h_in_4_0,
    vcu2log_status_502h_in_4_0,
    ai2vcu_status_510h_in_4_0,
    vcu2ai_speeds_525h_in_4_0;
    every lengths_and_cycles_of_4_0, reserved_is_what_section_2_3_of_4_0_lists, who_may_send_what_in_4_0
];
