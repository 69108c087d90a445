//! What the VCU sends (section 2.2).
//!
//! The bounds of the loops are those of [`ai`](super::ai), but for the 23 signals of 520h.

use adsdv_spec::messages::{
    Vcu2AiBrake, Vcu2AiDriveF, Vcu2AiDriveR, Vcu2AiStatus, Vcu2AiSteer, Vcu2AiWheelCounts, Vcu2AiWheelSpeeds,
};

use super::data::{Data, Layout, any_is_written};
use super::names;
use crate::prelude::*;

/// **520h, VCU2AI_Status.** The status of the VCU is read as it is written: the HANDSHAKE bit in the first byte, the
/// switches, the states, the warnings, the faults one by one and the cause of a shutdown. A number without a name is
/// refused.
///
/// Requirements: MSG-41 to MSG-64, HS-3, D-19, D-30, D-31, D-33, D-34.
#[cfg_attr(kani, kani::proof, kani::unwind(24))]
pub fn vcu2ai_status_520h() {
    let layout = Layout { id: 0x520, len: 8, used: [0x01, 0x3F, 0xFF, 0x03, 0x03, 0xFF, 0x03, 0xFF] };
    let data = Data::any::<Vcu2AiStatus>();
    let steering = data.bits(1, 4, 2);
    let as_state = names::as_state(data.bits(2, 0, 4));
    let ami_state = names::ami_state(data.bits(2, 4, 4));
    let shutdown_cause = names::shutdown_cause(data.u8_at(7));
    let allowed = steering <= 1 && as_state.is_some() && ami_state.is_some() && shutdown_cause.is_some();
    kani::cover!(
        steering == 2 && as_state.is_some() && ami_state.is_some(),
        "the second bit of STEERING_STATUS"
    );
    kani::cover!(as_state.is_some() && shutdown_cause.is_none(), "a cause without a name");
    if let Some(status) = data.read::<Vcu2AiStatus>(&layout, allowed) {
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
        assert!(Some(status.shutdown_cause) == shutdown_cause, "SHUTDOWN_CAUSE");
    }
    any_is_written::<Vcu2AiStatus>(&layout);
}

/// **521h, VCU2AI_Drive_F.** The torque of the front axle, -195 to 195 Nm in tenths and with a sign, the torque asked for
/// and the highest allowed, 0 to 195 Nm, are read as they are written. More is refused.
///
/// Requirements: MSG-65 to MSG-68, D-19, D-30, D-31, D-33, D-34.
#[cfg_attr(kani, kani::proof, kani::unwind(10))]
pub fn vcu2ai_drive_f_521h() {
    let layout = Layout { id: 0x521, len: 8, used: [0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0, 0] };
    let data = Data::any::<Vcu2AiDriveF>();
    let (actual, requested, highest) = (data.i16_at(0), data.u16_at(2), data.u16_at(4));
    let allowed = (-1950..=1950).contains(&actual) && requested <= 1950 && highest <= 1950;
    kani::cover!(actual < -1950 && requested <= 1950 && highest <= 1950, "it brakes too hard");
    if let Some(drive) = data.read::<Vcu2AiDriveF>(&layout, allowed) {
        assert!(drive.front_axle_trq.raw() == actual, "FRONT_AXLE_TRQ_Nm");
        assert!(drive.front_axle_trq_request.raw() == requested, "FRONT_AXLE_TRQ_REQUEST_Nm");
        assert!(drive.front_axle_trq_max.raw() == highest, "FRONT_AXLE_TRQ_MAX_Nm");
    }
    any_is_written::<Vcu2AiDriveF>(&layout);
}

/// **522h, VCU2AI_Drive_R.** The torque of the rear axle, -195 to 195 Nm in tenths and with a sign, the torque asked for
/// and the highest allowed, 0 to 195 Nm, are read as they are written. More is refused.
///
/// Requirements: MSG-69 to MSG-72, D-19, D-30, D-31, D-33, D-34.
#[cfg_attr(kani, kani::proof, kani::unwind(10))]
pub fn vcu2ai_drive_r_522h() {
    let layout = Layout { id: 0x522, len: 8, used: [0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0, 0] };
    let data = Data::any::<Vcu2AiDriveR>();
    let (actual, requested, highest) = (data.i16_at(0), data.u16_at(2), data.u16_at(4));
    let allowed = (-1950..=1950).contains(&actual) && requested <= 1950 && highest <= 1950;
    kani::cover!(actual < -1950 && requested <= 1950 && highest <= 1950, "it brakes too hard");
    if let Some(drive) = data.read::<Vcu2AiDriveR>(&layout, allowed) {
        assert!(drive.rear_axle_trq.raw() == actual, "REAR_AXLE_TRQ_Nm");
        assert!(drive.rear_axle_trq_request.raw() == requested, "REAR_AXLE_TRQ_REQUEST_Nm");
        assert!(drive.rear_axle_trq_max.raw() == highest, "REAR_AXLE_TRQ_MAX_Nm");
    }
    any_is_written::<Vcu2AiDriveR>(&layout);
}

