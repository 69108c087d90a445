//! How a value of each type is drawn: mostly as the `arbitrary` crate makes it, and often at a boundary.

use std::fmt;

use adsdv_spec::messages::{
    Ai2LogDynamics2, Ai2VcuBrake, Ai2VcuDriveF, Ai2VcuDriveR, Ai2VcuStatus, Ai2VcuSteer, AmiState,
    AnyMessage, AsState, AxleTorque, AxleTorqueRequest, BrakePressure, DirectionRequest, EbsState,
    LapCounter, MissionStatus, MotorSpeedMax, Node, ShutdownCause, SpeedKmh, SteerAngle, SteerAngleMax,
    Vcu2AiBrake, Vcu2AiDriveF, Vcu2AiDriveR, Vcu2AiStatus, Vcu2AiSteer, Vcu2AiWheelCounts, Vcu2AiWheelSpeeds,
    Vcu2LogDynamics1, Vcu2LogStatus, VcuStatus, WheelSpeed,
};
use adsdv_spec::{
    AiMessages, Atom, Atoms, Control, Fault, Faults, Handshake, Inputs, Knowledge, Observation, Readings,
    Reports, Rules, ShutdownCircuit, Truth, Vehicle,
};

use super::Source;
use crate::document::EDITION;

/// What [`any`](super::any) can draw: the types of Kani's trait of this name that harnesses use.
pub trait Arbitrary: Sized + fmt::Debug {
    /// A value.
    fn any(source: &mut Source) -> Self;
}

/// A threshold, all of which are positive and small.
const fn small(raw: i32) -> u16 {
    assert!(0 <= raw && raw <= 1250, "a threshold");
    #[expect(clippy::cast_possible_truncation, reason = "asserted to be small")]
    {
        raw.unsigned_abs() as u16
    }
}

/// The numbers at which the document's behaviour changes.
const LIMITS: [u16; 5] = {
    let Rules { timing, thresholds, .. } = EDITION.rules;
    [
        timing.ready_dwell_ms,
        timing.ebs_timer_ms,
        timing.handshake_ms,
        small(thresholds.wheel_speed.raw()),
        small(thresholds.straight.raw()),
    ]
};

/// A number of up to `bits` bits: at random, small, or beside a boundary of its type or of the document.
fn number(source: &mut Source, bits: u32) -> u64 {
    let most = u64::MAX >> (64 - bits);
    let near = |source: &mut Source, to: u64| to.wrapping_add(source.below(3)).wrapping_sub(1);
    let value = match source.below(6) {
        0 => source.arbitrary(),
        1 => source.below(100),
        2 => {
            let limit = source.one_of(&LIMITS);
            near(source, limit.into())
        }
        3 => {
            let limit = source.one_of(&LIMITS);
            let rest = limit.saturating_sub(source.timer());
            near(source, rest.into())
        }
        4 => {
            let message = source.one_of(&IDENTIFIERS);
            near(source, message.into())
        }
        _ => {
            let edge = source.one_of(&[0, most, most >> 1]);
            near(source, edge)
        }
    };
    value & most
}

/// The identifiers of the messages.
const IDENTIFIERS: [u16; AnyMessage::IDS.len()] = AnyMessage::IDS;

macro_rules! numbers {
    ($($type:ty: $bits:literal),+) => {$(
        impl Arbitrary for $type {
            #[allow(clippy::cast_possible_truncation, clippy::cast_possible_wrap, reason = "masked to its bits")]
            fn any(source: &mut Source) -> Self {
                if source.enumerates() && $bits <= 16 {
                    return source.below(1 << $bits) as Self;
                }
                number(source, $bits) as Self
            }
        }
    )+};
}

numbers!(u8: 8, i8: 8, u16: 16, i16: 16, u32: 32, i32: 32, u64: 64, i64: 64);

impl Arbitrary for bool {
    fn any(source: &mut Source) -> Self {
        source.below(2) == 1
    }
}

impl<T: Arbitrary, const N: usize> Arbitrary for [T; N] {
    fn any(source: &mut Source) -> Self {
        std::array::from_fn(|_| T::any(source))
    }
}

