//! What differs between two recordings: "it worked yesterday".
//!
//! ```text
//! log --> judge ------> Report    --+
//!           |                       +--> Recording, of each log --> Comparison
//!           +> Collector: Collected-+
//!
//! Comparison: where the paths from state to state part (path, parting)
//!             how long states lasted (lasted), what only one was found to do (found)
//!             what the AI Computer requested in each state (requested)
//!             how close each came to its limits (margins)
//!             identifiers, cycles and lengths of frames, answers of the handshake (frames)
//! ```
//!
//! Two recordings are aligned by the states that the VCU was in, one after the other, and not by the clock: nobody presses "Go"
//! at the same moment twice. What varies from run to run counts only from a share on: [`differs`].
//!
//! ```
//! use adsdv_oracle::candump::Reader;
//! use adsdv_oracle::compare::{Comparison, Recording};
//! use adsdv_oracle::log::LogOptions;
//!
//! let read = |log: &'static str| Recording::read(Reader::new(log.as_bytes()), &LogOptions::default(), true, |_| {});
//! let good = read("(1.00) can0 520#0000010000000000\n(1.01) can0 520#0000020000000000\n")?;
//! let bad = read("(7.00) can0 520#0000010000000000\n(7.01) can0 520#0000010000000000\n")?;
//! assert!(!Comparison::between(&good, &good).differs());
//! let parting = Comparison::between(&good, &bad).parting.expect("one stays in AS_OFF");
//! assert_eq!(parting.state.name(), "AS_OFF");
//! # Ok::<(), adsdv_oracle::log::LogError>(())
//! ```

mod collect;
mod cycle;
mod found;
mod frames;
mod lasted;
mod margins;
mod parting;
mod path;
mod requested;

use adsdv_spec::{AsState, Edition};

pub use collect::{Collected, Range, Requests, Seen, Sequence};
pub use cycle::Cycle;
pub use found::FoundOnce;
pub use frames::{AnswersDiffer, FrameDiffers};
pub use lasted::LastedDiffers;
pub use margins::MarginDiffers;
pub use parting::{Parting, Way};
pub use path::{Aligned, OnlyTransition, Path, align};
pub use requested::{RangeDiffers, SequenceDiffers};

pub(crate) use collect::Collector;

use crate::candump::{Entries, ReadError};
use crate::judge::Report;
use crate::log::{Judged, LogError, LogJudge, LogOptions, LogProgress, judge_all};
use crate::recognise::Recognised;

/// From this share on, of the larger of the two, numbers differ.
const SHARE: f64 = 0.2;

/// Whether two numbers differ by so much that it matters.
///
/// ```
/// use adsdv_oracle::compare::differs;
/// assert!(!differs(10.0, 11.9) && differs(10.0, 13.0) && differs(0.0, 0.1));
/// ```
pub fn differs(one: f64, other: f64) -> bool {
    (one - other).abs() > SHARE * one.abs().max(other.abs())
}

/// Which of the two recordings.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Which {
    /// That in which it worked.
    Good,
    /// That in which it did not.
    Bad,
}

impl Which {
    /// `GOOD` or `BAD`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Good => "GOOD",
            Self::Bad => "BAD",
        }
    }
}

/// A recording, judged, with what its frames were like.
#[derive(Debug)]
pub struct Recording {
    /// The edition that it was judged by.
    pub edition: &'static Edition,
    /// How that was recognised, if nobody asked for one.
    pub recognised: Option<Recognised>,
    /// What the judge has to say.
    pub report: Report,
    /// What the frames were like.
    pub collected: Collected,
    /// Why not all of the log could be read.
    pub failure: Option<ReadError>,
}

impl Recording {
    /// Reads a log, streaming, in memory that does not grow with it; `by_log`: the log itself tells the edition.
    ///
    /// # Errors
    ///
    /// As [`judge_entries`](crate::log::judge_entries).
    pub fn read(
        mut entries: impl Entries,
        options: &LogOptions,
        by_log: bool,
        mut progress: impl FnMut(LogProgress),
    ) -> Result<Self, LogError> {
        let judge = if by_log { LogJudge::recognising } else { LogJudge::new };
        let judge = judge(options.clone()).collecting();
        let (judged, collector) = judge_all(&mut entries, judge, &mut progress, None)?;
        let Judged { report, failure, recognised, .. } = judged;
        let edition = recognised.edition;
        let collected = collector.map(|collector| collector.end()).unwrap_or_default();
        Ok(Self { edition, recognised: by_log.then_some(recognised), report, collected, failure })
    }
}

/// What differs between two recordings. An empty list, or `None`: nothing that matters.
#[derive(Debug)]
pub struct Comparison<'a> {
    /// The editions, if they differ.
    pub editions: Option<[&'static Edition; 2]>,
    /// The states that they begin in, if these differ.
    pub begin: Option<[AsState; 2]>,
    /// The first place where the two go different ways, or one of them no further.
    pub parting: Option<Parting<'a>>,
    /// The transitions that only one has, in order.
    pub transitions: Vec<OnlyTransition>,
    /// The states that lasted longer in one, the largest difference first.
    pub lasted: Vec<LastedDiffers>,
    /// What only one was found to do, violations first.
    pub found: Vec<FoundOnce<'a>>,
    /// The requests of the AI Computer that had another range in a state.
    pub ranges: Vec<RangeDiffers>,
    /// What the AI Computer said one after the other in a state, where that is something else.
    pub sequences: Vec<SequenceDiffers<'a>>,
    /// Identifiers that only one has, or that come otherwise.
    pub frames: Vec<FrameDiffers>,
    /// The answers of the handshake, if they took longer in one.
    pub answers: Option<AnswersDiffer>,
    /// Every margin that one of them has, those that got notably worse first. Only [these](MarginDiffers::got_worse) and
    /// [the opposite](MarginDiffers::got_better) matter.
    pub margins: Vec<MarginDiffers<'a>>,
}

impl<'a> Comparison<'a> {
    /// Compares two recordings.
    pub fn between(good: &'a Recording, bad: &'a Recording) -> Self {
        let paths = [good, bad].map(|recording| Path::of(&recording.report));
        let steps = align(&paths[0].transitions(), &paths[1].transitions());
        let places = path::in_both(&paths, &steps);
        let other = good.edition.version != bad.edition.version;
        Self {
            editions: other.then_some([good.edition, bad.edition]),
            begin: path::begin(&paths),
            parting: parting::find([good, bad], &paths, &places),
            transitions: path::only_one(&paths, &steps),
            lasted: lasted::between(&paths, &steps),
            found: found::between(&good.report.findings, &bad.report.findings),
            ranges: requested::ranges([&good.collected, &bad.collected], &places),
            sequences: requested::sequences([&good.collected, &bad.collected], &places),
            frames: frames::between(&good.collected, &bad.collected),
            answers: frames::answers(good, bad),
            margins: margins::between(&good.report.margins, &bad.report.margins),
        }
    }

    /// Whether anything that matters does.
    pub fn differs(&self) -> bool {
        let Self {
            editions,
            begin,
            parting,
            transitions,
            lasted,
            found,
            ranges,
            sequences,
            frames,
            answers,
            margins,
        } = self;
        editions.is_some()
            || begin.is_some()
            || parting.is_some()
            || answers.is_some()
            || margins.iter().any(|margin| margin.got_worse() || margin.got_better())
            || !(transitions.is_empty() && lasted.is_empty() && found.is_empty() && frames.is_empty())
            || !(ranges.is_empty() && sequences.is_empty())
    }
}
