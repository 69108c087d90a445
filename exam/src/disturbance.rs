//! What goes wrong beside the AI Computer: frames of the VCU that do not come as they should, and sensors that lie.
//!
//! Whatever happens to frames of the VCU happens before they are on the bus, so that the judge sees what the AI Computer sees.

use std::fmt;

use adsdv_spec::Vehicle;
use adsdv_spec::messages::{AsState, WheelSpeed};

use crate::look::Look;
use crate::seconds::Seconds;

/// Something that goes wrong, once in a scenario.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Disturbance {
    /// It waits for this,
    pub from: Onset,
    /// then for so many milliseconds,
    pub after_ms: u64,
    /// and lasts for so many.
    pub for_ms: u64,
    /// What goes wrong.
    pub effect: Effect,
}

/// What a disturbance waits for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Onset {
    /// Nothing.
    Start,
    /// This AS state.
    State(AsState),
    /// The AI Computer brakes in AS_DRIVING, and the vehicle has moved.
    Braking,
}

impl Onset {
    /// All of them.
    pub fn all() -> Vec<Self> {
        let states = AsState::ALL.iter().copied().map(Self::State);
        [Self::Start, Self::Braking].into_iter().chain(states).collect()
    }

    /// The word for it in a scenario.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Start => "start",
            Self::State(state) => state.name(),
            Self::Braking => "braking",
        }
    }

    pub(crate) fn is_there(self, look: &Look) -> bool {
        match self {
            Self::Start => true,
            Self::State(state) => look.is(state),
            Self::Braking => look.is(AsState::Driving) && look.has_moved && look.brakes(),
        }
    }
}

/// The kinds of disturbances.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Effect {
    /// The VCU's messages of each so manieth cycle are lost.
    Loses(u64),
    /// They come so many milliseconds late.
    Delays(u64),
    /// They come together, every so many milliseconds.
    Gathers(u64),
    /// None comes.
    Silences,
    /// HANDSHAKE of 520h stays as it is.
    HoldsHandshake,
    /// The sensors show something else.
    Sensors(Sensors),
}

/// What sensors show that lie.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sensors {
    /// The front left wheel stands.
    WheelStands,
    /// The front right wheel turns with 300 rpm.
    WheelSpins,
    /// No wheel is slower than 40 rpm.
    SpeedStays,
}

impl Sensors {
    pub(crate) fn falsify(self, vehicle: &mut Vehicle) {
        let speeds = &mut vehicle.wheel_speeds;
        match self {
            Self::WheelStands => speeds.fl_wheel_speed = WheelSpeed::clamped(0),
            Self::WheelSpins => speeds.fr_wheel_speed = WheelSpeed::clamped(300),
            Self::SpeedStays => {
                for speed in [
                    &mut speeds.fl_wheel_speed,
                    &mut speeds.fr_wheel_speed,
                    &mut speeds.rl_wheel_speed,
                    &mut speeds.rr_wheel_speed,
                ] {
                    *speed = WheelSpeed::clamped(speed.raw().max(40));
                }
            }
        }
    }
}

impl Effect {
    /// The effects that have no number, each with the word for it in a scenario.
    pub(crate) const PLAIN: [(&str, Self); 5] = [
        ("silences", Self::Silences),
        ("holds-handshake", Self::HoldsHandshake),
        ("wheel-stands", Self::Sensors(Sensors::WheelStands)),
        ("wheel-spins", Self::Sensors(Sensors::WheelSpins)),
        ("speed-stays", Self::Sensors(Sensors::SpeedStays)),
    ];

    /// Those that have one.
    pub(crate) const COUNTED: [(&str, OfNumber); 3] =
        [("loses", Self::Loses), ("delays", Self::Delays), ("gathers", Self::Gathers)];
}

/// An effect with its number.
type OfNumber = fn(u64) -> Effect;

impl fmt::Display for Effect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (Self::Loses(number) | Self::Delays(number) | Self::Gathers(number)) = self else {
            let plain = Self::PLAIN.iter().find(|(_, effect)| effect == self);
            return f.write_str(plain.map_or("", |(name, _)| name));
        };
        let counted = Self::COUNTED.iter().find(|(_, of)| of(*number) == *self);
        write!(f, "{} {number}", counted.map_or("", |(name, _)| name))
    }
}

/// As a line of a scenario.
impl fmt::Display for Disturbance {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { from, after_ms, for_ms, effect } = self;
        let (after, lasts) = (Seconds(*after_ms), Seconds(*for_ms));
        write!(f, "disturb {} +{after} for {lasts} {effect}", from.name())
    }
}
