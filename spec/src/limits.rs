//! The numbers that the state machine goes by: how long things last, and where measured values begin to count.

use crate::messages::{SteerAngle, WheelSpeed};

/// How long things last, in milliseconds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Timing {
    /// `AS_READY` lasts at least this long before the exit conditions count (section 3.2, item 1).
    pub ready_dwell_ms: u16,
    /// `EMERGENCY_BRAKE` lasts at least this long (section 3.9).
    pub ebs_timer_ms: u16,
    /// An edge of the HANDSHAKE bit that is unanswered for this long is a fault (section 2.4).
    pub handshake_ms: u16,
    /// The cycle of the VCU, in which it sends what has no slower cycle of its own
    /// ([`MessageDef::cycle_ms`](crate::messages::MessageDef::cycle_ms)). Version 3.0 gives none; recordings show 10 ms.
    pub cycle_ms: u16,
}

/// Where measured values begin to count, in the raw units of their signals, and times in milliseconds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Thresholds {
    /// A wheel faster than this is moving, one slower is at rest (sections 3.3, 3.7, 4).
    pub wheel_speed: WheelSpeed,
    /// A steer angle of less than this, to either side, is straight (section 3.2, item 2).
    pub straight: SteerAngle,
    /// A message of the AI Computer that has not come for this long is missed (section 2.4 of version 4.0: ten in a row).
    /// `None` where the edition has no such rule.
    pub missed_ms: Option<u16>,
}
