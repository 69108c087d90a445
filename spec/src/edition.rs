//! An edition of the interface: one version of the document, as a value.
//!
//! Another edition is another [`Edition`] value, written as its difference to the one before it, and not another program. A
//! mutant, with which test suites are measured, is an edition with one of its [`Rules`] changed.

use crate::messages::{SteerAngle, WheelSpeed};
use crate::table::{FIGURE_2, PRIORITIES, Priority, Table};

/// One edition of the interface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Edition {
    /// The document's version.
    pub version: &'static str,
    /// What the state machine follows.
    pub rules: Rules,
}

/// What the state machine follows: Figure 2, the order of its arrows, the times and the thresholds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Rules {
    /// The arrows of Figure 2.
    pub table: Table,
    /// The arrows that a reading lets overtake others.
    pub priorities: &'static [Priority],
    /// How long things last.
    pub timing: Timing,
    /// Where measured values begin to count.
    pub thresholds: Thresholds,
}

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
    /// The cycle of the reference VCU. The document gives none; recordings show 10 ms.
    pub cycle_ms: u16,
    /// The cycle of 502h, which recordings show to be slower.
    pub log_status_cycle_ms: u16,
}

/// Where measured values begin to count, in the raw units of their signals.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Thresholds {
    /// A wheel faster than this is moving, one slower is at rest (sections 3.3, 3.7, 4).
    pub wheel_speed: WheelSpeed,
    /// A steer angle of less than this, to either side, is straight (section 3.2, item 2).
    pub straight: SteerAngle,
}

impl Edition {
    /// ADS-DV Software Interface Specification 3.0.
    pub const V3_0: Self = Self {
        version: "3.0",
        rules: Rules {
            table: FIGURE_2,
            priorities: PRIORITIES,
            timing: Timing {
                ready_dwell_ms: 5000, //= DRV-4
                ebs_timer_ms: 15000,  //= ETO-1
                handshake_ms: 50,     //= HS-9
                cycle_ms: 10,
                log_status_cycle_ms: 100,
            },
            thresholds: Thresholds {
                wheel_speed: WheelSpeed::clamped(10),
                straight: SteerAngle::clamped(50),
            },
        },
    };
}

impl Edition {
    /// The edition with another Figure 2.
    #[must_use]
    pub const fn with_table(self, table: Table) -> Self {
        Self { rules: Rules { table, ..self.rules }, ..self }
    }

    /// The edition with other times, such as shorter ones, which a model explores sooner.
    #[must_use]
    pub const fn with_timing(self, timing: Timing) -> Self {
        Self { rules: Rules { timing, ..self.rules }, ..self }
    }
}

impl Default for Edition {
    fn default() -> Self {
        Self::V3_0
    }
}
