//! ADS-DV Software Interface Specification 3.0, of 27 January 2021, with its CAN database.

mod ai;
pub(super) mod figure2;
mod log;
mod requirements;
mod vcu;

use core::ops::RangeInclusive;

use crate::bus::bus;
use crate::edition::{Edition, Rules, Thresholds, Timing};
use crate::faults::{Fault, Faults};
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

bus! { V3_0:
    Vcu2LogDynamics1 of V3_0,
    Ai2LogDynamics2 of V3_0,
    Vcu2LogStatus of V3_0,
    Ai2VcuStatus of V3_0,
    Ai2VcuDriveF of V3_0,
    Ai2VcuDriveR of V3_0,
    Ai2VcuSteer of V3_0,
    Ai2VcuBrake of V3_0,
    Vcu2AiStatus of V3_0,
    Vcu2AiDriveF of V3_0,
    Vcu2AiDriveR of V3_0,
    Vcu2AiSteer of V3_0,
    Vcu2AiBrake of V3_0,
    Vcu2AiWheelSpeeds of V3_0,
    Vcu2AiWheelCounts of V3_0,
}

/// The answers to questions that later editions raise. Their defaults are how version 3.0 has it.
const LATER: Choices =
    Choices::of(&[Choice::CommsDriving, Choice::WatchAlways, Choice::TorqueNever, Choice::BmsDriving]);

/// The reserved identifiers.
const RESERVED: &[RangeInclusive<u16>] = &[
    0x000..=0x000, //= ID-1
    0x080..=0x084, //= ID-2
    0x100..=0x100, //= ID-3
    0x120..=0x124, //= ID-4
    0x181..=0x184, //= ID-5
    0x201..=0x201, //= ID-6
    0x284..=0x284, //= ID-7
    0x301..=0x301, //= ID-8
    0x410..=0x41F, //= ID-9
    0x450..=0x470, //= ID-10
    0x4E2..=0x4E2, //= ID-11
    0x4FD..=0x4FF, //= ID-12
    0x550..=0x550, //= ID-13
    0x581..=0x584, //= ID-14
    0x601..=0x601, //= ID-15
    0x604..=0x604, //= ID-16
    0x700..=0x705, //= ID-17
];
