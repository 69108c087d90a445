//! The last frame of every message: what it said, when, and how often it comes.

use adsdv_spec::Atoms;
use adsdv_spec::messages::{MESSAGES, MessageDef};

/// How many messages there are.
pub(super) const COUNT: usize = MESSAGES.len();

/// Shorter and longer periods than these are not believed.
const PERIOD_NS: std::ops::RangeInclusive<i64> = 1_000_000..=250_000_000;

/// So many intervals in a row that are all longer, or all shorter, than usual are a change of rate and no jitter.
const RUN: u8 = 10;

/// One message on the bus.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slot {
    pub(super) def: &'static MessageDef,
    /// The data of the last frame, as far as a word holds it.
    pub(super) word: u64,
    pub(super) len: u8,
    /// When the last frame came; `None` before the first.
    pub(super) last: Option<i64>,
    /// The usual time between two frames: a running median.
    pub(super) period: i64,
    /// How many intervals in a row were longer than that; negative: shorter.
    run: i8,
    /// For how many intervals the rate has not changed.
    steady: u8,
    /// Whether the last frame is recent enough to speak for now.
    pub(super) fresh: bool,
    /// The signals whose last value was not allowed, one bit each.
    pub(super) bad: u32,
    /// What the last frame said of the atoms.
    pub(super) atoms: Option<Atoms>,
    pub(super) length_noted: bool,
    pub(super) too_short: bool,
}

impl Slot {
    const fn new(def: &'static MessageDef) -> Self {
        Self {
            def,
            word: 0,
            len: 0,
            last: None,
            period: 0,
            run: 0,
            steady: 0,
            fresh: false,
            bad: 0,
            atoms: None,
            length_noted: false,
            too_short: false,
        }
    }

    pub(super) fn all() -> [Self; COUNT] {
        let mut slots = [Self::new(MESSAGES[0]); COUNT];
        for (slot, def) in slots.iter_mut().zip(MESSAGES) {
            slot.def = def;
        }
        slots
    }

    /// When the last frame will be too old to speak for now: a frame that is missing may have said something else.
    pub(super) fn stale_at(&self) -> i64 {
        self.last.map_or(i64::MAX, |last| last + self.period + self.period * 5 / 8)
    }

    /// A frame came.
    pub(super) fn seen(&mut self, now: i64) {
        if let Some(last) = self.last {
            let interval = now - last;
            self.period = match self.period {
                0 => interval,
                period => self.median(period, interval),
            }
            .clamp(*PERIOD_NS.start(), *PERIOD_NS.end());
        }
        self.last = Some(now);
    }

    /// The running median after another interval: it ignores outliers, moves ever less under jitter, and follows a
    /// change of rate.
    fn median(&mut self, period: i64, interval: i64) -> i64 {
        let side = if interval > period { 1 } else { -1 };
        self.run = if self.run.signum() == side { self.run.saturating_add(side) } else { side };
        self.steady = if self.run.unsigned_abs() < RUN { self.steady.saturating_add(1) } else { 0 };
        period + i64::from(side) * (period >> (4 + self.steady / 16).min(8))
    }
}

/// Which slot an identifier has.
#[derive(Debug)]
pub(super) struct SlotOf(Box<[u8; 0x800]>);

impl SlotOf {
    pub(super) fn new() -> Self {
        let mut slots = Box::new([u8::MAX; 0x800]);
        for (index, def) in (0..).zip(MESSAGES) {
            if let Some(slot) = slots.get_mut(usize::from(def.id)) {
                *slot = index;
            }
        }
        Self(slots)
    }

    pub(super) fn get(&self, id: u32) -> Option<usize> {
        match self.0.get(id as usize) {
            Some(&slot) if slot != u8::MAX => Some(usize::from(slot)),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{MESSAGES, PERIOD_NS, Slot};

    /// Frames that come faster than any period that is believed are a run of short intervals that does not end.
    #[test]
    fn a_run_longer_than_can_be_counted_is_still_a_change_of_rate() {
        let mut slot = Slot::new(MESSAGES[0]);
        for frame in 0..300 {
            slot.seen(frame * 500_000);
        }
        assert_eq!((slot.run, slot.steady, slot.period), (i8::MIN, 0, *PERIOD_NS.start()));
    }
}
