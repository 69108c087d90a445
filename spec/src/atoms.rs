//! The atoms: every condition that a guard of Figure 2 can name, and sets of them.
//!
//! An atom is a yes/no question about the inputs or the control state ("is the AS master switch on?").
//! A set of atoms is a bit set, so that a guard is a few AND and compare instructions.

use core::fmt;

macro_rules! atoms {
    ($($(#[$doc:meta])* $variant:ident = $id:literal, $yes:literal, $no:literal;)*) => {
        /// One condition that guards of Figure 2 are built from. They stand in the order in which the figure's labels name
        /// them.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[cfg_attr(kani, derive(kani::Arbitrary))]
        #[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
        #[repr(u8)]
        pub enum Atom { $($(#[$doc])* $variant,)* }

        impl Atom {
            /// Every atom, in the order of the bits.
            pub const ALL: &'static [Self] = &[$(Self::$variant),*];

            /// The stable identifier, such as `asms`.
            pub const fn id(self) -> &'static str {
                match self { $(Self::$variant => $id,)* }
            }

            /// The condition in the words of Figure 2, as it reads when it is true or false. What stands in braces is a
            /// number of an edition's [`Rules`](crate::Rules).
            pub(crate) const fn words(self, value: bool) -> &'static str {
                match (self, value) { $((Self::$variant, true) => $yes, (Self::$variant, false) => $no,)* }
            }
        }
    };
}

atoms! {
    /// The shutdown circuit is open, for any of the causes of section 3.5.
    SdcOpen = "sdc-open", "SDC open", "SDC closed";
    /// `EMERGENCY_BRAKE` has lasted for the time of the EBS timer (section 3.9).
    EbsTimerComplete = "ebs-timer-complete", "EBS timer complete", "EBS timer running";
    /// The Autonomous System Master Switch is on (sections 3.1, 3.4, 3.6, 3.7, 3.9).
    Asms = "asms", "AS master switch ON", "AS master switch OFF";
    /// The Tractive System Master Switch is on (section 3.1).
    Tsms = "tsms", "TS master switch ON", "TS master switch OFF";
    /// A mission is selected on the Autonomous Mission Indicator (section 3.1).
    AmiSelected = "ami-selected", "AMI mission selected", "AMI mission not selected";
    /// `MISSION_STATUS` is SELECTED (Figure 2).
    MissionSelected = "mission-selected", "MISSION_STATUS == SELECTED", "MISSION_STATUS != SELECTED";
    /// `MISSION_STATUS` is RUNNING (section 4).
    MissionRunning = "mission-running", "MISSION_STATUS == RUNNING", "MISSION_STATUS != RUNNING";
    /// `MISSION_STATUS` is FINISHED (sections 3.3, 3.7).
    MissionFinished = "mission-finished", "MISSION_STATUS == FINISHED", "MISSION_STATUS != FINISHED";
    /// `MISSION_STATUS` was RUNNING at the last step and is FINISHED now (section 4, item 2).
    MissionFinishedEdge = "mission-finished-edge",
        "MISSION_STATUS RUNNING -> FINISHED", "no change of MISSION_STATUS RUNNING -> FINISHED";
    /// The Emergency Braking System is in its ARMED state (section 3.1).
    EbsArmed = "ebs-armed", "EBS_state == ARMED", "EBS_state != ARMED";
    /// The Emergency Braking System is in its UNAVAILABLE state (Figure 2 of version 4.0).
    EbsUnavailable = "ebs-unavailable", "EBS status == UNAVAILABLE", "EBS status != UNAVAILABLE";
    /// `AS_READY` has lasted for the minimum dwell (section 3.2, item 1).
    DwellElapsed = "dwell-elapsed", "{ready_dwell} timer elapsed", "{ready_dwell} timer running";
    /// The front axle torque request is zero (section 3.2, item 2a).
    FrontTorqueZero = "front-torque-zero",
        "front axle torque request == 0", "front axle torque request != 0";
    /// The rear axle torque request is zero (section 3.2, item 2a).
    RearTorqueZero = "rear-torque-zero", "rear axle torque request == 0", "rear axle torque request != 0";
    /// The hydraulic brake requests of both axles are zero (section 4 of version 4.0).
    BrakeRequestZero = "brake-request-zero", "brake requests == 0", "a brake request != 0";
    /// The requested steer angle is zero (section 3.2, item 2b).
    SteerRequestZero = "steer-request-zero", "steer angle request == 0", "steer angle request != 0";
    /// The actual steer angle is within the limit for straight wheels (section 3.2, item 2).
    SteerStraight = "steer-straight", "abs(steer angle) < {straight}", "abs(steer angle) >= {straight}";
    /// `DIRECTION_REQUEST` is NEUTRAL (sections 3.2, 3.7).
    DirectionNeutral = "direction-neutral", "DIRECTION_REQUEST == NEUTRAL", "DIRECTION_REQUEST != NEUTRAL";
    /// `DIRECTION_REQUEST` was FORWARD at the last step and is NEUTRAL now (section 4, item 1).
    DirectionNeutralEdge = "direction-neutral-edge",
        "DIRECTION_REQUEST FORWARD -> NEUTRAL", "no change of DIRECTION_REQUEST FORWARD -> NEUTRAL";
    /// The remote "Go" switch is on (sections 3.2, 3.7).
    GoOn = "go-on", "\"Go\" signal ON", "\"Go\" signal OFF";
    /// The rising edge of the "Go" switch that section 3.2, item 3, accepts.
    GoEdge = "go-edge", "\"Go\" signal OFF -> ON", "no accepted \"Go\" signal OFF -> ON";
    /// At least one wheel turns faster than the limit (sections 3.7, 4).
    Moving = "moving", "a wheel speed > {wheel_speed}", "no wheel speed > {wheel_speed}";
    /// Every wheel turns slower than the limit (section 3.3); exactly at the limit is neither moving nor at rest.
    AtRest = "at-rest", "all wheel speeds < {wheel_speed}", "a wheel speed >= {wheel_speed}";
    /// The AI Computer's HANDSHAKE bit is 1 (section 2.4).
    AiHandshake = "ai-handshake", "AI HANDSHAKE == 1", "AI HANDSHAKE == 0";
    /// One of the AI Computer's messages has been missing for too long (section 2.4 of version 4.0).
    AiMessagesMissed = "ai-messages-missed", "an AI message missed for {missed}", "no AI message missed for {missed}";
    /// An edge of the VCU's HANDSHAKE bit has stayed unanswered for too long, or a message that is watched is missing
    /// (section 2.4).
    AiCommsLost = "ai-comms-lost", "AI_COMMS_LOST", "AI comms present";
    /// `ESTOP_REQUEST` of the AI Computer is set (section 2.1).
    AiEstop = "ai-estop", "ESTOP_REQUEST == 1", "ESTOP_REQUEST == 0";
    /// The battery management system reports a critical fault (Figure 2 of version 4.0).
    BmsFault = "bms-fault", "BMS_FAULT == TRUE", "BMS_FAULT == FALSE";
    /// The vehicle must be power-cycled before it can drive again (section 3.9).
    PowerCycleNeeded = "power-cycle-needed", "power cycle needed", "no power cycle needed";
}

crate::named::impl_find!(Atom by id, "asms");
crate::named::impl_named!(Atom, "the id of an atom, such as \"asms\"");

impl fmt::Display for Atom {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.id())
    }
}

/// A set of [`Atom`]s, one bit for each.
///
/// ```
/// use adsdv_spec::{Atom, Atoms};
/// let seen = Atoms::NONE.with(Atom::Asms).with(Atom::Tsms);
/// assert!(seen.has(Atom::Asms) && !seen.has(Atom::SdcOpen));
/// assert_eq!(seen.len(), 2);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Atoms(u32);

crate::set::impl_set!(Atoms(u32) of Atom, "atom");
