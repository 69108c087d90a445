//! When the vehicle sets off from AS_READY, and what stops it before.

use adsdv_spec::Control;
use adsdv_spec::messages::AsState::{Driving, EmergencyBrake, Off, Ready};
use adsdv_spec::messages::DirectionRequest;

use super::{must_lead, only_if};
use crate::prelude::*;

/// **AS_READY lasts at least five seconds before AS_DRIVING**, whatever the cycle: after 4999 ms the vehicle does not set
/// off; even if "Go" was remembered to have been off too early, which the invariant rules out.
///
/// Requirements: DRV-4, SM-11.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn driving_dwell() {
    let before = Control { go_seen_low: kani::any(), ..any_control_in(Ready) };
    let step = Step::of(before, kani::any(), kani::any());
    kani::cover!(
        before.go_seen_low && before.in_state_ms == 0 && step.inputs.go,
        "\"Go\" is switched at once"
    );
    kani::cover!(step.lasted_ms() == 4999, "a millisecond is missing");
    kani::cover!(step.after.state == Driving && step.lasted_ms() == 5000, "the five seconds are just full");
    only_if(&step, Driving, step.lasted_ms() >= 5000);
}

/// **The vehicle sets off only at rest.** AS_DRIVING is entered only with zero torque requests on both axles, a zero
/// steering request, wheels less than 5 degrees from straight to either side, and NEUTRAL.
///
/// Requirements: DRV-5 to DRV-9, SM-11, D-25.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn driving_requests() {
    let step = any_step_from(Ready);
    let ai = &step.inputs.ai;
    // In tenths of a degree.
    let steer_angle = step.inputs.vehicle.steer_angle.raw();
    let sets_off = step.after.state == Driving;
    kani::cover!(sets_off && steer_angle == 49, "just straight, to the left");
    kani::cover!(sets_off && steer_angle == -49, "just straight, to the right");
    assert!(!sets_off || ai.drive_f.front_axle_trq_request.raw() == 0, "no torque is requested in front");
    assert!(!sets_off || ai.drive_r.rear_axle_trq_request.raw() == 0, "no torque is requested at the rear");
    assert!(!sets_off || ai.steer.steer_request.raw() == 0, "no steering is requested");
    assert!(!sets_off || -50 < steer_angle && steer_angle < 50, "the wheels are straight");
    assert!(!sets_off || ai.status.direction_request == DirectionRequest::Neutral, "NEUTRAL is requested");
}

/// **The vehicle sets off only when "Go" comes on.** AS_DRIVING is entered only with "Go" on, at the step after one at which
/// it was seen off in AS_READY while the five seconds, the requests, the wheels and NEUTRAL were all as they must be. What
/// is seen of "Go" at any other step is forgotten by the next.
///
/// Requirements: DRV-11, DRV-12, SM-2, D-6.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn driving_go() {
    let step = any_step();
    let stays_ready = step.leads(Ready, Ready);
    let seen_low = stays_ready && step.words().section_3_2_items_1_and_2() && !step.inputs.go;
    kani::cover!(seen_low && step.lasted_ms() == 5000, "seen off as soon as it counts");
    kani::cover!(stays_ready && !step.inputs.go && step.lasted_ms() == 4999, "off, but too early");
    kani::cover!(step.leads(Ready, Driving), "the vehicle sets off");
    assert!(step.after.go_seen_low == seen_low, "\"Go\" is seen off where it counts, and only there");
    if step.leads(Ready, Driving) {
        assert!(step.before.go_seen_low && step.inputs.go, "it was off, and is on");
    }
}

/// **The vehicle sets off when it may.** At the accepted edge of "Go", with everything else as it must be, AS_READY is left
/// for AS_DRIVING, unless there is a reason to brake or ASMS is off.
///
/// Requirements: DRV-15, SM-11.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn driving_due() {
    let step = any_step_from(Ready);
    let edge = step.before.go_seen_low && step.inputs.go;
    let due = edge && step.words().section_3_2_items_1_and_2() && step.inputs.asms;
    kani::cover!(due && step.has_reason_to_brake(), "but for a reason to brake");
    must_lead(&step, due && !step.has_reason_to_brake(), Driving);
}

/// **An open shutdown circuit in AS_READY leads to EMERGENCY_BRAKE**: any of the causes of section 3.5, also with ASMS off
/// or at the edge of "Go".
///
/// Requirements: RTE-1 to RTE-8, SM-12, D-3.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn ready_sdc() {
    let step = any_step_from(Ready);
    let open = step.words().section_3_5_sdc_open();
    kani::cover!(open && !step.inputs.asms, "ASMS is off at once");
    kani::cover!(open && step.words().section_3_2(), "\"Go\" comes on at once");
    must_lead(&step, open, EmergencyBrake);
}

/// **ASMS off leads out of AS_READY**: to AS_OFF, or to EMERGENCY_BRAKE where there is a reason for that.
///
/// Requirements: RTO-1, SM-10, D-22.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn ready_asms() {
    let step = any_step_from(Ready);
    let off = !step.inputs.asms;
    kani::cover!(off && step.words().section_3_2(), "\"Go\" comes on at once");
    kani::cover!(off && step.has_reason_to_brake(), "there is a reason to brake");
    assert!(!off || step.after.state == Off || step.after.state == EmergencyBrake, "AS_READY is left");
}

/// **A handshake unanswered for 50 ms in AS_READY leads to EMERGENCY_BRAKE.**
///
/// Requirements: HS-9, HS-10, D-10.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn ready_comms() {
    let step = any_step_from(Ready);
    kani::cover!(step.comms_just_lost(), "the 50 ms are just full");
    must_lead(&step, step.comms_lost(), EmergencyBrake);
}

/// **ESTOP_REQUEST in AS_READY leads to EMERGENCY_BRAKE.**
///
/// Requirements: D-9.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn ready_estop() {
    let step = any_step_from(Ready);
    must_lead(&step, step.inputs.ai.status.estop_request, EmergencyBrake);
}

theorems![
    driving_dwell,
    driving_requests,
    driving_go,
    driving_due,
    ready_sdc,
    ready_asms,
    ready_comms,
    ready_estop,
];
