//! The sampler: what each message last said, how fresh that is, and what the recording may have lost.
//!
//! It knows how recorders jitter and lose frames, and nothing of the state machine.

pub(crate) mod content;
pub(crate) mod loss;
pub(crate) mod places;
pub(crate) mod slot;

use adsdv_spec::messages::{
    Ai2VcuBrake, AnyMessage, MessageDef, Node, Vcu2AiBrake, Vcu2AiStatus, Vcu2LogStatus,
};
use adsdv_spec::{Atom, Atoms, Bus, Edition};

use crate::remote::{Remote, Switches};
use content::FrameContent;
use places::{AI_BRAKE, BRAKE, COUNT, LOG_STATUS, REMOTE, STATUS, SlotOf, scope};
use slot::Slot;

/// The last frame of every message.
#[derive(Debug)]
pub(crate) struct Sampler {
    pub(crate) slots: [Slot; COUNT],
    slot_of: SlotOf,
    bus: Bus,
    remote: Option<Remote>,
    window: i64,
    /// What 514h shows of the conditions.
    braking: Atoms,
    /// Whether 524h shows the Emergency Braking System, and whether 520h shows its stage.
    ebs: bool,
    pub(crate) stage: bool,
}

/// A frame that came.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Came {
    pub(crate) index: usize,
    pub(crate) t: i64,
    /// When the one before came.
    pub(crate) before: Option<i64>,
    /// Whether that one still spoke for now.
    pub(crate) was_fresh: bool,
    /// When this one may be too old, if that may be sooner than was thought.
    pub(crate) stale_at: i64,
    /// Whether it says the same as the one before.
    pub(crate) same: bool,
}

/// What a frame says that does not say the same as the one before.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Says {
    /// It is too short; the first such, or another.
    TooShort { first: bool },
    /// This, with these signals wrong that were not wrong before; and whether its length is another for the first time.
    This { content: FrameContent, newly_bad: u32, other_length: bool },
    /// The remote control's switches, if it can be read.
    Remote(Option<Switches>),
}

impl Sampler {
    pub(crate) fn new(edition: &Edition, complete: bool, window: i64) -> Self {
        let shows = |id, field| edition.bus.message(id).is_some_and(|def| def.signal_of(field).is_some());
        Self {
            slots: std::array::from_fn(|index| {
                Slot::new(AnyMessage::IDS.get(index).and_then(|&id| edition.bus.message(id)), complete)
            }),
            slot_of: SlotOf::new(&edition.bus),
            bus: edition.bus,
            remote: Remote::of(&edition.bus),
            window,
            braking: Ai2VcuBrake::SCOPE.intersection(edition.scope()),
            ebs: shows(Vcu2AiBrake::ID, "status_ebs"),
            stage: shows(Vcu2AiStatus::ID, "ebs_state"),
        }
    }

    /// The slot of an identifier.
    #[inline]
    pub(crate) fn index(&self, id: u32) -> Option<usize> {
        self.slot_of.get(id)
    }

    pub(crate) fn slot(&self, index: usize) -> Option<&Slot> {
        self.slots.get(index)
    }

