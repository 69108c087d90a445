//! The enumerations of section 2, each once, with the document's numbers and names.

use core::fmt;

use super::{Scale, SignalValue};

/// Reads a list of enumerations: `Variant = number "NAME"`, ascending by number.
macro_rules! enumerations {
    ($(
        $(#[$meta:meta])*
        $name:ident {
            $( $(#[$variant_meta:meta])* $variant:ident = $raw:literal $text:literal, )+
        }
    )+) => {$(
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[cfg_attr(kani, derive(kani::Arbitrary))]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        #[repr(u8)]
        pub enum $name {
            $(
                $(#[$variant_meta])*
                #[cfg_attr(feature = "serde", serde(rename = $text))]
                $variant = $raw,
            )+
        }

        impl $name {
            /// Every value, by ascending number.
            pub const ALL: [Self; [$($raw),+].len()] = [$(Self::$variant),+];

            /// The document's name.
            pub const fn name(self) -> &'static str {
                match self {
                    $(Self::$variant => $text,)+
                }
            }

            /// The document's number.
            #[inline]
            pub const fn raw(self) -> i32 {
                self as i32
            }

            /// The value with this number, or `None` where the document defines none.
            #[inline]
            pub const fn from_raw(raw: i32) -> Option<Self> {
                match raw {
                    $($raw => Some(Self::$variant),)+
                    _ => None, //= D-19
                }
            }
        }

        impl SignalValue for $name {
            const SIGNED: bool = false;
            const SCALE: Scale = Scale::ONE;
            const UNIT: &'static str = "";
            const MIN: i32 = Self::VALUES[0].0;
            const MAX: i32 = Self::VALUES[Self::VALUES.len() - 1].0;
            const VALUES: &'static [(i32, &'static str)] = &[$(($raw, $text)),+];

            #[inline]
            fn from_raw(raw: i32) -> Option<Self> {
                Self::from_raw(raw)
            }

            #[inline]
            fn to_raw(self) -> i32 {
                self.raw()
            }
        }

        impl fmt::Display for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.pad(self.name())
            }
        }

        #[cfg(feature = "arbitrary")]
        impl<'a> arbitrary::Arbitrary<'a> for $name {
            fn arbitrary(u: &mut arbitrary::Unstructured<'a>) -> arbitrary::Result<Self> {
                u.choose(&Self::ALL).copied()
            }
        }

        #[cfg(feature = "proptest")]
        impl proptest::arbitrary::Arbitrary for $name {
            type Parameters = ();
            type Strategy = proptest::sample::Select<Self>;

            fn arbitrary_with((): ()) -> Self::Strategy {
                proptest::sample::select(&Self::ALL[..])
            }
        }
    )+};
}

