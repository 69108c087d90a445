//! The enumerations of the interface as constants of C.
//!
//! A header has to say numbers, so they stand here a second time; what compiles holds them to the specification's.

use adsdv_spec::messages::{
    AmiState, AsState, DirectionRequest, EbsState, MissionStatus, ServiceBrake, ShutdownCause,
};

macro_rules! same {
    ($($constant:ident::$name:ident = $type:ident::$value:ident;)+) => {$(
        const _: () = assert!($constant::$name as i32 == $type::$value.raw());
    )+};
}

/// State of the Autonomous System (AS_STATE of 520h).
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum adsdv_as_state {
    /// AS_OFF
    ADSDV_AS_OFF = 1,
    /// AS_READY
    ADSDV_AS_READY = 2,
    /// AS_DRIVING
    ADSDV_AS_DRIVING = 3,
    /// EMERGENCY_BRAKE
    ADSDV_AS_EMERGENCY_BRAKE = 4,
    /// AS_FINISHED
    ADSDV_AS_FINISHED = 5,
}

same! {
    adsdv_as_state::ADSDV_AS_OFF = AsState::Off;
    adsdv_as_state::ADSDV_AS_READY = AsState::Ready;
    adsdv_as_state::ADSDV_AS_DRIVING = AsState::Driving;
    adsdv_as_state::ADSDV_AS_EMERGENCY_BRAKE = AsState::EmergencyBrake;
    adsdv_as_state::ADSDV_AS_FINISHED = AsState::Finished;
}

/// State of the Mission Indicator (AMI_STATE of 520h).
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum adsdv_ami_state {
    /// NOT_SELECTED
    ADSDV_AMI_NOT_SELECTED = 0,
    /// ACCELERATION
    ADSDV_AMI_ACCELERATION = 1,
    /// SKIDPAD
    ADSDV_AMI_SKIDPAD = 2,
    /// AUTOCROSS
    ADSDV_AMI_AUTOCROSS = 3,
    /// TRACK_DRIVE
    ADSDV_AMI_TRACK_DRIVE = 4,
    /// STATIC_INSPECTION_A
    ADSDV_AMI_STATIC_INSPECTION_A = 5,
    /// STATIC_INSPECTION_B
    ADSDV_AMI_STATIC_INSPECTION_B = 6,
    /// AUTONOMOUS_DEMO
    ADSDV_AMI_AUTONOMOUS_DEMO = 7,
}

same! {
    adsdv_ami_state::ADSDV_AMI_NOT_SELECTED = AmiState::NotSelected;
    adsdv_ami_state::ADSDV_AMI_ACCELERATION = AmiState::Acceleration;
    adsdv_ami_state::ADSDV_AMI_SKIDPAD = AmiState::Skidpad;
    adsdv_ami_state::ADSDV_AMI_AUTOCROSS = AmiState::Autocross;
    adsdv_ami_state::ADSDV_AMI_TRACK_DRIVE = AmiState::TrackDrive;
    adsdv_ami_state::ADSDV_AMI_STATIC_INSPECTION_A = AmiState::StaticInspectionA;
    adsdv_ami_state::ADSDV_AMI_STATIC_INSPECTION_B = AmiState::StaticInspectionB;
    adsdv_ami_state::ADSDV_AMI_AUTONOMOUS_DEMO = AmiState::AutonomousDemo;
}

/// State of the Emergency Braking System (State_EBS of 502h).
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum adsdv_ebs_state {
    /// UNAVAILABLE
    ADSDV_EBS_UNAVAILABLE = 1,
    /// ARMED
    ADSDV_EBS_ARMED = 2,
    /// TRIGGERED
    ADSDV_EBS_TRIGGERED = 3,
}

same! {
    adsdv_ebs_state::ADSDV_EBS_UNAVAILABLE = EbsState::Unavailable;
    adsdv_ebs_state::ADSDV_EBS_ARMED = EbsState::Armed;
    adsdv_ebs_state::ADSDV_EBS_TRIGGERED = EbsState::Triggered;
}

/// Status of the mission, as the AI Computer says it (MISSION_STATUS of 510h).
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum adsdv_mission_status {
    /// NOT SELECTED
    ADSDV_MISSION_NOT_SELECTED = 0,
    /// SELECTED
    ADSDV_MISSION_SELECTED = 1,
    /// RUNNING
    ADSDV_MISSION_RUNNING = 2,
    /// FINISHED
    ADSDV_MISSION_FINISHED = 3,
}

same! {
    adsdv_mission_status::ADSDV_MISSION_NOT_SELECTED = MissionStatus::NotSelected;
    adsdv_mission_status::ADSDV_MISSION_SELECTED = MissionStatus::Selected;
    adsdv_mission_status::ADSDV_MISSION_RUNNING = MissionStatus::Running;
    adsdv_mission_status::ADSDV_MISSION_FINISHED = MissionStatus::Finished;
}

