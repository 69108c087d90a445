//! The last frame of a message: what it said, when, and how often it comes.

use adsdv_spec::Atoms;
use adsdv_spec::messages::{MessageDef, Node};

use crate::judge::time::{MS, SILENCE_NS};

/// Shorter and longer periods than these are not believed.
const PERIOD_NS: std::ops::RangeInclusive<i64> = 1_000_000..=250_000_000;

/// So many intervals in a row that are all longer, or all shorter, than usual are a change of rate and no jitter.
const RUN: u8 = 10;

/// Of so many intervals the shortest counts as the period, if it is shorter than the usual one: frames that are missing from
/// the first ones would make it too long.
const LEARNING: u8 = 16;

/// So many frames after a long interval tell whether one was missing in it, or only late.
const CONFIRMING: i64 = 3;

/// For so long after a frame was clearly missing, others may be missing where the recorder's jitter hides it.
const LOSSY_NS: i64 = 10_000_000_000;

/// How long an interval may be, at this period, with nothing missing in it.
const fn longest(period: i64) -> i64 {
    period + ((period * 5) >> 3)
}

/// One message on the bus.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Slot {
    /// What the edition says of the message; `None` if it has no such message, and for the remote control.
    pub(crate) def: Option<&'static MessageDef>,
    /// The data of the last frame, as far as a word holds it.
    pub(crate) word: u64,
    pub(crate) len: u8,
    /// When the last frame came; `None` before the first.
    pub(crate) last: Option<i64>,
    /// The usual time between two frames: a running median.
    pub(crate) period: i64,
    /// How many intervals in a row were longer than that; negative: shorter.
    run: i8,
    /// For how many intervals the rate has not changed.
    steady: u8,
    /// The shortest of the first intervals, and how many there were.
    shortest: i64,
    learnt: u8,
    /// How far intervals are from the period, the largest of late: the recorder's jitter.
    spread: i64,
    /// The last frame's time as the log has it.
    pub(crate) newest: i64,
    /// The time before a long interval, and how many frames have come behind it.
    suspect: Option<(i64, i64)>,
    /// Until when frames are taken to get lost.
    lossy_until: i64,
    /// Whether the last frame is recent enough to speak for now.
    pub(crate) fresh: bool,
    /// The signals whose last value was not allowed, one bit each.
    pub(crate) bad: u32,
    /// What the last frame said of the atoms.
    pub(crate) atoms: Option<Atoms>,
    pub(crate) length_noted: bool,
    pub(crate) too_short: bool,
    /// Whether no frame can be missing.
    pub(crate) complete: bool,
    /// The last time between two frames that was longer than usual.
    gap: Option<(i64, i64)>,
}

impl Slot {
    pub(super) fn new(def: Option<&'static MessageDef>, complete: bool) -> Self {
        let (shortest, newest, lossy_until) = (i64::MAX, i64::MIN, i64::MIN);
        Self { def, shortest, newest, lossy_until, complete, ..Self::default() }
    }

    /// Whether this node sends the message.
    pub(crate) fn is_from(&self, node: Node) -> bool {
        self.def.is_some_and(|def| def.sender == node)
    }

    /// The usual time between two frames; as long as only one has come, that of the edition.
    pub(crate) fn usual(&self) -> i64 {
        match (self.period, self.last, self.def) {
            (0, Some(_), Some(def)) => i64::from(def.cycle_ms) * MS,
            (period, ..) => period,
        }
    }

    /// When the last frame will be too old to speak for now: a frame that is missing may have said something else.
    ///
    /// One that is missing between two frames makes the interval twice as long, give or take what the recorder's jitter is. Where
    /// nothing is known to be missing, long intervals are taken for jitter as far as that can be; where frames do get lost, no
    /// interval counts as whole into which one more would fit.
    pub(crate) fn stale_at(&self) -> i64 {
        let Some(last) = self.last else { return i64::MAX };
        if self.complete {
            return last + SILENCE_NS;
        }
        let learning = self.learnt < LEARNING;
        let usual = if learning { self.period.min(self.shortest) } else { self.period };
        let whole = longest(usual);
        if !self.is_lossy() {
            return last + whole;
        }
        // The jitter to come may be larger than what was seen of it, most of all when little was seen.
        let sure = if learning { usual + usual / 4 } else { (usual - self.spread * 3 / 2) * 2 };
        last + sure.clamp(0, whole)
    }

    /// The last time that was longer than usual between two frames, or since the last.
    pub(crate) fn longest_gap(&self, now: i64) -> Option<(i64, i64)> {
        let last = self.last?;
        if now - last > longest(self.period) { Some((last, now)) } else { self.gap }
    }

    /// When the last time between two frames ended that was longer than usual, if that was after `since`, and one may be missing.
    pub(crate) fn gap_since(&self, since: i64) -> Option<i64> {
        self.gap.map(|(_, end)| end).filter(|&end| end > since && !self.complete)
    }

    /// How far intervals have been from the period of late: the recorder's jitter.
    pub(crate) const fn spread(&self) -> i64 {
        self.spread
    }

