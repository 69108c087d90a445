//! What both sides send for the data logger (sections 2.1 and 2.2).
//!
//! The bounds of the loops are those of [`ai`](super::ai); no message has more than 8 signals here.

use adsdv_spec::messages::{Ai2LogDynamics2, Vcu2LogDynamics1, Vcu2LogStatus};

use super::data::{Data, Layout, any_is_written};
use super::names;
use crate::prelude::*;

/// **500h, VCU2LOG_Dynamics1.** Speeds, steer angles, braking and torques, actual and asked for, are read as they are
/// written: angles and torques with a sign. Braking of more than 100 %, and torques of more to either side, are refused.
///
/// Requirements: MSG-29 to MSG-33, D-19, D-30, D-31, D-33, D-34.
#[cfg_attr(kani, kani::proof, kani::unwind(10))]
pub fn vcu2log_dynamics1_500h() {
    let layout = Layout { id: 0x500, len: 8, used: [0xFF; 8] };
    let data = Data::any::<Vcu2LogDynamics1>();
    let (brake_actual, brake_target) = (data.u8_at(4), data.u8_at(5));
    let (torque_actual, torque_target) = (data.i8_at(6), data.i8_at(7));
    let brakes = brake_actual <= 100 && brake_target <= 100;
    let torques = (-100..=100).contains(&torque_actual) && (-100..=100).contains(&torque_target);
    kani::cover!(brakes && !torques, "a torque is out of range");
    kani::cover!(!brakes && torques, "braking is out of range");
    if let Some(dynamics) = data.read::<Vcu2LogDynamics1>(&layout, brakes && torques) {
        assert!(dynamics.speed_actual.raw() == data.u8_at(0), "Speed_actual_kmh");
        assert!(dynamics.speed_target.raw() == data.u8_at(1), "Speed_target_kmh");
        assert!(dynamics.steer_actual.raw() == data.i8_at(2), "Steer_actual_deg");
        assert!(dynamics.steer_target.raw() == data.i8_at(3), "Steer_target_deg");
        assert!(dynamics.brake_actual.raw() == brake_actual, "Brake_actual_pct");
        assert!(dynamics.brake_target.raw() == brake_target, "Brake_target_pct");
        assert!(dynamics.drive_trq_actual.raw() == torque_actual, "Drive_trq_actual_pct");
        assert!(dynamics.drive_trq_target.raw() == torque_target, "Drive_trq_target_pct");
    }
    any_is_written::<Vcu2LogDynamics1>(&layout);
}

/// **501h, AI2LOG_Dynamics2.** The accelerations and the yaw rate, three numbers of 16 bits with a sign, are read as they
/// are written. None is refused.
///
/// Requirements: MSG-1 to MSG-4, D-30, D-31, D-33, D-34.
#[cfg_attr(kani, kani::proof, kani::unwind(10))]
pub fn ai2log_dynamics2_501h() {
    let layout = Layout { id: 0x501, len: 6, used: [0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0, 0] };
    let data = Data::any::<Ai2LogDynamics2>();
    kani::cover!(data.i16_at(0) == -32768, "more to the rear cannot be");
    if let Some(dynamics) = data.read::<Ai2LogDynamics2>(&layout, true) {
        assert!(dynamics.accel_longitudinal.raw() == data.i16_at(0), "Accel_longitudinal_mps2");
        assert!(dynamics.accel_lateral.raw() == data.i16_at(2), "Accel_lateral_mps2");
        assert!(dynamics.yaw_rate.raw() == data.i16_at(4), "Yaw_rate_degps");
    }
    any_is_written::<Ai2LogDynamics2>(&layout);
}

/// **502h, VCU2LOG_Status.** The lights and the states, and what the AI Computer counts, are read as they are written,
/// also the counts that go across bytes. A state without a name is refused.
///
/// Requirements: MSG-34 to MSG-40, D-19, D-30, D-31, D-33, D-34.
#[cfg_attr(kani, kani::proof, kani::unwind(10))]
pub fn vcu2log_status_502h() {
    let layout = Layout { id: 0x502, len: 5, used: [0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0, 0, 0] };
    let data = Data::any::<Vcu2LogStatus>();
    let state_assi = names::as_state(data.bits(0, 0, 3));
    let state_ebs = names::ebs_state(data.bits(0, 3, 2));
    let state_ami = names::ami_state(data.bits(0, 5, 3));
    let state_service_brake = names::service_brake(data.bits(1, 1, 2));
    let allowed =
        state_assi.is_some() && state_ebs.is_some() && state_ami.is_some() && state_service_brake.is_some();
    kani::cover!(state_assi.is_none() && state_ebs.is_some(), "a state without a name");
    if let Some(status) = data.read::<Vcu2LogStatus>(&layout, allowed) {
        assert!(Some(status.state_assi) == state_assi, "State_ASSI");
        assert!(Some(status.state_ebs) == state_ebs, "State_EBS");
        assert!(Some(status.state_ami) == state_ami, "State_AMI");
        assert!(status.state_steering == data.bit(1, 0), "State_steering");
        assert!(Some(status.state_service_brake) == state_service_brake, "State_service_brake");
        assert!(status.lap_counter.raw() == data.bits(1, 3, 4), "Lap_counter");
        let cones_actual = data.bits(1, 7, 1) | data.bits(2, 0, 7) << 1;
        assert!(i32::from(status.cones_count_actual) == cones_actual, "Cones_count_actual");
        let cones_all = data.bits(2, 7, 1) | data.u16_at(3) << 1;
        assert!(status.cones_count_all.raw() == cones_all, "Cones_count_all");
    }
    any_is_written::<Vcu2LogStatus>(&layout);
}

theorems![vcu2log_dynamics1_500h, ai2log_dynamics2_501h, vcu2log_status_502h];
