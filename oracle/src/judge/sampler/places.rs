//! Where each message is kept, and which conditions it shows.

use adsdv_spec::messages::{
    Ai2VcuBrake, Ai2VcuDriveF, Ai2VcuDriveR, Ai2VcuStatus, Ai2VcuSteer, AnyMessage, SteerAngle, Vcu2AiBrake,
    Vcu2AiStatus, Vcu2AiSteer, Vcu2AiWheelSpeeds, Vcu2LogStatus, VcuStatus,
};
use adsdv_spec::{Atom, Atoms, Bus};

use crate::remote::Remote;

/// How many messages there are, in all editions.
const MESSAGES: usize = AnyMessage::IDS.len();
/// The slot of the remote control: behind those of the messages.
pub(crate) const REMOTE: usize = MESSAGES;
/// How many slots there are.
pub(crate) const COUNT: usize = MESSAGES + 1;

pub(crate) const STATUS: usize = slot_of(Vcu2AiStatus::ID);
pub(crate) const VCU_STATUS: usize = slot_of(VcuStatus::ID);
pub(crate) const LOG_STATUS: usize = slot_of(Vcu2LogStatus::ID);
pub(crate) const STEER: usize = slot_of(Vcu2AiSteer::ID);
pub(crate) const BRAKE: usize = slot_of(Vcu2AiBrake::ID);
pub(crate) const WHEEL_SPEEDS: usize = slot_of(Vcu2AiWheelSpeeds::ID);
pub(crate) const AI_STATUS: usize = slot_of(Ai2VcuStatus::ID);
pub(crate) const AI_DRIVE_F: usize = slot_of(Ai2VcuDriveF::ID);
pub(crate) const AI_DRIVE_R: usize = slot_of(Ai2VcuDriveR::ID);
pub(crate) const AI_STEER: usize = slot_of(Ai2VcuSteer::ID);
pub(crate) const AI_BRAKE: usize = slot_of(Ai2VcuBrake::ID);

/// The slot of a message.
pub(crate) const fn slot_of(id: u16) -> usize {
    let mut index = 0;
    while index < MESSAGES && AnyMessage::IDS[index] != id {
        index += 1;
    }
    index
}

/// The atoms that a message shows in all editions.
pub(crate) const fn scope(slot: usize) -> Atoms {
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

/// Which slot an identifier has.
#[derive(Debug)]
pub(super) struct SlotOf(Box<[u8; 0x800]>);

impl SlotOf {
    pub(super) fn new(bus: &Bus) -> Self {
        let mut slots = Box::new([u8::MAX; 0x800]);
        let messages = AnyMessage::IDS.into_iter().zip(0..).filter(|(id, _)| bus.message(*id).is_some());
        let remote = Remote::of(bus).map(|remote| remote.message().id).zip(u8::try_from(REMOTE).ok());
        for (id, index) in messages.chain(remote) {
            if let Some(slot) = slots.get_mut(usize::from(id)) {
                *slot = index;
            }
        }
        Self(slots)
    }

    #[inline]
    pub(super) fn get(&self, id: u32) -> Option<usize> {
        match self.0.get(id as usize) {
            Some(&slot) if slot != u8::MAX => Some(usize::from(slot)),
            _ => None,
        }
    }
}