enumerations! {
    /// The state of the Autonomous System: the boxes of Figure 2, and the lights of the Autonomous System
    /// Status Indicator (ASSI).
    ///
    /// `AS_STATE` of 520h, `State_ASSI` of 502h.
    AsState { //= MSG-35, MSG-48
        /// Off; no light.
        #[default]
        Off = 1 "AS_OFF",
        /// Ready for the "Go" signal; yellow, continuous.
        Ready = 2 "AS_READY",
        /// The AI Computer drives; yellow, flashing.
        Driving = 3 "AS_DRIVING",
        /// The EBS brakes; blue, flashing.
        EmergencyBrake = 4 "EMERGENCY_BRAKE",
        /// The mission is over and the vehicle at rest; blue, continuous.
        Finished = 5 "AS_FINISHED",
    }

    /// The state of the Emergency Braking System; `State_EBS` of 502h and, since version 4.0, `STATUS_EBS` of 524h.
    EbsState { //= MSG-36, MSG-87
        /// It cannot brake.
        #[default]
        Unavailable = 1 "UNAVAILABLE",
        /// It will brake when the shutdown circuit opens.
        Armed = 2 "ARMED",
        /// It brakes.
        Triggered = 3 "TRIGGERED",
    }

    /// The mission selected at the Autonomous Mission Indicator, the touchscreen of the vehicle.
    ///
    /// `AMI_STATE` of 520h, `State_AMI` of 502h.
    AmiState { //= MSG-37, MSG-49
        /// No mission is selected.
        #[default]
        NotSelected = 0 "NOT_SELECTED",
        /// Acceleration.
        Acceleration = 1 "ACCELERATION",
        /// Skidpad.
        Skidpad = 2 "SKIDPAD",
        /// Autocross.
        Autocross = 3 "AUTOCROSS",
        /// Track drive.
        TrackDrive = 4 "TRACK_DRIVE",
        /// Static inspection A.
        StaticInspectionA = 5 "STATIC_INSPECTION_A",
        /// Static inspection B.
        StaticInspectionB = 6 "STATIC_INSPECTION_B",
        /// Autonomous demo.
        AutonomousDemo = 7 "AUTONOMOUS_DEMO",
    }

    /// The state of the service brake, the mechanical friction brakes; `State_service_brake` of 502h.
    ServiceBrake { //= MSG-39
        /// Disengaged.
        #[default]
        Disengaged = 1 "DISENGAGED",
        /// Engaged.
        Engaged = 2 "ENGAGED",
        /// Available.
        Available = 3 "AVAILABLE",
    }

    /// The fault that made the VCU shut down; `SHUTDOWN_CAUSE` of 520h.
    ShutdownCause { //= MSG-64, MSG-85
        /// There was no shutdown.
        #[default]
        NoShutdown = 0 "NO SHUTDOWN",
        /// The AI Computer asked for it.
        AiComputerRequest = 1 "AI COMPUTER REQUEST",
        /// The shutdown circuit, or the HVIL, is open.
        HvilOpenFault = 2 "HVIL OPEN FAULT",
        /// The shutdown circuit, or the HVIL, has a short circuit.
        HvilShortFault = 3 "HVIL SHORT FAULT",
        /// The Emergency Braking System has a fault.
        EbsFault = 4 "EBS FAULT",
        /// The offboard battery charger has a fault.
        OffboardChargerFault = 5 "OFFBOARD CHARGER FAULT",
        /// The AI Computer did not answer the handshake in time.
        AiCommsFault = 6 "AI COMMS FAULT",
        /// NEUTRAL was requested while the vehicle was moving.
        AutonomousBrakingFault = 7 "AUTONOMOUS BRAKING FAULT",
        /// The mission was FINISHED while the vehicle was moving.
        MissionStatusFault = 8 "MISSION STATUS FAULT",
        /// A master switch was on while the battery was being charged.
        ChargeProcedureFault = 9 "CHARGE PROCEDURE FAULT",
        /// The battery management system has a fault.
        BmsFault = 10 "BMS FAULT",
        /// Torque and hydraulic braking were requested at once; since version 4.0.
        BrakePlausibilityFault = 11 "BRAKE PLAUSIBILITY FAULT",
    }

    /// How far the mission is, as the AI Computer reports it; `MISSION_STATUS` of 510h.
    MissionStatus { //= MSG-8
        /// No mission is selected.
        #[default]
        NotSelected = 0 "NOT SELECTED",
        /// The mission selected at the AMI is confirmed.
        Selected = 1 "SELECTED",
        /// The mission is running.
        Running = 2 "RUNNING",
        /// The mission is over.
        Finished = 3 "FINISHED",
    }

    /// The direction that the AI Computer asks for; `DIRECTION_REQUEST` of 510h.
    ///
    /// The CAN database still names a value 2, REVERSE. This version of the document does not, so it is
    /// refused.
    DirectionRequest { //= MSG-10, D-32
        /// Do not drive.
        #[default]
        Neutral = 0 "NEUTRAL",
        /// Drive forward.
        Forward = 1 "FORWARD",
    }

    /// The state of the braking controller; `STATUS_BRK` of 524h since version 4.0.
    StatusBrk { //= MSG-86
        /// It starts.
        #[default]
        Initialising = 0 "INITIALISING",
        /// It can brake.
        Ready = 1 "READY",
        /// It stops.
        ShuttingDown = 2 "SHUTTING_DOWN",
        /// It has stopped.
        ShutdownComplete = 3 "SHUTDOWN_COMPLETE",
        /// It has a fault.
        Fault = 4 "FAULT",
    }

    /// The state of the whole vehicle; `SM_SYS` of 120h since version 4.0.
    ///
    /// The document names the states and does not describe them.
    SmSys { //= MSG-89
        /// The first actions after power-on.
        #[default]
        InitialActions = 0 "INITIAL_ACTIONS",
        /// The self-test after power-on.
        PowerOnSelfTest = 1 "POWER_ON_SELF_TEST",
        /// The low voltage is on, and nothing else.
        Aux = 2 "AUX",
        /// The drive is being enabled.
        PowertrainEnable = 3 "POWERTRAIN_ENABLE",
        /// The AI Computer may drive.
        DriveAutonomous = 4 "DRIVE_AUTONOMOUS",
        /// A person drives by the joystick.
        DriveManual = 5 "DRIVE_MANUAL",
        /// The battery is being charged.
        Charge = 6 "CHARGE",
        /// The vehicle shuts down.
        Shutdown = 7 "SHUTDOWN",
        /// The vehicle has shut down.
        ShutdownOff = 8 "SHUTDOWN_OFF",
        /// A person pushes the vehicle.
        PushbarMode = 9 "PUSHBAR_MODE",
    }

    /// The state of the Autonomous System as the vehicle keeps it; `SM_AS` of 120h since version 4.0.
    ///
    /// It has one state more than [`AsState`], of which the document gives the name alone.
    SmAs { //= MSG-90
        /// Off.
        #[default]
        Off = 1 "AS_OFF",
        /// Ready for the "Go" signal.
        Ready = 2 "AS_READY",
        /// The AI Computer drives.
        Driving = 3 "AS_DRIVING",
        /// The EBS brakes.
        EmergencyBrake = 4 "AS_EMERGENCY_BRAKE",
        /// The mission is over and the vehicle at rest.
        Finished = 5 "AS_FINISHED",
        /// The name stands for "ready to drive", perhaps.
        R2d = 6 "AS_R2D",
    }

    /// What the vehicle is operated for; `OP_STATE` of 520h since the database of 2026.
    ///
    /// No document describes the states. The database gives the fault a number that its four bits do not hold, 255; it is read
    /// as what they can hold of it, 15.
    OpState { //= MSG-106, D-68
        /// After power-on.
        #[default]
        Init = 0 "OP_INIT",
        /// A person pushes the vehicle.
        Pushbar = 1 "OP_PUSHBAR",
        /// The AI Computer drives.
        Auto = 2 "OP_AUTO",
        /// The battery is being charged.
        Charge = 3 "OP_CHARGE",
        /// There is a fault.
        Fault = 15 "OP_FAULT",
    }

    /// The state of the tractive system; `TS_STATE` of 520h since the database of 2026.
    ///
    /// No document describes the states; on the number of the fault see [`OpState`].
    TsState { //= MSG-107, D-68
        /// After power-on.
        #[default]
        Init = 0 "TS_INIT",
        /// The capacitors are being charged.
        Precharge = 1 "TS_PRECHARGE",
        /// It is being switched on.
        Activate = 2 "TS_ACTIVATE",
        /// It is on.
        Running = 3 "TS_RUNNING",
        /// It is being switched off.
        Shutdown = 4 "TS_SHUTDOWN",
        /// There is a fault.
        Fault = 15 "TS_FAULT",
    }

    /// The stage of the Emergency Braking System between power-on and its use; `EBS_STATE` of 520h since the database of 2026.
    ///
    /// Its numbers are not those of [`EbsState`]. No document describes the stages; on the number of the fault see [`OpState`].
    EbsStage { //= MSG-108, D-68
        /// After power-on.
        #[default]
        Init = 0 "EBS_INIT",
        /// Its pressure is being built up.
        Charging = 1 "EBS_CHARGING",
        /// It will brake when the shutdown circuit opens.
        Armed = 2 "EBS_ARMED",
        /// It brakes.
        Triggered = 3 "EBS_TRIGGERED",
        /// Its pressure is being let off.
        Discharging = 4 "EBS_DISCHARGING",
        /// There is a fault.
        Fault = 15 "EBS_FAULT",
    }

    /// What the vehicle as a whole is doing; `SYS_ACTION_STATE` of 120h since version 4.0.
    SysActionState { //= MSG-91
        /// It initialises.
        #[default]
        Initialise = 0 "INITIALISE",
        /// The battery is being charged.
        Charge = 1 "CHARGE",
        /// Autonomous driving.
        DriveAuto = 2 "DRIVE_AUTO",
        /// Manual driving.
        DriveMan = 3 "DRIVE_MAN",
        /// It shuts down.
        Shutdown = 4 "SHUTDOWN",
    }
}
