//! The Autonomous System Status Indicator: the light that Figure 2 gives each state.

use core::fmt;

use crate::derives::data;
use crate::messages::AsState;

data!(
    /// What the ASSI shows.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
    #[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
    pub enum Assi {
        /// Dark.
        Off,
        /// Yellow, continuous.
        YellowContinuous,
        /// Yellow, flashing.
        YellowFlashing,
        /// Blue, flashing.
        BlueFlashing,
        /// Blue, continuous.
        BlueContinuous,
    }
);

impl Assi {
    /// The light of a state (Figure 2).
    ///
    /// ```
    /// use adsdv_spec::{AsState, Assi};
    /// assert_eq!(Assi::of(AsState::Ready), Assi::YellowContinuous);
    /// ```
    pub const fn of(state: AsState) -> Self {
        match state {
            AsState::Off => Self::Off,                     //= SM-4
            AsState::Ready => Self::YellowContinuous,      //= SM-5
            AsState::Driving => Self::YellowFlashing,      //= SM-6
            AsState::EmergencyBrake => Self::BlueFlashing, //= SM-7
            AsState::Finished => Self::BlueContinuous,     //= SM-8
        }
    }

    /// Whether it goes on and off.
    pub const fn flashes(self) -> bool {
        matches!(self, Self::YellowFlashing | Self::BlueFlashing)
    }
}

impl fmt::Display for Assi {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Off => "off",
            Self::YellowContinuous => "yellow, continuous",
            Self::YellowFlashing => "yellow, flashing",
            Self::BlueFlashing => "blue, flashing",
            Self::BlueContinuous => "blue, continuous",
        })
    }
}
