//! Frames that were lost between the bus and the log: nobody is blamed for what they may have said.
//!
//! Each loss makes the judge start anew. Where one follows the other, as on a machine that cannot keep up, they are told as
//! one.

use super::finding::{Finding, Party, Rule};
use super::{Judge, MS};

/// Losses without end are told as often as this, so that they are told at all.
const LONGEST_NS: i64 = 10_000 * MS;

/// Losses that have not been told yet.
#[derive(Debug, Default)]
pub(super) struct Loss {
    /// Lost before the next frame, which has not come yet.
    coming: u64,
    running: Option<Running>,
}

/// Losses that followed one another.
#[derive(Clone, Copy, Debug)]
struct Running {
    /// When the last frame before the first of them came.
    since: i64,
    /// When the first frame after the last of them came.
    until: i64,
    /// How many frames were lost, and in how many pieces.
    count: u64,
    pieces: u64,
}

impl Judge {
    /// So many frames were lost before the next one. It is not known when: what is judged until that one comes is judged
    /// as if this were a silence.
    pub(super) fn will_be_lost(&mut self, count: u64) {
        self.loss.coming = self.loss.coming.saturating_add(count);
        self.next_event = i64::MIN;
    }

    /// The next frame comes at `until`, the last one came at `since`: what was lost in between makes everything unknown.
    pub(super) fn lose(&mut self, since: i64, until: i64) {
        let coming = std::mem::take(&mut self.loss.coming);
        if coming == 0 {
            return;
        }
        self.settle_all(self.now);
        self.forget_everything();
        let running = self.loss.running.unwrap_or(Running { since, until, count: 0, pieces: 0 });
        if running.pieces == 0 {
            self.forget_values();
        }
        let (count, pieces) = (running.count.saturating_add(coming), running.pieces + 1);
        self.loss.running = Some(Running { until, count, pieces, ..running });
        self.wake_at(self.loss_event());
    }

    /// A frame is clearly missing from what has come, of which nobody has told: others may be where it does not show.
    #[cold]
    pub(super) fn frames_get_lost(&mut self, t: i64) {
        for slot in &mut self.slots {
            slot.becomes_lossy(t);
        }
        self.next_event = i64::MIN;
    }

    /// When it is certain that no further loss belongs to those before.
    pub(super) fn loss_event(&self) -> i64 {
        self.loss.running.map_or(i64::MAX, |loss| (loss.until + self.pause).min(loss.since + LONGEST_NS))
    }

    pub(super) fn report_loss(&mut self) {
        let Some(Running { since, until, count, pieces }) = self.loss.running.take() else { return };
        let frames = if count == 1 { "1 frame".to_owned() } else { format!("{count} frames") };
        let (place, anew) = if pieces == 1 {
            ("here".to_owned(), "from here on")
        } else {
            let seconds = super::events::milliseconds(until - since) / 1e3;
            (format!("from here on, {pieces} times in {seconds:.3} s"), "each time")
        };
        let seen = format!(
            "{frames} lost {place}, because nobody took what came in time; judged as a new recording {anew}"
        );
        self.found(Finding::warning(Party::Log, "2", Rule::Gap, since).seen(seen));
    }
}