/// Direction of driving (DIRECTION_REQUEST of 510h).
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum adsdv_direction {
    /// NEUTRAL
    ADSDV_DIRECTION_NEUTRAL = 0,
    /// FORWARD
    ADSDV_DIRECTION_FORWARD = 1,
}

same! {
    adsdv_direction::ADSDV_DIRECTION_NEUTRAL = DirectionRequest::Neutral;
    adsdv_direction::ADSDV_DIRECTION_FORWARD = DirectionRequest::Forward;
}

/// State of the service brake (State_ServiceBrake of 502h).
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum adsdv_service_brake {
    /// DISENGAGED
    ADSDV_SERVICE_BRAKE_DISENGAGED = 1,
    /// ENGAGED
    ADSDV_SERVICE_BRAKE_ENGAGED = 2,
    /// AVAILABLE
    ADSDV_SERVICE_BRAKE_AVAILABLE = 3,
}

same! {
    adsdv_service_brake::ADSDV_SERVICE_BRAKE_DISENGAGED = ServiceBrake::Disengaged;
    adsdv_service_brake::ADSDV_SERVICE_BRAKE_ENGAGED = ServiceBrake::Engaged;
    adsdv_service_brake::ADSDV_SERVICE_BRAKE_AVAILABLE = ServiceBrake::Available;
}

/// Fault that shut the system down first (SHUTDOWN_CAUSE of 520h).
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum adsdv_shutdown_cause {
    /// NO SHUTDOWN
    ADSDV_CAUSE_NO_SHUTDOWN = 0,
    /// AI COMPUTER REQUEST
    ADSDV_CAUSE_AI_COMPUTER_REQUEST = 1,
    /// HVIL OPEN FAULT
    ADSDV_CAUSE_HVIL_OPEN_FAULT = 2,
    /// HVIL SHORT FAULT
    ADSDV_CAUSE_HVIL_SHORT_FAULT = 3,
    /// EBS FAULT
    ADSDV_CAUSE_EBS_FAULT = 4,
    /// OFFBOARD CHARGER FAULT
    ADSDV_CAUSE_OFFBOARD_CHARGER_FAULT = 5,
    /// AI COMMS FAULT
    ADSDV_CAUSE_AI_COMMS_FAULT = 6,
    /// AUTONOMOUS BRAKING FAULT
    ADSDV_CAUSE_AUTONOMOUS_BRAKING_FAULT = 7,
    /// MISSION STATUS FAULT
    ADSDV_CAUSE_MISSION_STATUS_FAULT = 8,
    /// CHARGE PROCEDURE FAULT
    ADSDV_CAUSE_CHARGE_PROCEDURE_FAULT = 9,
    /// BMS FAULT
    ADSDV_CAUSE_BMS_FAULT = 10,
    /// BRAKE PLAUSIBILITY FAULT, since version 4.0
    ADSDV_CAUSE_BRAKE_PLAUSIBILITY_FAULT = 11,
}

same! {
    adsdv_shutdown_cause::ADSDV_CAUSE_NO_SHUTDOWN = ShutdownCause::NoShutdown;
    adsdv_shutdown_cause::ADSDV_CAUSE_AI_COMPUTER_REQUEST = ShutdownCause::AiComputerRequest;
    adsdv_shutdown_cause::ADSDV_CAUSE_HVIL_OPEN_FAULT = ShutdownCause::HvilOpenFault;
    adsdv_shutdown_cause::ADSDV_CAUSE_HVIL_SHORT_FAULT = ShutdownCause::HvilShortFault;
    adsdv_shutdown_cause::ADSDV_CAUSE_EBS_FAULT = ShutdownCause::EbsFault;
    adsdv_shutdown_cause::ADSDV_CAUSE_OFFBOARD_CHARGER_FAULT = ShutdownCause::OffboardChargerFault;
    adsdv_shutdown_cause::ADSDV_CAUSE_AI_COMMS_FAULT = ShutdownCause::AiCommsFault;
    adsdv_shutdown_cause::ADSDV_CAUSE_AUTONOMOUS_BRAKING_FAULT = ShutdownCause::AutonomousBrakingFault;
    adsdv_shutdown_cause::ADSDV_CAUSE_MISSION_STATUS_FAULT = ShutdownCause::MissionStatusFault;
    adsdv_shutdown_cause::ADSDV_CAUSE_CHARGE_PROCEDURE_FAULT = ShutdownCause::ChargeProcedureFault;
    adsdv_shutdown_cause::ADSDV_CAUSE_BMS_FAULT = ShutdownCause::BmsFault;
    adsdv_shutdown_cause::ADSDV_CAUSE_BRAKE_PLAUSIBILITY_FAULT = ShutdownCause::BrakePlausibilityFault;
}
