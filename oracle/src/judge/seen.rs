//! What the judge knows from moment to moment, for who follows rules of his own beside it.

use adsdv_spec::Knowledge;
use adsdv_spec::messages::AnyMessage;

use super::Judge;
use super::slots::slot_of;

/// What was known from a moment on that came between two frames.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Seen {
    pub(crate) t: i64,
    pub(crate) known: Knowledge,
    /// The slots whose last frame was recent enough, one bit each.
    fresh: u32,
}

impl Seen {
    /// Whether what the message with this identifier said last counted.
    pub(crate) const fn is_fresh(&self, id: u16) -> bool {
        let slot = slot_of(id);
        slot < AnyMessage::IDS.len() && self.fresh >> slot & 1 == 1
    }
}

// One bit for each.
const _: () = assert!(super::slots::COUNT <= 32);

impl Judge {
    /// From now on, what becomes known or unknown between frames is kept until it is [taken](Self::take_seen).
    pub(crate) fn keep_seen(&mut self) {
        self.seen = Some(Vec::new());
    }

    /// What became known or unknown between frames since this was last asked, in order.
    pub(crate) fn take_seen(&mut self) -> Vec<Seen> {
        self.seen.as_mut().map(std::mem::take).unwrap_or_default()
    }

    /// What the last frame with this identifier said, and how long it was; `None` if it is too old to count.
    pub(crate) fn shown(&self, id: u16) -> Option<([u8; 8], usize)> {
        let slot = self.slots.get(slot_of(id)).filter(|slot| slot.fresh && slot.def.is_some())?;
        Some((slot.word.to_le_bytes(), usize::from(slot.len)))
    }

    /// Something may have become known or unknown.
    pub(super) fn note_seen(&mut self) {
        let Some(seen) = &mut self.seen else { return };
        let bits = self.slots.iter().zip(0..).filter(|(slot, _)| slot.fresh);
        let fresh = bits.fold(0, |fresh, (_, bit)| fresh | 1 << bit);
        seen.push(Seen { t: self.now, known: self.known, fresh });
    }
}
