//! What can happen next: one change of one party.

use std::fmt;

use adsdv_spec::messages::AmiState;

/// One change. It displays in words.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ClosedAction {
    /// A cycle of the VCU ends: it takes in what it has received and sees, and sends.
    VcuCycle,
    /// The AI Computer runs its cycle on what it has heard, and sends.
    AiCycle,
    /// The next frame of the VCU arrives.
    FrameToAi,
    /// The next frame of the AI Computer arrives.
    FrameToVcu,
    /// The AI Computer sees that the mission is completed, and begins to brake.
    AiDecidesToStop,
    /// The operator does something.
    Operator(Act),
    /// The remote E-stop button is pressed, or released.
    RemoteEstop(bool),
    /// The vehicle is driven, and its wheels turn faster.
    Faster,
    /// The vehicle is braked, and its wheels turn slower.
    Slower,
    /// Cycles of all pass, with prompt answers, until something but a timer changes, or a timer has elapsed.
    TimePasses,
}

/// What the operator does.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Act {
    /// Selects a mission on the Autonomous Mission Indicator, or none.
    Mission(AmiState),
    /// Turns the Tractive System Master Switch.
    Tsms(bool),
    /// Turns the Autonomous System Master Switch.
    Asms(bool),
    /// Arms the Emergency Braking System, or not.
    EbsArmed(bool),
    /// Turns the remote "Go" switch.
    Go(bool),
}

impl fmt::Display for ClosedAction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::VcuCycle => f.write_str("VCU: cycle"),
            Self::AiCycle => f.write_str("AI Computer: cycle"),
            Self::FrameToAi => f.write_str("bus: frame arrives at the AI Computer"),
            Self::FrameToVcu => f.write_str("bus: frame arrives at the VCU"),
            Self::AiDecidesToStop => f.write_str("AI Computer: mission completed, brakes"),
            Self::Operator(act) => write!(f, "operator: {act}"),
            Self::RemoteEstop(true) => f.write_str("fault: remote E-stop button pressed"),
            Self::RemoteEstop(false) => f.write_str("fault: remote E-stop button released"),
            Self::Faster => f.write_str("vehicle: faster"),
            Self::Slower => f.write_str("vehicle: slower"),
            Self::TimePasses => f.write_str("time passes"),
        }
    }
}

/// How a switch stands.
pub(super) const fn on_off(on: bool) -> &'static str {
    if on { "on" } else { "off" }
}

impl fmt::Display for Act {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Mission(AmiState::NotSelected) => f.write_str("no mission"),
            Self::Mission(mission) => write!(f, "mission {mission}"),
            Self::Tsms(on) => write!(f, "TSMS {}", on_off(on)),
            Self::Asms(on) => write!(f, "ASMS {}", on_off(on)),
            Self::EbsArmed(true) => f.write_str("EBS armed"),
            Self::EbsArmed(false) => f.write_str("EBS unavailable"),
            Self::Go(on) => write!(f, "\"Go\" {}", on_off(on)),
        }
    }
}
