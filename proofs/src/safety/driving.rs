//! What stops the vehicle in AS_DRIVING, and when it has finished.

use adsdv_spec::messages::AsState::{Driving, EmergencyBrake, Finished};
use adsdv_spec::messages::DirectionRequest;

use super::{fastest_rpm, must_lead, only_if};
use crate::prelude::*;

/// **An open shutdown circuit in AS_DRIVING leads to EMERGENCY_BRAKE**: any of the causes of section 3.5, also with FINISHED
/// at rest.
///
/// Requirements: DTE-1, SM-13, RTE-2 to RTE-8, D-5.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn driving_sdc() {
    let step = any_step_from(Driving);
    let open = step.words().section_3_5_sdc_open();
    kani::cover!(open && step.words().section_3_3(), "the vehicle has finished at once");
    must_lead(&step, open, EmergencyBrake);
}

/// **ASMS off in AS_DRIVING leads to EMERGENCY_BRAKE.**
///
/// Requirements: DTE-3, SM-13, D-5.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn driving_asms() {
    let step = any_step_from(Driving);
    kani::cover!(!step.inputs.asms && step.words().section_3_3(), "the vehicle has finished at once");
    must_lead(&step, !step.inputs.asms, EmergencyBrake);
}

/// **"Go" off in AS_DRIVING leads to EMERGENCY_BRAKE.**
///
/// Requirements: DTE-2, SM-13, D-5.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn driving_go_off() {
    let step = any_step_from(Driving);
    kani::cover!(!step.inputs.go && step.words().section_3_3(), "the vehicle has finished at once");
    must_lead(&step, !step.inputs.go, EmergencyBrake);
}

/// **FINISHED while moving leads to EMERGENCY_BRAKE.** Moving is any wheel that turns faster than 10 rpm; whatever
/// MISSION_STATUS was before.
///
/// Requirements: DTE-4, IMP-1, IMP-3, IMP-4, SM-13, D-2.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn driving_finished() {
    let step = any_step_from(Driving);
    let finished = step.words().finished();
    kani::cover!(finished && fastest_rpm(&step.inputs) == 11, "the fastest wheel turns at 11 rpm");
    must_lead(&step, finished && step.words().moving(), EmergencyBrake);
}

/// **NEUTRAL while moving leads to EMERGENCY_BRAKE.** Moving is any wheel that turns faster than 10 rpm; whatever
/// DIRECTION_REQUEST was before.
///
/// Requirements: DTE-5, IMP-1, IMP-2, IMP-4, SM-13, D-2.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn driving_neutral() {
    let step = any_step_from(Driving);
    let neutral = step.inputs.ai.status.direction_request == DirectionRequest::Neutral;
    kani::cover!(neutral && fastest_rpm(&step.inputs) == 11, "the fastest wheel turns at 11 rpm");
    must_lead(&step, neutral && step.words().moving(), EmergencyBrake);
}

/// **A handshake unanswered for 50 ms in AS_DRIVING leads to EMERGENCY_BRAKE.**
///
/// Requirements: HS-9, HS-10, D-10.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn driving_comms() {
    let step = any_step_from(Driving);
    kani::cover!(step.comms_just_lost(), "the 50 ms are just full");
    must_lead(&step, step.comms_lost(), EmergencyBrake);
}

/// **ESTOP_REQUEST in AS_DRIVING leads to EMERGENCY_BRAKE.**
///
/// Requirements: D-9.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn driving_estop() {
    let step = any_step_from(Driving);
    must_lead(&step, step.inputs.ai.status.estop_request, EmergencyBrake);
}

/// **AS_FINISHED is entered only at rest**: with FINISHED, and every wheel slower than 10 rpm.
///
/// Requirements: FIN-4, SM-14, D-24.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn finished_at_rest() {
    let step = any_step_from(Driving);
    let fastest_rpm = fastest_rpm(&step.inputs);
    kani::cover!(step.after.state == Finished && fastest_rpm == 9, "the fastest wheel turns at 9 rpm");
    kani::cover!(step.after.state == Driving && fastest_rpm == 10, "the fastest wheel turns at 10 rpm");
    only_if(&step, Finished, step.words().finished() && fastest_rpm < 10);
}

/// **AS_FINISHED is entered when the vehicle has finished**: with FINISHED and every wheel slower than 10 rpm, unless there
/// is a reason to brake.
///
/// Requirements: FIN-4, SM-14, D-5.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn finished_due() {
    let step = any_step_from(Driving);
    let due = step.words().finished() && fastest_rpm(&step.inputs) < 10;
    kani::cover!(due && step.has_reason_to_brake(), "but for a reason to brake");
    must_lead(&step, due && !step.has_reason_to_brake(), Finished);
}

theorems![
    driving_sdc,
    driving_asms,
    driving_go_off,
    driving_finished,
    driving_neutral,
    driving_comms,
    driving_estop,
    finished_at_rest,
    finished_due,
];
