//! The names of values that version 4.0's database spells otherwise than version 3.0's.

/// The missions of `AMI_STATE`, with spaces.
pub(in crate::editions) const MISSIONS: &[(i32, &str)] = &[
    (0, "NOT SELECTED"),
    (1, "ACCELERATION"),
    (2, "SKIDPAD"),
    (3, "AUTOCROSS"),
    (4, "TRACK DRIVE"),
    (5, "STATIC INSPECTION A"),
    (6, "STATIC INSPECTION B"),
    (7, "AUTONOMOUS DEMO"),
];

/// The causes of `SHUTDOWN_CAUSE`, with underscores.
pub(in crate::editions) const CAUSES: &[(i32, &str)] = &[
    (0, "NO_SHUTDOWN"),
    (1, "AI_COMPUTER_REQUEST"),
    (2, "HVIL_OPEN_FAULT"),
    (3, "HVIL_SHORT_FAULT"),
    (4, "EBS_FAULT"),
    (5, "OFFBOARD_CHARGER_FAULT"),
    (6, "AI_COMMS_FAULT"),
    (7, "AUTONOMOUS_BRAKING_FAULT"),
    (8, "MISSION_STATUS_FAULT"),
    (9, "CHARGE_PROCEDURE_FAULT"),
    (10, "BMS_FAULT"),
    (11, "BRAKE_PLAUSIBILITY_FAULT"), //= MSG-85
];
