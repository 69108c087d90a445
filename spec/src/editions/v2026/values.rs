//! The names of values that the database of 2026 has beyond those of version 4.0.

/// The states of `AS_STATE`. The vehicle shows the first until the tractive system and the EBS run; the state machine of
/// Figure 2 begins in AS_OFF, so that is what it is read as.
//= MSG-109, D-69
pub(super) const STATES: &[(i32, &str)] = &[
    (0, "AS_INIT"),
    (1, "AS_OFF"),
    (2, "AS_READY"),
    (3, "AS_DRIVING"),
    (4, "EMERGENCY_BRAKE"),
    (5, "AS_FINISHED"),
];
