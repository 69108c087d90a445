//! ADS-DV Software Interface Specification 3.0, of 27 January 2021, with its CAN database.

mod ai;
pub(super) mod figure2;
mod log;
mod requirements;
mod vcu;

use crate::bus::{Reserved, bus};
use crate::edition::{Edition, Rules};
use crate::faults::{Fault, Faults};
use crate::limits::{Thresholds, Timing};
use crate::messages::{
    Ai2LogDynamics2, Ai2VcuBrake, Ai2VcuDriveF, Ai2VcuDriveR, Ai2VcuStatus, Ai2VcuSteer, SteerAngle,
    Vcu2AiBrake, Vcu2AiDriveF, Vcu2AiDriveR, Vcu2AiStatus, Vcu2AiSteer, Vcu2AiWheelCounts, Vcu2AiWheelSpeeds,
    Vcu2LogDynamics1, Vcu2LogStatus, WheelSpeed,
};
use crate::readings::{Choice, Choices, Readings};

/// The layouts of version 3.0 and its database; see [`Layout`](crate::messages::Layout).
#[derive(Clone, Copy, Debug)]
pub enum V3_0 {}

impl Edition {
    /// ADS-DV Software Interface Specification 3.0.
    pub const V3_0: Self = Self {
        version: "3.0",
        document: "ADS-DV Software Interface Specification 3.0",
        rules: Rules {
            table: figure2::FIGURE_2,
            priorities: figure2::PRIORITIES,
            timing: Timing {
                ready_dwell_ms: 5000, //= DRV-4
                ebs_timer_ms: 15000,  //= ETO-1
                handshake_ms: 50,     //= HS-9
                cycle_ms: 10,
            },
            thresholds: Thresholds {
                wheel_speed: WheelSpeed::clamped(10),
                straight: SteerAngle::clamped(50),
                missed_ms: None,
            },
        },
        faults: Faults::ALL.without(Fault::BrakePlausibilityFault),
        choices: Choices::ALL.difference(LATER),
        readings: Readings::DEFAULT,
        bus: V3_0::bus(RESERVED),
        requirements: requirements::REQUIREMENTS,
    };
}

bus! { V3_0, lengths cites ["D-30"]:
    Vcu2LogDynamics1 of V3_0;
    Ai2LogDynamics2 of V3_0;
    Vcu2LogStatus of V3_0;
    Ai2VcuStatus of V3_0;
    Ai2VcuDriveF of V3_0;
    Ai2VcuDriveR of V3_0;
    Ai2VcuSteer of V3_0;
    Ai2VcuBrake of V3_0;
    Vcu2AiStatus of V3_0;
    Vcu2AiDriveF of V3_0;
    Vcu2AiDriveR of V3_0;
    Vcu2AiSteer of V3_0;
    Vcu2AiBrake of V3_0;
    Vcu2AiWheelSpeeds of V3_0;
    Vcu2AiWheelCounts of V3_0;
}

/// The answers to questions that later editions raise. Their defaults are how version 3.0 has it.
const LATER: Choices =
    Choices::of(&[Choice::CommsDriving, Choice::WatchAlways, Choice::TorqueNever, Choice::BmsDriving]);

/// The reserved identifiers.
const RESERVED: &[Reserved] = &[
    Reserved { ids: 0x000..=0x000, requirements: &["ID-1"] },
    Reserved { ids: 0x080..=0x084, requirements: &["ID-2"] },
    Reserved { ids: 0x100..=0x100, requirements: &["ID-3"] },
    Reserved { ids: 0x120..=0x124, requirements: &["ID-4"] },
    Reserved { ids: 0x181..=0x184, requirements: &["ID-5"] },
    Reserved { ids: 0x201..=0x201, requirements: &["ID-6"] },
    Reserved { ids: 0x284..=0x284, requirements: &["ID-7"] },
    Reserved { ids: 0x301..=0x301, requirements: &["ID-8"] },
    Reserved { ids: 0x410..=0x41F, requirements: &["ID-9"] },
    Reserved { ids: 0x450..=0x470, requirements: &["ID-10"] },
    Reserved { ids: 0x4E2..=0x4E2, requirements: &["ID-11"] },
    Reserved { ids: 0x4FD..=0x4FF, requirements: &["ID-12"] },
    Reserved { ids: 0x550..=0x550, requirements: &["ID-13"] },
    Reserved { ids: 0x581..=0x584, requirements: &["ID-14"] },
    Reserved { ids: 0x601..=0x601, requirements: &["ID-15"] },
    Reserved { ids: 0x604..=0x604, requirements: &["ID-16"] },
    Reserved { ids: 0x700..=0x705, requirements: &["ID-17"] },
];
