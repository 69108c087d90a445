//! Frames that were lost between the bus and the log: nobody is blamed for what they may have said.
//!
//! Each loss makes the judge start anew. Where one follows the other, as on a machine that cannot keep up, the judge reports them as
//! one.

use crate::judge::finding::{Finding, Party, Rule};
use crate::judge::time::{MS, milliseconds};

/// Losses without end are reported as often as this, so that they are reported at all.
const LONGEST_NS: i64 = 10_000 * MS;

/// Losses that have not been reported yet.
#[derive(Debug, Default)]
pub(crate) struct Loss {
    /// Lost before the next frame, which has not come yet.
    coming: u64,
    running: Option<LossRun>,
}

/// Losses that followed one another: when the last frame before the first of them came, and the first after the last; how many
/// frames were lost, and in how many pieces.
#[derive(Clone, Copy, Debug)]
struct LossRun {
    since: i64,
    until: i64,
    count: u64,
    pieces: u64,
}

impl Loss {
    /// So many frames were lost before the next one. It is not known when: what is judged until that one comes is judged
    /// as if this were a silence.
    pub(crate) fn comes(&mut self, count: u64) {
        self.coming = self.coming.saturating_add(count);
    }

    pub(crate) const fn is_coming(&self) -> bool {
        self.coming > 0
    }

    /// The next frame comes at `until`, the last one came at `since`. Tells whether this loss follows no other.
    pub(crate) fn ends(&mut self, since: i64, until: i64) -> bool {
        let coming = std::mem::take(&mut self.coming);
        let running = self.running.unwrap_or(LossRun { since, until, count: 0, pieces: 0 });
        let (count, pieces) = (running.count.saturating_add(coming), running.pieces + 1);
        self.running = Some(LossRun { until, count, pieces, ..running });
        pieces == 1
    }

    /// When it is certain that no further loss belongs to those before.
    pub(crate) fn due_at(&self, pause: i64) -> i64 {
        self.running.map_or(i64::MAX, |loss| (loss.until + pause).min(loss.since + LONGEST_NS))
    }

    pub(crate) fn tell(&mut self) -> Option<Finding> {
        let LossRun { since, until, count, pieces } = self.running.take()?;
        let frames = if count == 1 { "1 frame".to_owned() } else { format!("{count} frames") };
        let (place, anew) = if pieces == 1 {
            ("here".to_owned(), "from here on")
        } else {
            let seconds = milliseconds(until - since) / 1e3;
            (format!("from here on, {pieces} times in {seconds:.3} s"), "each time")
        };
        let seen = format!(
            "{frames} lost {place}, because nobody took what came in time; judged as a new recording {anew}"
        );
        Some(Finding::warning(Party::Log, "2", Rule::Gap, since).seen(seen))
    }
}
