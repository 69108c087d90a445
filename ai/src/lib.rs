//! The reference AI Computer: a small program that follows the document.
//!
//! ```text
//! Idle -> Selected -> Started -> Driving -> Braking -> Finished -> Neutral
//!  (AMI)        (AS_DRIVING)  (a cycle on)  (stop)  (at rest)  (AS_FINISHED)
//! ```
//!
//! Its cycle is a pure function of [what it last heard](FromVcu), of [how far it has come](Stage), and of [what is decided](Decisions)
//! by what runs it: the closed model of `adsdv-model`, which decides at any time, and the AI Computer of `adsdv-can`, which has a
//! plan and a road. It never asks for an emergency stop.
//!
//! ```
//! use adsdv_ai::{AiComputer, Decisions, FromVcu, Stage, Wanted};
//! use adsdv_spec::Edition;
//! use adsdv_spec::messages::{AmiState, MissionStatus, Vcu2AiStatus};
//!
//! let status = Vcu2AiStatus { handshake: true, ami_state: AmiState::TrackDrive, ..Vcu2AiStatus::default() };
//! let thresholds = &Edition::DEFAULT.rules.thresholds;
//! let ai = AiComputer { heard: FromVcu::default().with_message(&status.into(), thresholds), ..AiComputer::default() };
//! let ai = ai.cycle(Decisions::default());
//! assert_eq!((ai.stage, ai.handshake), (Stage::Selected, true));
//! assert_eq!(ai.messages(&Wanted::MOST).status.mission_status, MissionStatus::Selected);
//! ```

#![no_std]
#![forbid(unsafe_code)]

mod computer;
mod heard;
mod stage;

pub use computer::{AiComputer, Wanted};
pub use heard::FromVcu;
pub use stage::{Decisions, Stage};
