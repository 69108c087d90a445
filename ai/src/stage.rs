//! How far the AI Computer has come with its mission, and what it says of that.

use adsdv_spec::messages::{AmiState, AsState, DirectionRequest, MissionStatus};

use crate::FromVcu;

/// How far the AI Computer has come with its mission, in this order.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Stage {
    /// No mission is selected.
    #[default]
    Idle,
    /// The mission selected is confirmed (RDY-7), with no request to move (DRV-5 to DRV-8).
    Selected,
    /// AS_DRIVING has come: RUNNING and FORWARD (DRV-10), but no torque yet.
    Started,
    /// It drives.
    Driving,
    /// It stops the vehicle with the service brake at the end of the mission (FIN-2).
    Braking,
    /// The vehicle has stopped: FINISHED (FIN-1, FIN-3). The brakes stay on.
    Finished,
    /// FINISHED and NEUTRAL, the brakes still on.
    Neutral,
    /// After an emergency: nothing is requested but the brakes, if any.
    Stopped,
}

/// What is decided for the AI Computer in a cycle; nothing by default.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Decisions {
    /// Where it drives: the mission is completed, or it is no longer safe to go on.
    pub stop: bool,
    /// Where it brakes: the vehicle has stopped, for good.
    pub settled: bool,
}

impl Stage {
    /// The stage after a cycle.
    pub(crate) const fn next(self, heard: FromVcu, decided: Decisions) -> Self {
        match (heard.as_state, self) {
            (AsState::Off | AsState::Ready, _) => match heard.ami {
                AmiState::NotSelected => Self::Idle,
                _ => Self::Selected,
            },
            // Somebody else has selected the mission, or the AI Computer was switched off and on again on the way.
            (AsState::Driving, Self::Idle) => Self::Braking,
            (AsState::Driving, Self::Selected) => Self::Started,
            (AsState::Driving, Self::Started | Self::Driving) if decided.stop => Self::Braking,
            (AsState::Driving, Self::Started) => Self::Driving,
            (AsState::Driving, Self::Braking) if decided.settled => Self::Finished,
            (AsState::Driving, stage) => stage,
            (AsState::Finished, _) => Self::Neutral,
            (AsState::EmergencyBrake, _) => Self::Stopped,
        }
    }

    /// What it says of the mission.
    pub const fn mission_status(self) -> MissionStatus {
        match self {
            Self::Idle | Self::Stopped => MissionStatus::NotSelected,
            Self::Selected => MissionStatus::Selected, //= RDY-7
            Self::Started | Self::Driving | Self::Braking => MissionStatus::Running,
            Self::Finished | Self::Neutral => MissionStatus::Finished, //= FIN-1, FIN-3
        }
    }

    /// The direction that it asks for.
    pub const fn direction(self) -> DirectionRequest {
        match self {
            Self::Idle | Self::Selected | Self::Neutral | Self::Stopped => DirectionRequest::Neutral,
            Self::Started | Self::Driving | Self::Braking | Self::Finished => {
                //= DRV-10
                DirectionRequest::Forward
            }
        }
    }

    /// Whether it may ask for the service brake.
    //= FIN-2
    pub const fn brakes(self) -> bool {
        matches!(self, Self::Braking | Self::Finished | Self::Neutral | Self::Stopped)
    }
}
