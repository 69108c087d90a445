//! When AS_READY is entered from AS_OFF.

use adsdv_spec::Inputs;
use adsdv_spec::messages::AsState::{Off, Ready};
use adsdv_spec::messages::{AmiState, EbsState, MissionStatus, ShutdownCause};

use super::{must_lead, only_if};
use crate::prelude::*;

/// 3.1 and Figure 2: everything that the inputs have to show for AS_READY.
pub(super) fn all_for_ready(inputs: &Inputs) -> bool {
    inputs.asms
        && inputs.tsms
        && inputs.ami != AmiState::NotSelected
        && inputs.ai.status.mission_status == MissionStatus::Selected
        && inputs.ebs == EbsState::Armed
}

/// **AS_READY needs its switches.** It is entered only with ASMS and TSMS on and the EBS ARMED.
///
/// Requirements: RDY-1, RDY-2, RDY-4.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn ready_switches() {
    let step = any_step_from(Off);
    let inputs = &step.inputs;
    kani::cover!(inputs.asms && inputs.tsms && inputs.ebs != EbsState::Armed, "the EBS alone is missing");
    only_if(&step, Ready, inputs.asms && inputs.tsms && inputs.ebs == EbsState::Armed);
}

/// **AS_READY needs the AMI.** It is entered only with a mission selected on the AMI.
///
/// Requirements: RDY-3.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn ready_ami() {
    let step = any_step_from(Off);
    only_if(&step, Ready, step.inputs.ami != AmiState::NotSelected);
}

/// **AS_READY needs the AI Computer.** It is entered only with MISSION_STATUS SELECTED.
///
/// Requirements: SM-9, MSG-9, D-1.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn ready_mission_status() {
    let step = any_step_from(Off);
    only_if(&step, Ready, step.inputs.ai.status.mission_status == MissionStatus::Selected);
}

/// **AS_READY is entered as soon as it may be.** With ASMS and TSMS on, a mission selected on the AMI and SELECTED in
/// MISSION_STATUS, and the EBS ARMED, a VCU that has not been shut down enters it; also with an open shutdown circuit.
///
/// Requirements: RDY-5, SM-9, D-1, D-45.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn ready_due() {
    let step = any_step_from(Off);
    let all = all_for_ready(&step.inputs);
    let due = all && step.before.shutdown_cause == ShutdownCause::NoShutdown;
    kani::cover!(due && step.words().section_3_5_sdc_open(), "the shutdown circuit is open");
    kani::cover!(all && !due, "but for the emergency before");
    must_lead(&step, due, Ready);
}

theorems![ready_switches, ready_ami, ready_mission_status, ready_due];