    /// What the edition says of the message of a slot.
    pub(crate) fn def(&self, index: usize) -> Option<&'static MessageDef> {
        self.slots.get(index)?.def
    }

    /// The identifier of the message of a slot.
    pub(crate) fn id(&self, index: usize) -> Option<u16> {
        if index == REMOTE {
            return self.remote.map(|remote| remote.message().id);
        }
        Some(self.def(index)?.id)
    }

    /// Whether what the message said last speaks for now.
    pub(crate) fn is_fresh(&self, index: usize) -> bool {
        self.slots.get(index).is_some_and(|slot| slot.fresh)
    }

    /// When its last frame came.
    pub(crate) fn last(&self, index: usize) -> Option<i64> {
        self.slots.get(index)?.last
    }

    /// Whether any message of this side came.
    pub(crate) fn heard(&self, node: Node) -> bool {
        self.slots.iter().any(|slot| slot.is_from(node) && slot.last.is_some())
    }

    /// A frame came; the log's own time of it is `t_ns`. What one says that is older than the last of its identifier is not so
    /// any more: then there is nothing to tell.
    #[inline]
    pub(crate) fn frame(&mut self, index: usize, t_ns: i64, t: i64, data: &[u8]) -> Option<Came> {
        let slot = self.slots.get_mut(index)?;
        if t_ns < slot.newest {
            return None;
        }
        slot.newest = t_ns;
        let (word, len) = load(data);
        let (before, was_fresh) = (slot.last, slot.fresh);
        let same = slot.fresh && slot.word == word && slot.len == len;
        // The AI Computer's program may well leave cycles out; the VCU keeps its own.
        let missing = slot.seen(t) && slot.is_from(Node::Vcu) && !slot.complete;
        (slot.word, slot.len) = (word, len);
        let mut stale_at = if same && !slot.is_lossy() { i64::MAX } else { slot.stale_at() };
        if missing {
            // The recorder says nothing of a frame that is clearly missing: others may be where it does not show.
            self.slots.iter_mut().for_each(|slot| slot.becomes_lossy(t));
            stale_at = i64::MIN;
        }
        Some(Came { index, t, before, was_fresh, stale_at, same })
    }

    /// Reads the last frame of a message, which says something else than the one before.
    pub(crate) fn read(&mut self, index: usize) -> Option<Says> {
        let slot = self.slots.get_mut(index)?;
        let (data, len) = (slot.word.to_le_bytes(), slot.len);
        if index == REMOTE {
            let shown = self.remote.and_then(|remote| remote.read(data.get(..usize::from(len))?));
            slot.fresh = shown.is_some();
            return Some(Says::Remote(shown));
        }
        let def = slot.def?;
        slot.fresh = usize::from(len) >= def.bytes_needed();
        let was_too_short = std::mem::replace(&mut slot.too_short, !slot.fresh);
        if !slot.fresh {
            return Some(Says::TooShort { first: !was_too_short });
        }
        let other_length = len != def.len && !std::mem::replace(&mut slot.length_noted, true);
        let content = FrameContent::of(&self.bus, def, data)?;
        let newly_bad = content.bad & !std::mem::replace(&mut slot.bad, content.bad);
        Some(Says::This { content, newly_bad, other_length })
    }

    /// Nothing is known any more of what came.
    pub(crate) fn forget(&mut self) {
        for slot in &mut self.slots {
            (slot.fresh, slot.last, slot.newest) = (false, None, i64::MIN);
        }
    }

    /// That values were bad is not known any more, either: if they still are, the judge reports it again.
    pub(crate) fn forget_values(&mut self) {
        self.slots.iter_mut().for_each(|slot| slot.bad = 0);
    }

    /// The atoms that a message shows. The Emergency Braking System is taken from 524h where that shows it and comes: it is
    /// there every cycle, and in 502h much more rarely. The "Go" switch is taken from the remote control as long as that comes.
    pub(crate) fn scope(&self, index: usize) -> Atoms {
        let by_brake = || self.ebs && self.last(BRAKE).is_some();
        match index {
            LOG_STATUS if by_brake() => Atoms::NONE,
            BRAKE if by_brake() => Vcu2LogStatus::SCOPE,
            AI_BRAKE => self.braking,
            REMOTE => Atoms::of(&[Atom::GoOn, Atom::GoEdge]),
            STATUS if self.is_fresh(REMOTE) => Vcu2AiStatus::SCOPE,
            _ => scope(index),
        }
    }

    /// The messages that show any of these conditions and come so rarely that a window may pass between two of their frames.
    pub(crate) fn slow(&self, atoms: Atoms) -> impl Iterator<Item = (&Slot, Atoms)> {
        let slow = self.slots.iter().enumerate().filter(|(_, slot)| slot.usual() > self.window);
        slow.map(|(index, slot)| (slot, self.scope(index)))
            .filter(move |(_, scope)| !scope.intersection(atoms).is_empty())
    }

    /// How long to wait until all that decides these atoms in a window has been seen.
    pub(crate) fn wait_for(&self, atoms: Atoms) -> i64 {
        self.window + self.wait_for_slow(atoms)
    }

    /// The same behind the window: until the messages that come rarely have told, too.
    pub(crate) fn wait_for_slow(&self, atoms: Atoms) -> i64 {
        // Half a period more than is looked at: what is known of the period may change meanwhile.
        self.slow(atoms).map(|(slot, _)| slot.usual() * 5 / 2).max().unwrap_or(0)
    }

    /// The first message that is too old to speak for now, though nobody has said so yet.
    pub(crate) fn too_old(&self, t: i64) -> Option<usize> {
        self.slots.iter().position(|slot| slot.fresh && slot.stale_at() <= t)
    }

    /// When the next message will be too old.
    pub(crate) fn next(&self) -> i64 {
        self.slots.iter().filter(|slot| slot.fresh).map(Slot::stale_at).min().unwrap_or(i64::MAX)
    }
}

/// The first eight bytes as the word that signals are cut from, and the length.
#[inline]
fn load(data: &[u8]) -> (u64, u8) {
    let len = u8::try_from(data.len()).unwrap_or(u8::MAX);
    let word = match (data.first_chunk(), data.first_chunk(), data.last_chunk()) {
        (Some(bytes), ..) => u64::from_le_bytes(*bytes),
        // Two halves, which overlap.
        (_, Some(first), Some(last)) => {
            u64::from(u32::from_le_bytes(*first)) | u64::from(u32::from_le_bytes(*last)) << (8 * (len - 4))
        }
        _ => data.iter().rev().fold(0, |word, &byte| word << 8 | u64::from(byte)),
    };
    (word, len)
}
