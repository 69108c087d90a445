//! The vehicle of 2026: ADS-DV Software Interface Specification 4.0, as the CAN database of 1 June 2026 changes it.
//!
//! The documents of that year say that 4.0 stays valid until it is written anew, and point to the database. So the state
//! machine is that of 4.0; what the database changes is on the bus.

mod ai;
mod devices;
mod log;
mod requirements;
mod values;
mod vcu;

use super::{V3_0, V4_0};
use crate::bus::{Bus, bus};
use crate::edition::Edition;
use crate::messages::{
    Ai2LogDynamics2, Ai2VcuBrake, Ai2VcuDriveF, Ai2VcuDriveR, Ai2VcuStatus, Ai2VcuSteer, Vcu2AiBrake,
    Vcu2AiDriveF, Vcu2AiDriveR, Vcu2AiStatus, Vcu2AiSteer, Vcu2AiWheelCounts, Vcu2AiWheelSpeeds,
    Vcu2LogDynamics1, Vcu2LogStatus,
};
use crate::readings::Choice;

/// The layouts of the database of 2026; see [`Layout`](crate::messages::Layout).
///
/// What it does not lay out anew has the layout of [`V4_0`], or of [`V3_0`] before it.
#[derive(Clone, Copy, Debug)]
pub enum V2026 {}

impl Edition {
    /// The vehicle of 2026: version 4.0 of the document, as the CAN database of that year changes it.
    pub const V2026: Self = Self {
        version: "2026",
        document: "ADS-DV Software Interface Specification 4.0 with the CAN database of 2026",
        bus: Bus { devices: devices::DEVICES, senders: SENDERS, ..V2026::bus(Self::V4_0.bus.reserved) },
        //= D-67
        readings: Self::V4_0.readings.with(Choice::TorqueNever),
        requirements: requirements::REQUIREMENTS,
        ..Self::V4_0
    };
}

/// What keeps the AI Computer from sending what is the devices'.
const SENDERS: &[&str] = &["ID-20"]; //= ID-20

//= MSG-114, MSG-116
bus! { V2026, lengths cites ["MSG-113"]:
    Vcu2LogDynamics1 of V2026, cites ["MSG-112"];
    Ai2LogDynamics2 of V3_0;
    Vcu2LogStatus of V4_0, cites ["MSG-96"];
    Ai2VcuStatus of V4_0, cites ["MSG-98"];
    Ai2VcuDriveF of V4_0, cites ["MSG-98"];
    Ai2VcuDriveR of V4_0, cites ["MSG-98"];
    Ai2VcuSteer of V2026, cites ["MSG-98"];
    Ai2VcuBrake of V4_0, cites ["MSG-98"];
    Vcu2AiStatus of V2026, cites ["MSG-111"];
    Vcu2AiDriveF of V4_0, cites ["MSG-111"];
    Vcu2AiDriveR of V2026, cites ["MSG-111"];
    Vcu2AiSteer of V2026, cites ["MSG-111"];
    Vcu2AiBrake of V4_0, cites ["MSG-111"];
    Vcu2AiWheelSpeeds of V4_0, cites ["MSG-111"];
    Vcu2AiWheelCounts of V3_0, cites ["MSG-111"];
}
