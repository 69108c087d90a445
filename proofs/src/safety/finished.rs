//! What ends AS_FINISHED.

use adsdv_spec::messages::AsState::{EmergencyBrake, Finished, Off};

use super::must_lead;
use crate::prelude::*;

/// **An open shutdown circuit in AS_FINISHED leads to EMERGENCY_BRAKE**: any of the causes of section 3.5, also with ASMS
/// off.
///
/// Requirements: FTE-1, SM-15, RTE-2 to RTE-8, D-4.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn finished_sdc() {
    let step = any_step_from(Finished);
    let open = step.words().section_3_5_sdc_open();
    kani::cover!(open && !step.inputs.asms, "ASMS is off at once");
    must_lead(&step, open, EmergencyBrake);
}

/// **ASMS off leads out of AS_FINISHED**: to AS_OFF, or to EMERGENCY_BRAKE where there is a reason for that.
///
/// Requirements: FTO-1, SM-16.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn finished_asms() {
    let step = any_step_from(Finished);
    let off = !step.inputs.asms;
    kani::cover!(off && step.has_reason_to_brake(), "there is a reason to brake");
    kani::cover!(off && !step.has_reason_to_brake(), "there is none");
    assert!(!off || step.after.state == Off || step.after.state == EmergencyBrake, "AS_FINISHED is left");
}

/// **A handshake unanswered for 50 ms in AS_FINISHED leads to EMERGENCY_BRAKE.**
///
/// Requirements: HS-9, HS-10, D-10.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn finished_comms() {
    let step = any_step_from(Finished);
    kani::cover!(step.comms_just_lost(), "the 50 ms are just full");
    must_lead(&step, step.comms_lost(), EmergencyBrake);
}

/// **ESTOP_REQUEST in AS_FINISHED leads to EMERGENCY_BRAKE.**
///
/// Requirements: D-9.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn finished_estop() {
    let step = any_step_from(Finished);
    must_lead(&step, step.inputs.ai.status.estop_request, EmergencyBrake);
}

theorems![finished_sdc, finished_asms, finished_comms, finished_estop];
