//! What was seen of one identifier.

use adsdv_spec::Edition;
use adsdv_spec::messages::{MessageDef, SignalDef};

/// Milliseconds as nanoseconds.
const MS: i64 = 1_000_000;

/// The longest frame of classic CAN, in bytes.
pub(super) const LONGEST: usize = 8;

/// So many frames tell how often a message comes.
const ENOUGH: u64 = 5;

/// What was seen of the frames of one identifier.
#[derive(Debug)]
pub(super) struct FrameStats {
    /// How many frames of each length there were.
    pub(super) lens: [u64; LONGEST + 1],
    /// When the first and the last frame came.
    first: i64,
    last: i64,
    /// The bits that were 1 in some frame.
    pub(super) bits: u64,
    /// What the last frame said.
    word: Option<(u64, usize)>,
    /// For each edition, what it says of such frames.
    pub(super) editions: Vec<EditionFit>,
}

/// What an edition says of the frames of one identifier.
#[derive(Debug)]
pub(super) struct EditionFit {
    /// The message, if it is one of the edition.
    pub(super) message: Option<&'static MessageDef>,
    /// A value that was seen and that the edition does not allow.
    pub(super) refused: Option<(&'static SignalDef, i32)>,
}

impl FrameStats {
    pub(super) fn new(editions: &[&Edition], id: u16) -> Self {
        let editions = editions
            .iter()
            .map(|edition| EditionFit { message: edition.bus.message(id), refused: None })
            .collect();
        Self { lens: [0; LONGEST + 1], first: i64::MAX, last: i64::MIN, bits: 0, word: None, editions }
    }

    pub(super) fn frame(&mut self, t_ns: i64, data: &[u8]) {
        if let Some(count) = self.lens.get_mut(data.len()) {
            *count = count.saturating_add(1);
        }
        self.first = self.first.min(t_ns);
        self.last = self.last.max(t_ns);
        let word = data.iter().take(LONGEST).rev().fold(0, |word: u64, &byte| word << 8 | u64::from(byte));
        // Most frames say what the one before said.
        if self.word.replace((word, data.len())) == Some((word, data.len())) {
            return;
        }
        self.bits |= word;
        for EditionFit { message, refused } in &mut self.editions {
            let signals = message.filter(|_| refused.is_none()).map_or(&[][..], |message| message.signals);
            *refused = refused.or_else(|| {
                signals
                    .iter()
                    .find_map(|signal| Some((signal, signal.raw(data).filter(|&raw| !signal.allows(raw))?)))
            });
        }
    }

    /// Frames are like this from now on, as far as their length goes.
    pub(super) fn is_now(&mut self, data: &[u8]) {
        self.frame(self.last, data);
        // How often they come is as it was.
        let count = self.count();
        self.lens = [0; LONGEST + 1];
        if let Some(of_this) = self.lens.get_mut(data.len()) {
            *of_this = count;
        }
    }

    /// How many frames there were.
    pub(super) fn count(&self) -> u64 {
        self.lens.iter().fold(0, |sum, count| sum.saturating_add(*count))
    }

    /// For how long such frames have come, in milliseconds.
    pub(super) fn lasted_ms(&self) -> i64 {
        if self.count() == 0 { 0 } else { self.last.saturating_sub(self.first) / MS }
    }

    /// How often they come, in milliseconds; `None` where too few have come.
    pub(super) fn cycle_ms(&self) -> Option<i64> {
        let count = self.count();
        let intervals = i64::try_from(count.saturating_sub(1)).ok()?;
        let cycle_ns = self.last.saturating_sub(self.first).checked_div(intervals)?;
        // The clock of the sender is not the recorder's: to the nearest millisecond.
        (count >= ENOUGH).then(|| cycle_ns.saturating_add(MS / 2) / MS)
    }
}
