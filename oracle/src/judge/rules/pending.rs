//! What can only be judged once the window behind it has passed, and what must not last.

use adsdv_spec::{Atom, Fault, Knowledge, Truth};

use super::rise::Rise;
use crate::judge::estimator::status::{PriorKnowledge, SeenChange};
use crate::judge::estimator::watch::Suspect;
use crate::judge::evidence::Frames;

/// A bound on what waits to be judged, for logs in which everything happens at once.
const MAX_PENDING: usize = 256;

/// Something that waits to be judged: when it happened, when it can be judged, and the last frames when it happened.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pending {
    pub(super) t: i64,
    at: i64,
    pub(super) frames: Frames,
    pub(super) what: Awaited,
}

#[derive(Clone, Copy, Debug)]
pub(super) enum Awaited {
    /// A transition was seen.
    Change(SeenChange),
    /// A fault flag was raised; what was known just before.
    Flag(Fault, PriorKnowledge),
    /// The VCU's handshake bit changed without an answer.
    Edge(Suspect),
    /// The handshake began with a 1 that the AI Computer had shown before.
    Beginning,
    /// The AI Computer did what is a fault; what was known then.
    Conduct(Fault, Knowledge),
    /// Something changed, and whether the change counts.
    Counts(Atom, Truth),
    /// A flag of 120h was raised.
    Raised(Rise),
}

/// All that waits.
#[derive(Debug, Default)]
pub(crate) struct Queue(Vec<Pending>);

impl Queue {
    /// Tells what can wait no longer, where there is far more than any bus does in a window.
    pub(super) fn wait(&mut self, t: i64, wait: i64, frames: &Frames, what: Awaited) -> Option<Pending> {
        let oldest = (self.0.len() >= MAX_PENDING).then(|| self.0.swap_remove(0));
        self.0.push(Pending { t, at: t + wait, frames: *frames, what });
        oldest
    }

    /// What can be judged by `t`.
    pub(crate) fn ready(&mut self, t: i64) -> Option<Pending> {
        let place = self.0.iter().position(|pending| pending.at <= t)?;
        Some(self.0.swap_remove(place))
    }

    /// All of it, in order.
    pub(crate) fn take(&mut self) -> Vec<Pending> {
        self.0.sort_by_key(|pending| pending.t);
        std::mem::take(&mut self.0)
    }

    /// In which state the AI Computer did something is not known any more.
    pub(super) fn forget_conduct(&mut self, but: Fault) {
        self.0.retain(|pending| !matches!(pending.what, Awaited::Conduct(fault, _) if fault != but));
    }

    pub(super) fn next(&self) -> i64 {
        self.0.iter().map(|pending| pending.at).min().unwrap_or(i64::MAX)
    }
}

/// Something that must not last: since when it does, and whether that was reported.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Persisting {
    pub(super) since: Option<i64>,
    reported: bool,
    /// Since when it was so in every frame that was recorded, if a frame may be missing in between.
    seen_since: Option<i64>,
    warned: bool,
}

impl Persisting {
    /// It is so now, or is not. Behind a gap it may not have been so in between.
    pub(super) fn is(&mut self, t: i64, so: bool, gap: bool) {
        if !so {
            *self = Self::default();
        } else if self.since.is_none() || gap && !self.reported {
            self.seen_since = self.seen_since.or(self.since);
            self.since = Some(t);
        }
    }

    /// Whether it is so is not known for a while; what was reported is not reported again behind that.
    pub(super) fn pauses(&mut self) {
        self.since = self.since.filter(|_| self.reported);
    }

    /// Since when it has been so, if that is before `late`; once only.
    pub(super) fn overdue(&mut self, late: i64) -> Option<i64> {
        let since = self.since.filter(|&since| since < late && !self.reported)?;
        self.reported = true;
        Some(since)
    }

    /// Since when it has been so in every frame that was recorded, if that is before `late`; once only, and not if it is certain.
    pub(super) fn likely_overdue(&mut self, late: i64) -> Option<i64> {
        let since = self.seen_since.filter(|&since| since < late && !self.reported && !self.warned)?;
        self.warned = true;
        Some(since)
    }
}
