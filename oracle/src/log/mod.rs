//! From a log to a report: picks the interface, and lets the judge see every frame.
//!
//! [`judge_log`] reads a recorded log of `candump -L` to its end, [`judge_entries`] one of any format. [`LogJudge`] takes frame by frame, for a bus that is live.

mod directions;
mod error;
mod finish;
mod frames;
mod hear;
mod judge;
mod read;
mod rules;

use crate::judge::JudgeOptions;
use crate::rules::RuleFile;

pub use error::LogError;
pub use judge::LogJudge;
pub(crate) use read::judge_all;
pub use read::{Judged, LogProgress, judge_by, judge_entries, judge_log, judge_readable, judge_recognised};

/// How a log is judged.
#[derive(Clone, Debug, Default)]
pub struct LogOptions {
    /// What the judge may assume.
    pub judge: JudgeOptions,
    /// The interface to judge; `None` for the first that carries a message of the document.
    pub interface: Option<String>,
    /// Rules of the user's own. Where an edition is recognised, they are to be possible in it.
    pub rules: Option<RuleFile>,
}

/// A number with its noun, in the plural where it takes one.
fn counted(count: u64, noun: &str) -> String {
    let s = if count == 1 { "" } else { "s" };
    format!("{count} {noun}{s}")
}