/// Types of which all values are listed.
macro_rules! listed {
    ($($type:ty: $all:expr),+ $(,)?) => {$(
        impl Arbitrary for $type {
            fn any(source: &mut Source) -> Self {
                let all = &$all;
                let place = source.below(all.len() as u64);
                all[usize::try_from(place).unwrap_or(0)]
            }
        }
    )+};
}

listed!(
    AsState: AsState::ALL,
    AmiState: AmiState::ALL,
    EbsState: EbsState::ALL,
    MissionStatus: MissionStatus::ALL,
    DirectionRequest: DirectionRequest::ALL,
    ShutdownCause: ShutdownCause::ALL,
    Node: [Node::Ai, Node::Vcu],
    Truth: [Truth::False, Truth::Unknown, Truth::True],
    Atom: Atom::ALL,
    Fault: Fault::ALL,
);

/// Types that the `arbitrary` crate makes well enough.
macro_rules! made {
    ($($type:ty),+ $(,)?) => {$(
        impl Arbitrary for $type {
            fn any(source: &mut Source) -> Self {
                source.arbitrary()
            }
        }
    )+};
}

made!(
    AiMessages,
    Ai2LogDynamics2,
    Ai2VcuBrake,
    Ai2VcuDriveF,
    Ai2VcuDriveR,
    Ai2VcuSteer,
    AxleTorque,
    AxleTorqueRequest,
    BrakePressure,
    Faults,
    LapCounter,
    MotorSpeedMax,
    Readings,
    SpeedKmh,
    SteerAngleMax,
    Vcu2AiBrake,
    Vcu2AiDriveF,
    Vcu2AiDriveR,
    Vcu2AiSteer,
    Vcu2AiWheelCounts,
    Vcu2LogDynamics1,
    Vcu2LogStatus,
    VcuStatus,
    Ai2VcuStatus,
);

macro_rules! quantities {
    ($($type:ty),+) => {$(
        impl Arbitrary for $type {
            fn any(source: &mut Source) -> Self {
                match source.below(2) {
                    0 => source.arbitrary(),
                    _ => Self::clamped(i16::any(source).into()),
                }
            }
        }
    )+};
}

// Those that are compared with a threshold.
quantities!(SteerAngle, WheelSpeed);

/// As many sets with hardly any atoms, and with nearly all, as sets in between.
impl Arbitrary for Atoms {
    fn any(source: &mut Source) -> Self {
        let few = |source: &mut Source| {
            let count = source.below(4);
            (0..count).fold(Self::NONE, |few, _| few.with(Atom::any(source)))
        };
        match source.below(3) {
            0 => source.arbitrary(),
            1 => few(source),
            _ => Self::ALL.difference(few(source)),
        }
    }
}

/// Half of them without a fault: of the others hardly any is without one that opens the shutdown circuit.
impl Arbitrary for Observation {
    fn any(source: &mut Source) -> Self {
        let drawn: Self = source.arbitrary();
        if source.below(2) == 0 { Self::new(drawn.atoms(), Faults::NONE) } else { drawn }
    }
}

impl Arbitrary for adsdv_network::Planes {
    fn any(source: &mut Source) -> Self {
        source.arbitrary()
    }
}

impl Arbitrary for Knowledge {
    fn any(source: &mut Source) -> Self {
        Self::exact(Atoms::any(source)).forget(Atoms::any(source))
    }
}

impl Arbitrary for AnyMessage {
    fn any(source: &mut Source) -> Self {
        let message = source.arbitrary_with(|unstructured| unstructured.arbitrary().map(Some));
        message.unwrap_or(Self::Ai2VcuStatus(Ai2VcuStatus::default()))
    }
}

/// Mostly without the states that only the database of 2026 has: no other edition could say it.
impl Arbitrary for Vcu2AiStatus {
    fn any(source: &mut Source) -> Self {
        let drawn: Self = source.arbitrary();
        if source.below(4) == 0 {
            return drawn;
        }
        let Self { op_state, ts_state, ebs_state, .. } = Self::default();
        Self { op_state, ts_state, ebs_state, ..drawn }
    }
}

impl Arbitrary for Vcu2AiWheelSpeeds {
    fn any(source: &mut Source) -> Self {
        let same = WheelSpeed::any(source);
        let alike = bool::any(source);
        let mut wheel = || if alike || bool::any(source) { same } else { WheelSpeed::any(source) };
        Self {
            fl_wheel_speed: wheel(),
            fr_wheel_speed: wheel(),
            rl_wheel_speed: wheel(),
            rr_wheel_speed: wheel(),
        }
    }
}

