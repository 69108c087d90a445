//! The critical faults of `VCU2AI_Status` (520h), their flags, and `SHUTDOWN_CAUSE`.
//!
//! A fault's number is its `SHUTDOWN_CAUSE` (section 2.2). Where several arise in one step, the cause is the
//! lowest number.

use core::fmt;

use crate::messages::content::field_of;
use crate::messages::{FieldDef, Message, ShutdownCause, Vcu2AiStatus};

macro_rules! faults {
    ($($(#[$doc:meta])* $fault:ident => $flag:ident, $signal:literal, $opens:literal;)*) => {
        /// A critical fault that 520h reports.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[cfg_attr(kani, derive(kani::Arbitrary))]
        #[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
        #[repr(u8)]
        pub enum Fault { $($(#[$doc])* $fault = ShutdownCause::$fault as u8,)* }

        impl Fault {
            /// Every fault, by number.
            pub const ALL: &'static [Self] = &[$(Self::$fault),*];

            /// The `SHUTDOWN_CAUSE` that names this fault.
            pub const fn cause(self) -> ShutdownCause {
                match self { $(Self::$fault => ShutdownCause::$fault,)* }
            }

            /// The signal of 520h that is this fault's flag.
            pub const fn flag(self) -> &'static str {
                match self { $(Self::$fault => $signal,)* }
            }

            /// The requirement behind its flag and its number, as `REQUIREMENTS.md` has it: that of the signal.
            pub const fn requirement(self) -> &'static str {
                const FIELDS: &[FieldDef] = <Vcu2AiStatus as Message>::FIELDS;
                let flag = match self { $(Self::$fault => const { field_of(FIELDS, stringify!($flag)) },)* };
                flag.requirements[0]
            }

            /// The fault that a cause names; `None` for no shutdown.
            pub const fn of_cause(cause: ShutdownCause) -> Option<Self> {
                match cause { $(ShutdownCause::$fault => Some(Self::$fault),)* ShutdownCause::NoShutdown => None }
            }
        }

        impl Faults {
            /// The faults that open the shutdown circuit by themselves (section 3.5).
            pub const OPENING: Self = Self(0 $(| ($opens as u16) << Fault::$fault as u8)*);

            /// The faults whose flags a `VCU2AI_Status` message shows.
            pub const fn shown_by(status: &Vcu2AiStatus) -> Self {
                Self(0 $(| (status.$flag as u16) << Fault::$fault as u8)*)
            }

            /// Sets the fault flags of a `VCU2AI_Status` message to these faults.
            pub const fn show(self, status: &mut Vcu2AiStatus) {
                $(status.$flag = self.has(Fault::$fault);)*
            }
        }
    };
}

//= MSG-54 to MSG-63, MSG-84
faults! {
    /// The AI Computer requests an emergency stop.
    AiComputerRequest => ai_estop_request, "AI_ESTOP_REQUEST", false;
    /// The shutdown circuit or HVIL is open.
    HvilOpenFault => hvil_open_fault, "HVIL_OPEN_FAULT", true;
    /// The shutdown circuit or HVIL has a short circuit.
    HvilShortFault => hvil_short_fault, "HVIL_SHORT_FAULT", true;
    /// The Emergency Braking System is faulty.
    EbsFault => ebs_fault, "EBS_FAULT", true;
    /// The off-board battery charger is faulty.
    OffboardChargerFault => offboard_charger_fault, "OFFBOARD_CHARGER_FAULT", true;
    /// The AI Computer does not answer the handshake.
    AiCommsFault => ai_comms_lost, "AI_COMMS_LOST", false;
    /// NEUTRAL was requested while the vehicle was moving.
    AutonomousBrakingFault => autonomous_braking_fault, "AUTONOMOUS_BRAKING_FAULT", false;
    /// FINISHED was declared while the vehicle was moving.
    MissionStatusFault => mission_status_fault, "MISSION_STATUS_FAULT", false;
    /// A master switch is on while the battery is being charged.
    ChargeProcedureFault => charge_procedure_fault, "CHARGE_PROCEDURE_FAULT", true;
    /// The battery management system reports a critical fault.
    BmsFault => bms_fault, "BMS_FAULT", true;
    /// Torque and hydraulic braking were requested at once; since version 4.0.
    BrakePlausibilityFault => brake_plausibility_fault, "BRAKE_PLAUSIBILITY_FAULT", false;
}

crate::named::impl_find!(Fault by flag, "AI_COMMS_LOST");
crate::named::impl_named!(Fault, "the flag of a fault, such as \"AI_COMMS_LOST\"");

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.flag())
    }
}

/// A set of [`Fault`]s.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Faults(u16);

crate::set::impl_set!(Faults(u16) of Fault, "fault");

impl Faults {
    /// The cause that is reported where all of these arise in one step: the lowest number.
    pub const fn cause(self) -> ShutdownCause {
        //= D-16
        let mut i = 0;
        while i < Fault::ALL.len() {
            if self.has(Fault::ALL[i]) {
                return Fault::ALL[i].cause();
            }
            i += 1;
        }
        ShutdownCause::NoShutdown
    }

    /// Those whose number is at most that of another.
    #[must_use]
    pub const fn up_to(self, last: Fault) -> Self {
        Self((self.0 as u32 & ((2 << last as u8) - 1)) as u16)
    }

    /// The fault that a cause names, as a set.
    #[inline]
    pub const fn of_cause(cause: ShutdownCause) -> Self {
        // The number of a fault is that of its cause; that of no shutdown is no fault's.
        Self((1 << cause as u8) & Self::ALL.0)
    }
}