    /// Whether frames are taken to get lost.
    pub(crate) fn is_lossy(&self) -> bool {
        self.last.is_some_and(|last| last < self.lossy_until)
    }

    /// Frames get lost, at least for a while.
    pub(crate) fn becomes_lossy(&mut self, now: i64) {
        if !self.complete {
            self.lossy_until = now + LOSSY_NS;
        }
    }

    /// A frame came. Tells whether one before it is clearly missing.
    pub(crate) fn seen(&mut self, now: i64) -> bool {
        let mut missing = false;
        if let Some(last) = self.last {
            let interval = now - last;
            let is_long = interval > longest(self.period);
            if is_long || self.gap.is_none() {
                self.gap = Some((last, now));
            }
            if self.learnt < LEARNING {
                self.learnt += 1;
                self.shortest = self.shortest.min(interval).max(*PERIOD_NS.start());
            }
            missing = (is_long || self.suspect.is_some()) && self.was_missing(last, now);
            if !is_long {
                self.spread = (self.spread - (self.spread >> 6)).max((interval - self.period).abs());
            }
            self.period = match self.period {
                0 => interval,
                period => self.median(period, interval),
            }
            .clamp(*PERIOD_NS.start(), *PERIOD_NS.end());
        }
        self.last = Some(now);
        missing
    }

    /// Tells whether a frame was missing in a long interval, as soon as that is clear.
    ///
    /// Frames that are late, held up in a queue, are followed by shorter intervals: after some of them all are in time again. After
    /// a frame that is missing, all that follow come a period later.
    fn was_missing(&mut self, last: i64, now: i64) -> bool {
        let usual = self.period;
        if let Some((since, frames)) = self.suspect {
            let frames = frames + 1;
            self.suspect = (frames < CONFIRMING).then_some((since, frames));
            let whole = usual * (CONFIRMING + 1);
            return frames == CONFIRMING && now - since > whole + usual / 2 + self.spread / 2;
        }
        // Jitter alone does not make it that long, and a longer silence is somebody who does not send.
        let interval = now - last;
        let is_long = interval > longest(usual) + self.spread && interval < usual * 4;
        if is_long && self.learnt == LEARNING {
            self.suspect = Some((last, 0));
        }
        false
    }

    /// The running median after another interval: it ignores outliers, moves ever less under jitter, and follows a
    /// change of rate.
    fn median(&mut self, period: i64, interval: i64) -> i64 {
        let side = if interval > period { 1 } else { -1 };
        // One side is as the sign of the run, which is the upper one where there is none.
        self.run = if (self.run ^ side) >= 0 { self.run.saturating_add(side) } else { side };
        self.steady = if self.run.unsigned_abs() < RUN { self.steady.saturating_add(1) } else { 0 };
        period + i64::from(side) * (period >> (4 + self.steady / 16).min(8))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A message every 10 ms, give or take 1 ms, of which enough has been seen.
    fn usual() -> Slot {
        Slot { period: 10 * MS, spread: MS, learnt: LEARNING, last: Some(0), ..Slot::new(None, false) }
    }

    /// Neither jitter nor somebody who does not send looks like a frame that is missing.
    #[test]
    fn a_long_interval_is_suspect_within_bounds() {
        let suspect = |interval| {
            let mut slot = usual();
            assert!(!slot.was_missing(0, interval), "it has to be confirmed");
            slot.suspect.is_some()
        };
        let (most, least) = (longest(10 * MS) + MS, 40 * MS);
        assert_eq!([most, most + 1, least - 1, least].map(suspect), [false, true, true, false]);
    }

    /// The frames behind a long interval tell whether all of them are late by one period.
    #[test]
    fn a_frame_that_is_missing_delays_all_that_follow() {
        let missing = |late| {
            let mut slot = usual();
            slot.was_missing(0, 20 * MS);
            for frame in 1..CONFIRMING {
                assert!(!slot.was_missing(0, (frame + 1) * 10 * MS));
            }
            let missing = slot.was_missing(0, (CONFIRMING + 1) * 10 * MS + late);
            assert_eq!(slot.suspect, None, "it is decided");
            missing
        };
        let least = 5 * MS + MS / 2;
        assert_eq!([0, least, least + 1, 10 * MS].map(missing), [false, false, true, true]);
    }

    /// Frames that are in time never make the period longer: what is too old is found rather too early.
    #[test]
    fn what_is_in_time_makes_no_period_longer() {
        let mut slot = usual();
        let period = slot.median(10 * MS, 10 * MS);
        assert!((9 * MS..10 * MS).contains(&period), "{period}");
    }

    /// Frames that come faster than any period that is believed are a run of short intervals that does not end.
    #[test]
    fn a_run_longer_than_can_be_counted_is_still_a_change_of_rate() {
        let mut slot = Slot::new(None, false);
        for frame in 0..300 {
            slot.seen(frame * 500_000);
        }
        assert_eq!((slot.run, slot.steady, slot.period), (i8::MIN, 0, *PERIOD_NS.start()));
    }
}
