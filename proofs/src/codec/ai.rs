//! What the AI Computer sends (section 2.1).
//!
//! The bounds of the loops: 9 bytes are drawn, 8 are put together to a word, and of data that is too short the first
//! missing signal is looked for, among 9 in 510h.

use adsdv_spec::messages::{Ai2VcuBrake, Ai2VcuDriveF, Ai2VcuDriveR, Ai2VcuStatus, Ai2VcuSteer};

use super::data::{Data, Layout, any_is_written};
use super::names;
use crate::prelude::*;

/// **510h, AI2VCU_Status.** The status of the AI Computer is read as it is written: the HANDSHAKE bit in the first byte,
/// the mission, the direction and the numbers for the data logger. A direction without a name is refused.
///
/// Requirements: MSG-5 to MSG-8, MSG-10 to MSG-15, HS-2, D-19, D-30 to D-34.
#[cfg_attr(kani, kani::proof, kani::unwind(10))]
pub fn ai2vcu_status_510h() {
    let layout = Layout { id: 0x510, len: 8, used: [0x01, 0xF1, 0x0F, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF] };
    let data = Data::any::<Ai2VcuStatus>();
    let mission_status = names::mission_status(data.bits(1, 4, 2));
    let direction_request = names::direction_request(data.bits(1, 6, 2));
    let allowed = mission_status.is_some() && direction_request.is_some();
    kani::cover!(data.bits(1, 6, 2) == 2, "what the CAN database calls REVERSE");
    if let Some(status) = data.read::<Ai2VcuStatus>(&layout, allowed) {
        assert!(status.handshake == data.bit(0, 0), "HANDSHAKE");
        assert!(status.estop_request == data.bit(1, 0), "ESTOP_REQUEST");
        assert!(Some(status.mission_status) == mission_status, "MISSION_STATUS");
        assert!(Some(status.direction_request) == direction_request, "DIRECTION_REQUEST");
        assert!(status.lap_counter.raw() == data.bits(2, 0, 4), "LAP_COUNTER");
        assert!(i32::from(status.cones_count_actual) == data.u8_at(3), "CONES_COUNT_ACTUAL");
        assert!(i32::from(status.cones_count_all) == data.u16_at(4), "CONES_COUNT_ALL");
        assert!(status.veh_speed_actual.raw() == data.u8_at(6), "VEH_SPEED_ACTUAL_kmh");
        assert!(status.veh_speed_demand.raw() == data.u8_at(7), "VEH_SPEED_DEMAND_kmh");
    }
    any_is_written::<Ai2VcuStatus>(&layout);
}

/// **511h, AI2VCU_Drive_F.** The torque of the front axle, 0 to 195 Nm in tenths, and the speed of its motor, 0 to 4000
/// rpm, are read as they are written. More is refused.
///
/// Requirements: MSG-16, MSG-17, MSG-19, D-19, D-30, D-31, D-33, D-34.
#[cfg_attr(kani, kani::proof, kani::unwind(10))]
pub fn ai2vcu_drive_f_511h() {
    let layout = Layout { id: 0x511, len: 8, used: [0xFF, 0xFF, 0xFF, 0xFF, 0, 0, 0, 0] };
    let data = Data::any::<Ai2VcuDriveF>();
    let (torque, speed) = (data.u16_at(0), data.u16_at(2));
    kani::cover!(torque > 1950 && speed <= 4000, "the torque is too high");
    kani::cover!(torque <= 1950 && speed > 4000, "the speed is too high");
    if let Some(drive) = data.read::<Ai2VcuDriveF>(&layout, torque <= 1950 && speed <= 4000) {
        assert!(drive.front_axle_trq_request.raw() == torque, "FRONT_AXLE_TRQ_REQUEST_Nm");
        assert!(drive.front_motor_speed_max.raw() == speed, "FRONT_MOTOR_SPEED_MAX_rpm");
    }
    any_is_written::<Ai2VcuDriveF>(&layout);
}

/// **512h, AI2VCU_Drive_R.** The torque of the rear axle, 0 to 195 Nm in tenths, and the speed of its motor, 0 to 4000
/// rpm, are read as they are written. More is refused.
///
/// Requirements: MSG-20 to MSG-22, D-19, D-30, D-31, D-33, D-34.
#[cfg_attr(kani, kani::proof, kani::unwind(10))]
pub fn ai2vcu_drive_r_512h() {
    let layout = Layout { id: 0x512, len: 8, used: [0xFF, 0xFF, 0xFF, 0xFF, 0, 0, 0, 0] };
    let data = Data::any::<Ai2VcuDriveR>();
    let (torque, speed) = (data.u16_at(0), data.u16_at(2));
    kani::cover!(torque > 1950 && speed <= 4000, "the torque is too high");
    kani::cover!(torque <= 1950 && speed > 4000, "the speed is too high");
    if let Some(drive) = data.read::<Ai2VcuDriveR>(&layout, torque <= 1950 && speed <= 4000) {
        assert!(drive.rear_axle_trq_request.raw() == torque, "REAR_AXLE_TRQ_REQUEST_Nm");
        assert!(drive.rear_motor_speed_max.raw() == speed, "REAR_MOTOR_SPEED_MAX_rpm");
    }
    any_is_written::<Ai2VcuDriveR>(&layout);
}

/// **513h, AI2VCU_Steer.** The steer angle, -24.0 to 24.0 degrees in tenths and with a sign, is read as it is written.
/// More to either side is refused.
///
/// Requirements: MSG-23, MSG-24, D-19, D-30, D-31, D-33, D-34.
#[cfg_attr(kani, kani::proof, kani::unwind(10))]
pub fn ai2vcu_steer_513h() {
    let layout = Layout { id: 0x513, len: 8, used: [0xFF, 0xFF, 0, 0, 0, 0, 0, 0] };
    let data = Data::any::<Ai2VcuSteer>();
    let angle = data.i16_at(0);
    kani::cover!(angle < -240, "too far to the right");
    kani::cover!(angle > 240, "too far to the left");
    if let Some(steer) = data.read::<Ai2VcuSteer>(&layout, (-240..=240).contains(&angle)) {
        assert!(steer.steer_request.raw() == angle, "STEER_REQUEST_deg");
    }
    any_is_written::<Ai2VcuSteer>(&layout);
}

/// **514h, AI2VCU_Brake.** The brake pressures, 0 to 100 % in halves, are read as they are written. More is refused.
///
/// Requirements: MSG-26 to MSG-28, D-19, D-30, D-31, D-33, D-34.
#[cfg_attr(kani, kani::proof, kani::unwind(10))]
pub fn ai2vcu_brake_514h() {
    let layout = Layout { id: 0x514, len: 8, used: [0xFF, 0xFF, 0, 0, 0, 0, 0, 0] };
    let data = Data::any::<Ai2VcuBrake>();
    let (front, rear) = (data.u8_at(0), data.u8_at(1));
    kani::cover!(front > 200 && rear <= 200, "too much at the front");
    kani::cover!(front <= 200 && rear > 200, "too much at the rear");
    if let Some(brake) = data.read::<Ai2VcuBrake>(&layout, front <= 200 && rear <= 200) {
        assert!(brake.hyd_press_f_req.raw() == front, "HYD_PRESS_F_REQ_pct");
        assert!(brake.hyd_press_r_req.raw() == rear, "HYD_PRESS_R_REQ_pct");
    }
    any_is_written::<Ai2VcuBrake>(&layout);
}

theorems![ai2vcu_status_510h, ai2vcu_drive_f_511h, ai2vcu_drive_r_512h, ai2vcu_steer_513h, ai2vcu_brake_514h];
