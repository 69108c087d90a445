//! ADS-DV Software Interface Specification 4.0, of 25 June 2021, with its CAN database: what it changes of version 3.0.

mod ai;
mod figure2;
mod log;
mod requirements;
mod values;

pub(super) use values::{CAUSES, MISSIONS};
mod vcu;

use super::V3_0;
use crate::bus::{Reserved, bus};
use crate::edition::{Edition, Rules};
use crate::faults::Faults;
use crate::limits::{Thresholds, Timing};
use crate::messages::{
    Ai2LogDynamics2, Ai2VcuBrake, Ai2VcuDriveF, Ai2VcuDriveR, Ai2VcuStatus, Ai2VcuSteer, Vcu2AiBrake,
    Vcu2AiDriveF, Vcu2AiDriveR, Vcu2AiStatus, Vcu2AiSteer, Vcu2AiWheelCounts, Vcu2AiWheelSpeeds,
    Vcu2LogDynamics1, Vcu2LogStatus, VcuStatus,
};
use crate::readings::{Choice, Choices, Readings};

/// The layouts of version 4.0 and its database; see [`Layout`](crate::messages::Layout).
///
/// What it does not lay out anew has the layout of [`V3_0`].
#[derive(Clone, Copy, Debug)]
pub enum V4_0 {}

impl Edition {
    /// ADS-DV Software Interface Specification 4.0.
    pub const V4_0: Self = Self {
        version: "4.0",
        document: "ADS-DV Software Interface Specification 4.0",
        rules: Rules {
            table: figure2::FIGURE_2,
            timing: Timing {
                handshake_ms: 100, //= HS-17, HS-19
                ..Self::V3_0.rules.timing
            },
            thresholds: Thresholds {
                missed_ms: Some(100), //= HS-18
                ..Self::V3_0.rules.thresholds
            },
            ..Self::V3_0.rules
        },
        faults: Faults::ALL,
        choices: Choices::ALL.difference(SETTLED),
        //= D-62
        readings: Readings::DEFAULT.with(Choice::EstopDriving),
        bus: V4_0::bus(RESERVED),
        requirements: requirements::REQUIREMENTS,
    };
}

//= MSG-103
bus! { V4_0, lengths cites ["MSG-97"]:
    VcuStatus of V4_0, cites ["MSG-95"];
    Vcu2LogDynamics1 of V4_0, cites ["MSG-95"];
    Ai2LogDynamics2 of V3_0, cites ["MSG-102"];
    Vcu2LogStatus of V4_0, cites ["MSG-96"];
    Ai2VcuStatus of V4_0, cites ["MSG-98"];
    Ai2VcuDriveF of V4_0, cites ["MSG-98"];
    Ai2VcuDriveR of V4_0, cites ["MSG-98"];
    Ai2VcuSteer of V4_0, cites ["MSG-98"];
    Ai2VcuBrake of V4_0, cites ["MSG-98"];
    Vcu2AiStatus of V4_0, cites ["MSG-95"];
    Vcu2AiDriveF of V4_0, cites ["MSG-95"];
    Vcu2AiDriveR of V4_0, cites ["MSG-95"];
    Vcu2AiSteer of V4_0, cites ["MSG-95"];
    Vcu2AiBrake of V4_0, cites ["MSG-95"];
    Vcu2AiWheelSpeeds of V4_0, cites ["MSG-95"];
    Vcu2AiWheelCounts of V3_0, cites ["MSG-95"];
}

/// The answers that are no longer possible: version 4.0 says what it means.
//= D-63, D-65
const SETTLED: Choices = Choices::of(&[Choice::FaultEdge, Choice::CommsNoArrow]);

/// The reserved identifiers.
const RESERVED: &[Reserved] = &[
    Reserved { ids: 0x000..=0x000, requirements: &["ID-1"] },
    Reserved { ids: 0x080..=0x084, requirements: &["ID-2"] },
    Reserved { ids: 0x120..=0x124, requirements: &["ID-4"] },
    Reserved { ids: 0x181..=0x184, requirements: &["ID-5"] },
    Reserved { ids: 0x284..=0x284, requirements: &["ID-7"] },
    Reserved { ids: 0x301..=0x301, requirements: &["ID-8"] },
    Reserved { ids: 0x410..=0x41F, requirements: &["ID-9"] },
    Reserved { ids: 0x450..=0x470, requirements: &["ID-10"] },
    Reserved { ids: 0x4E2..=0x4E2, requirements: &["ID-11"] },
    Reserved { ids: 0x4FD..=0x4FF, requirements: &["ID-12"] },
    Reserved { ids: 0x550..=0x550, requirements: &["ID-13"] },
    Reserved { ids: 0x581..=0x584, requirements: &["ID-14"] },
    Reserved { ids: 0x600..=0x640, requirements: &["ID-18"] },
    Reserved { ids: 0x650..=0x660, requirements: &["ID-19"] },
    Reserved { ids: 0x700..=0x705, requirements: &["ID-17"] },
];