/// **523h, VCU2AI_Steer.** The steer angle and the one asked for, -24.0 to 24.0 degrees in tenths and with a sign, and the
/// largest allowed, 0 to 24.0 degrees, are read as they are written. More is refused.
///
/// Requirements: MSG-73 to MSG-76, D-19, D-30, D-31, D-33, D-34.
#[cfg_attr(kani, kani::proof, kani::unwind(10))]
pub fn vcu2ai_steer_523h() {
    let layout = Layout { id: 0x523, len: 8, used: [0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0, 0] };
    let data = Data::any::<Vcu2AiSteer>();
    let (actual, largest, requested) = (data.i16_at(0), data.u16_at(2), data.i16_at(4));
    let angles = (-240..=240).contains(&actual) && (-240..=240).contains(&requested);
    kani::cover!(!angles && largest <= 240, "an angle is too large");
    kani::cover!(angles && largest > 240, "the limit is too large");
    if let Some(steer) = data.read::<Vcu2AiSteer>(&layout, angles && largest <= 240) {
        assert!(steer.steer_angle.raw() == actual, "STEER_ANGLE_deg");
        assert!(steer.steer_angle_max.raw() == largest, "STEER_ANGLE_MAX_deg");
        assert!(steer.steer_angle_request.raw() == requested, "STEER_ANGLE_REQUEST_deg");
    }
    any_is_written::<Vcu2AiSteer>(&layout);
}

/// **524h, VCU2AI_Brake.** The brake pressures and those asked for, 0 to 100 % in halves, are read as they are written.
/// More is refused.
///
/// Requirements: MSG-77 to MSG-79, D-19, D-30, D-31, D-33, D-34.
#[cfg_attr(kani, kani::proof, kani::unwind(10))]
pub fn vcu2ai_brake_524h() {
    let layout = Layout { id: 0x524, len: 8, used: [0xFF, 0xFF, 0xFF, 0xFF, 0, 0, 0, 0] };
    let data = Data::any::<Vcu2AiBrake>();
    let (front, front_requested) = (data.u8_at(0), data.u8_at(1));
    let (rear, rear_requested) = (data.u8_at(2), data.u8_at(3));
    let allowed = front <= 200 && front_requested <= 200 && rear <= 200 && rear_requested <= 200;
    kani::cover!(!allowed && front <= 200 && rear <= 200, "too much is asked for");
    if let Some(brake) = data.read::<Vcu2AiBrake>(&layout, allowed) {
        assert!(brake.hyd_press_f.raw() == front, "HYD_PRESS_F_pct");
        assert!(brake.hyd_press_f_req.raw() == front_requested, "HYD_PRESS_F_REQ_pct");
        assert!(brake.hyd_press_r.raw() == rear, "HYD_PRESS_R_pct");
        assert!(brake.hyd_press_r_req.raw() == rear_requested, "HYD_PRESS_R_REQ_pct");
    }
    any_is_written::<Vcu2AiBrake>(&layout);
}

/// **525h, VCU2AI_Wheel_speeds.** The speeds of the four wheels, 0 to 1250 rpm, are read as they are written. More is
/// refused.
///
/// Requirements: MSG-80, MSG-81, D-19, D-30, D-31, D-33, D-34.
#[cfg_attr(kani, kani::proof, kani::unwind(10))]
pub fn vcu2ai_wheel_speeds_525h() {
    let layout = Layout { id: 0x525, len: 8, used: [0xFF; 8] };
    let data = Data::any::<Vcu2AiWheelSpeeds>();
    let (fl, fr, rl, rr) = (data.u16_at(0), data.u16_at(2), data.u16_at(4), data.u16_at(6));
    let allowed = fl <= 1250 && fr <= 1250 && rl <= 1250 && rr <= 1250;
    kani::cover!(!allowed && fl <= 1250 && fr <= 1250 && rl <= 1250, "the last wheel is too fast");
    if let Some(speeds) = data.read::<Vcu2AiWheelSpeeds>(&layout, allowed) {
        assert!(speeds.fl_wheel_speed.raw() == fl, "FL_WHEEL_SPEED_rpm");
        assert!(speeds.fr_wheel_speed.raw() == fr, "FR_WHEEL_SPEED_rpm");
        assert!(speeds.rl_wheel_speed.raw() == rl, "RL_WHEEL_SPEED_rpm");
        assert!(speeds.rr_wheel_speed.raw() == rr, "RR_WHEEL_SPEED_rpm");
    }
    any_is_written::<Vcu2AiWheelSpeeds>(&layout);
}

/// **526h, VCU2AI_Wheel_counts.** The pulse counts of the four wheels, 0 to 65535, are read as they are written. None is
/// refused.
///
/// Requirements: MSG-82, MSG-83, D-30, D-31, D-33, D-34.
#[cfg_attr(kani, kani::proof, kani::unwind(10))]
pub fn vcu2ai_wheel_counts_526h() {
    let layout = Layout { id: 0x526, len: 8, used: [0xFF; 8] };
    let data = Data::any::<Vcu2AiWheelCounts>();
    kani::cover!(data.u16_at(0) == 65535, "the count is about to begin anew");
    if let Some(counts) = data.read::<Vcu2AiWheelCounts>(&layout, true) {
        assert!(i32::from(counts.fl_pulse_count) == data.u16_at(0), "FL_PULSE_COUNT");
        assert!(i32::from(counts.fr_pulse_count) == data.u16_at(2), "FR_PULSE_COUNT");
        assert!(i32::from(counts.rl_pulse_count) == data.u16_at(4), "RL_PULSE_COUNT");
        assert!(i32::from(counts.rr_pulse_count) == data.u16_at(6), "RR_PULSE_COUNT");
    }
    any_is_written::<Vcu2AiWheelCounts>(&layout);
}

theorems![
    vcu2ai_status_520h,
    vcu2ai_drive_f_521h,
    vcu2ai_drive_r_522h,
    vcu2ai_steer_523h,
    vcu2ai_brake_524h,
    vcu2ai_wheel_speeds_525h,
    vcu2ai_wheel_counts_526h,
];
