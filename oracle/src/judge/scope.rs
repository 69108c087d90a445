//! Which conditions each message shows to the judge.

use adsdv_spec::messages::{
    Ai2VcuBrake, Ai2VcuDriveF, Ai2VcuDriveR, Ai2VcuStatus, Ai2VcuSteer, SteerAngle, Vcu2AiBrake,
    Vcu2AiStatus, Vcu2AiWheelSpeeds, Vcu2LogStatus,
};
use adsdv_spec::{Atom, Atoms, Edition};

use super::{
    AI_BRAKE, AI_DRIVE_F, AI_DRIVE_R, AI_STATUS, AI_STEER, BRAKE, Judge, LOG_STATUS, REMOTE, STATUS, STEER,
    WHEEL_SPEEDS,
};

/// The atoms that a message shows in all editions.
pub(super) const fn scope(slot: usize) -> Atoms {
    match slot {
        STATUS => Vcu2AiStatus::SCOPE.with(Atom::GoOn),
        LOG_STATUS => Vcu2LogStatus::SCOPE,
        STEER => SteerAngle::SCOPE,
        WHEEL_SPEEDS => Vcu2AiWheelSpeeds::SCOPE,
        // The handshake bit is no condition of any guard; it has a watch of its own.
        AI_STATUS => Ai2VcuStatus::SCOPE.without(Atom::AiHandshake),
        AI_DRIVE_F => Ai2VcuDriveF::SCOPE,
        AI_DRIVE_R => Ai2VcuDriveR::SCOPE,
        AI_STEER => Ai2VcuSteer::SCOPE,
        _ => Atoms::NONE,
    }
}

/// The atoms of the AI Computer's messages that section 3.2, item 2, is about, among others.
pub(super) const AI_SCOPE: Atoms =
    scope(AI_STATUS).union(scope(AI_DRIVE_F)).union(scope(AI_DRIVE_R)).union(scope(AI_STEER));

/// What an edition's messages show beyond that.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shown {
    /// Of the requests of 514h.
    braking: Atoms,
    /// Whether 524h shows the Emergency Braking System.
    ebs: bool,
    /// Whether 520h shows its stage.
    pub(super) stage: bool,
}

impl Shown {
    pub(super) fn new(edition: &Edition) -> Self {
        let ebs = edition.bus.message(Vcu2AiBrake::ID).and_then(|message| message.signal_of("status_ebs"));
        let stage = edition.bus.message(Vcu2AiStatus::ID).and_then(|message| message.signal_of("ebs_state"));
        let braking = Ai2VcuBrake::SCOPE.intersection(edition.scope());
        Self { braking, ebs: ebs.is_some(), stage: stage.is_some() }
    }
}

impl Judge {
    /// The atoms that a message shows. The Emergency Braking System is taken from 524h where that shows it and comes: it is
    /// there every cycle, and in 502h much more rarely. The "Go" switch is taken from the remote control as long as that comes.
    pub(super) fn scope(&self, slot: usize) -> Atoms {
        let by_brake = || self.shown.ebs && self.slots.get(BRAKE).is_some_and(|slot| slot.last.is_some());
        match slot {
            LOG_STATUS if by_brake() => Atoms::NONE,
            BRAKE if by_brake() => Vcu2LogStatus::SCOPE,
            AI_BRAKE => self.shown.braking,
            REMOTE => Atoms::of(&[Atom::GoOn, Atom::GoEdge]),
            STATUS if self.remote_is_seen() => Vcu2AiStatus::SCOPE,
            _ => scope(slot),
        }
    }
}
