//! The judge beside the decoder: which state the VCU is in, and what blocks the arrows out of it, for the formats that show it over time.

use std::hash::{DefaultHasher, Hash, Hasher};

use adsdv_oracle::candump::{Dropped, Record};
use adsdv_oracle::judge::JudgeOptions;
use adsdv_oracle::log::{LogJudge, LogOptions};
use adsdv_oracle::why::Stay;
use adsdv_spec::Edition;

use crate::arrows::now;

/// Follows the VCU.
#[derive(Debug)]
pub(crate) struct Watch {
    judge: LogJudge,
    /// What was shown last, in a number.
    shown: u64,
}

impl Watch {
    pub(crate) fn new(edition: &'static Edition, interface: &str) -> Self {
        let judge = JudgeOptions::of(edition);
        let options = LogOptions { judge, interface: Some(interface.to_owned()), ..LogOptions::default() };
        Self { judge: LogJudge::new(options), shown: 0 }
    }

    /// Sees a frame. Tells whether what is shown now is something else.
    pub(crate) fn frame(&mut self, record: &Record<'_>) -> bool {
        self.judge.frame(record);
        let mut hasher = DefaultHasher::new();
        if let Some(stay) = self.stay() {
            (stay.state, stay.since_ns).hash(&mut hasher);
            for arrow in &stay.arrows {
                (arrow.more, arrow.blocked.len(), now(arrow).map(|blocked| blocked.since_ns))
                    .hash(&mut hasher);
            }
        }
        let shown = hasher.finish();
        std::mem::replace(&mut self.shown, shown) != shown
    }

    pub(crate) fn dropped(&mut self, dropped: &Dropped<'_>) {
        self.judge.dropped(dropped);
    }

    /// When the last frame came, by the time that the judge gives it: times of the stay count so.
    #[cfg(feature = "mcap")]
    pub(crate) fn judged_at(&self) -> i64 {
        self.judge.judged_at().unwrap_or_default()
    }

    /// The state that lasts, with its arrows; `None` while none is known.
    pub(crate) fn stay(&self) -> Option<&Stay> {
        self.judge.waits().map(|(_, stay)| stay)
    }
}
