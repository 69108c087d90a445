//! What the judge knows from moment to moment, for who follows rules of his own beside it.

use adsdv_spec::Knowledge;
use adsdv_spec::messages::AnyMessage;

use super::sampler::places::{COUNT, slot_of};

/// What was known from a moment on that came between two frames.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Seen {
    pub(crate) t: i64,
    pub(crate) known: Knowledge,
    /// The slots whose last frame was recent enough, one bit each.
    fresh: u32,
}

impl Seen {
    /// This is known, and of these slots the last frame was recent enough.
    pub(super) fn new(t: i64, known: Knowledge, fresh: impl Iterator<Item = bool>) -> Self {
        let bits = { fresh }.zip(0..).filter(|(fresh, _)| *fresh);
        Self { t, known, fresh: bits.fold(0, |bits, (_, bit)| bits | 1 << bit) }
    }

    /// Whether what the message with this identifier said last counted.
    pub(crate) const fn is_fresh(&self, id: u16) -> bool {
        let slot = slot_of(id);
        slot < AnyMessage::IDS.len() && self.fresh >> slot & 1 == 1
    }
}

// One bit for each.
const _: () = assert!(COUNT <= 32);
