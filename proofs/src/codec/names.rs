//! The numbers that stand for a name, as the text of sections 2.1 and 2.2 has them. No other number has a meaning.

use adsdv_spec::messages::{
    AmiState, AsState, DirectionRequest, EbsStage, EbsState, MissionStatus, OpState, ServiceBrake,
    ShutdownCause, SmAs, SmSys, StatusBrk, SysActionState, TsState,
};

/// `AS_STATE` of 520h and `State_ASSI` of 502h.
pub(super) const fn as_state(number: i32) -> Option<AsState> {
    match number {
        1 => Some(AsState::Off),
        2 => Some(AsState::Ready),
        3 => Some(AsState::Driving),
        4 => Some(AsState::EmergencyBrake),
        5 => Some(AsState::Finished),
        _ => None,
    }
}

/// `AS_STATE` of 520h in 2026, where AS_INIT is read as AS_OFF.
pub(super) const fn as_state_of_2026(number: i32) -> Option<AsState> {
    match number {
        0 => Some(AsState::Off),
        _ => as_state(number),
    }
}

/// `OP_STATE` of 520h in 2026. Its fault is all of its four bits, as in the two below.
pub(super) const fn op_state(number: i32) -> Option<OpState> {
    match number {
        0 => Some(OpState::Init),
        1 => Some(OpState::Pushbar),
        2 => Some(OpState::Auto),
        3 => Some(OpState::Charge),
        15 => Some(OpState::Fault),
        _ => None,
    }
}

/// `TS_STATE` of 520h in 2026.
pub(super) const fn ts_state(number: i32) -> Option<TsState> {
    match number {
        0 => Some(TsState::Init),
        1 => Some(TsState::Precharge),
        2 => Some(TsState::Activate),
        3 => Some(TsState::Running),
        4 => Some(TsState::Shutdown),
        15 => Some(TsState::Fault),
        _ => None,
    }
}

/// `EBS_STATE` of 520h in 2026, which numbers the EBS otherwise than 502h and 524h.
pub(super) const fn ebs_stage(number: i32) -> Option<EbsStage> {
    match number {
        0 => Some(EbsStage::Init),
        1 => Some(EbsStage::Charging),
        2 => Some(EbsStage::Armed),
        3 => Some(EbsStage::Triggered),
        4 => Some(EbsStage::Discharging),
        15 => Some(EbsStage::Fault),
        _ => None,
    }
}

/// `AMI_STATE` of 520h and `State_AMI` of 502h.
pub(super) const fn ami_state(number: i32) -> Option<AmiState> {
    match number {
        0 => Some(AmiState::NotSelected),
        1 => Some(AmiState::Acceleration),
        2 => Some(AmiState::Skidpad),
        3 => Some(AmiState::Autocross),
        4 => Some(AmiState::TrackDrive),
        5 => Some(AmiState::StaticInspectionA),
        6 => Some(AmiState::StaticInspectionB),
        7 => Some(AmiState::AutonomousDemo),
        _ => None,
    }
}

/// `State_EBS` of 502h, and `STATUS_EBS` of 524h in version 4.0.
pub(super) const fn ebs_state(number: i32) -> Option<EbsState> {
    match number {
        1 => Some(EbsState::Unavailable),
        2 => Some(EbsState::Armed),
        3 => Some(EbsState::Triggered),
        _ => None,
    }
}

/// `State_service_brake` of 502h.
pub(super) const fn service_brake(number: i32) -> Option<ServiceBrake> {
    match number {
        1 => Some(ServiceBrake::Disengaged),
        2 => Some(ServiceBrake::Engaged),
        3 => Some(ServiceBrake::Available),
        _ => None,
    }
}

/// `SHUTDOWN_CAUSE` of 520h.
pub(super) const fn shutdown_cause(number: i32) -> Option<ShutdownCause> {
    match number {
        0 => Some(ShutdownCause::NoShutdown),
        1 => Some(ShutdownCause::AiComputerRequest),
        2 => Some(ShutdownCause::HvilOpenFault),
        3 => Some(ShutdownCause::HvilShortFault),
        4 => Some(ShutdownCause::EbsFault),
        5 => Some(ShutdownCause::OffboardChargerFault),
        6 => Some(ShutdownCause::AiCommsFault),
        7 => Some(ShutdownCause::AutonomousBrakingFault),
        8 => Some(ShutdownCause::MissionStatusFault),
        9 => Some(ShutdownCause::ChargeProcedureFault),
        10 => Some(ShutdownCause::BmsFault),
        _ => None,
    }
}

/// `SHUTDOWN_CAUSE` of 520h in version 4.0, which has one more.
pub(super) const fn shutdown_cause_of_4_0(number: i32) -> Option<ShutdownCause> {
    match number {
        11 => Some(ShutdownCause::BrakePlausibilityFault),
        _ => shutdown_cause(number),
    }
}

/// `SM_SYS` of 120h.
pub(super) const fn sm_sys(number: i32) -> Option<SmSys> {
    match number {
        0 => Some(SmSys::InitialActions),
        1 => Some(SmSys::PowerOnSelfTest),
        2 => Some(SmSys::Aux),
        3 => Some(SmSys::PowertrainEnable),
        4 => Some(SmSys::DriveAutonomous),
        5 => Some(SmSys::DriveManual),
        6 => Some(SmSys::Charge),
        7 => Some(SmSys::Shutdown),
        8 => Some(SmSys::ShutdownOff),
        9 => Some(SmSys::PushbarMode),
        _ => None,
    }
}

/// `SM_AS` of 120h.
pub(super) const fn sm_as(number: i32) -> Option<SmAs> {
    match number {
        1 => Some(SmAs::Off),
        2 => Some(SmAs::Ready),
        3 => Some(SmAs::Driving),
        4 => Some(SmAs::EmergencyBrake),
        5 => Some(SmAs::Finished),
        6 => Some(SmAs::R2d),
        _ => None,
    }
}

/// `SYS_ACTION_STATE` of 120h.
pub(super) const fn sys_action_state(number: i32) -> Option<SysActionState> {
    match number {
        0 => Some(SysActionState::Initialise),
        1 => Some(SysActionState::Charge),
        2 => Some(SysActionState::DriveAuto),
        3 => Some(SysActionState::DriveMan),
        4 => Some(SysActionState::Shutdown),
        _ => None,
    }
}

/// `STATUS_BRK` of 524h.
pub(super) const fn status_brk(number: i32) -> Option<StatusBrk> {
    match number {
        0 => Some(StatusBrk::Initialising),
        1 => Some(StatusBrk::Ready),
        2 => Some(StatusBrk::ShuttingDown),
        3 => Some(StatusBrk::ShutdownComplete),
        4 => Some(StatusBrk::Fault),
        _ => None,
    }
}

/// `MISSION_STATUS` of 510h.
pub(super) const fn mission_status(number: i32) -> Option<MissionStatus> {
    match number {
        0 => Some(MissionStatus::NotSelected),
        1 => Some(MissionStatus::Selected),
        2 => Some(MissionStatus::Running),
        3 => Some(MissionStatus::Finished),
        _ => None,
    }
}

/// `DIRECTION_REQUEST` of 510h. The CAN database also has 2, for REVERSE; the text does not.
pub(super) const fn direction_request(number: i32) -> Option<DirectionRequest> {
    match number {
        0 => Some(DirectionRequest::Neutral),
        1 => Some(DirectionRequest::Forward),
        _ => None,
    }
}