impl Arbitrary for Handshake {
    fn any(source: &mut Source) -> Self {
        let mut drawn =
            Self { active: bool::any(source), bit: bool::any(source), unanswered_ms: u16::any(source) };
        drawn = match source.below(8) {
            0 => drawn,
            _ if drawn.active => Self { unanswered_ms: drawn.unanswered_ms.min(handshake_ms()), ..drawn },
            _ => Self::IDLE,
        };
        source.note_timers(None, drawn.unanswered_ms);
        drawn
    }
}

const fn handshake_ms() -> u16 {
    EDITION.rules.timing.handshake_ms
}

/// Mostly a control state that keeps the invariant under the default readings: few others would.
impl Arbitrary for Control {
    fn any(source: &mut Source) -> Self {
        let mut drawn = Self {
            state: AsState::any(source),
            in_state_ms: u16::any(source),
            go_seen_low: bool::any(source),
            was_running: bool::any(source),
            was_forward: bool::any(source),
            handshake: Handshake::any(source),
            power_cycle_needed: bool::any(source),
            shutdown_cause: ShutdownCause::any(source),
        };
        if source.below(8) == 0 {
            return drawn;
        }
        let limit = EDITION.rules.timing.in_state_limit(drawn.state);
        drawn.in_state_ms = drawn.in_state_ms.min(limit);
        source.note_timers(Some(drawn.in_state_ms), drawn.handshake.unanswered_ms);
        drawn.go_seen_low &= drawn.state == AsState::Ready && drawn.in_state_ms == limit;
        if source.below(4) != 0 {
            (drawn.was_running, drawn.was_forward) = (false, false);
        }
        let braked = match drawn.state {
            AsState::EmergencyBrake => true,
            AsState::Off => drawn.power_cycle_needed,
            _ => false,
        };
        drawn.power_cycle_needed = braked;
        drawn.shutdown_cause = match (braked, drawn.shutdown_cause) {
            (false, _) => ShutdownCause::NoShutdown,
            (true, ShutdownCause::NoShutdown) => ShutdownCause::HvilOpenFault,
            (true, cause) => cause,
        };
        drawn
    }
}

/// The atoms that are on and off often enough as inputs are drawn.
const SPREAD: Atoms = Atoms::of(&[
    Atom::SdcOpen,
    Atom::AiEstop,
    Atom::MissionSelected,
    Atom::MissionRunning,
    Atom::MissionFinished,
    Atom::Moving,
    Atom::AtRest,
    Atom::EbsUnavailable,
    Atom::AiMessagesMissed,
    Atom::BmsFault,
]);

/// Of conditions that are hardly ever so by chance, half of all inputs show each: no fault, a request of zero, a vehicle
/// that is just straight.
impl Arbitrary for Inputs {
    fn any(source: &mut Source) -> Self {
        let mut drawn: Self = source.arbitrary();
        drawn.vehicle = Vehicle {
            steer_angle: SteerAngle::any(source),
            wheel_speeds: Vcu2AiWheelSpeeds::any(source),
            ..drawn.vehicle
        };
        if source.below(4) != 0 {
            drawn.sdc = ShutdownCircuit::default();
            drawn.reports = Reports::default();
            drawn.ai.status.estop_request &= bool::any(source);
            // One fault by itself, as the cause of a step.
            if source.below(4) == 0 {
                drawn.show_fault(Fault::any(source), true);
            }
        }
        // Half of them are a vehicle of which nearly everything is as it should be.
        let kind = source.below(4);
        let mostly = if kind % 2 == 1 { 2 } else { 16 };
        for atom in Observation::SCOPE.difference(SPREAD).iter() {
            match source.below(mostly) {
                0 => drawn.show(atom, false, &EDITION.rules.thresholds),
                1 => {}
                _ => drawn.show(atom, true, &EDITION.rules.thresholds),
            }
        }
        // What is shown is to the left; half of them have it to the right.
        if kind >= 2 {
            drawn.vehicle.steer_angle = SteerAngle::clamped(-drawn.vehicle.steer_angle.raw());
        }
        drawn
    }
}
