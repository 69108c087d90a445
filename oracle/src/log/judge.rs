//! The judge of a log that comes frame by frame.

use std::collections::{BTreeMap, BTreeSet};

use adsdv_spec::{AsState, Edition, Knowledge};

use super::LogOptions;
use super::directions::Directions;
use crate::candump::Dropped;
use crate::compare::Collector;
use crate::judge::{Finding, Judge, Party, Rule, Transition};
use crate::recognise::{Hearing, Held, Later, Recognised};
use crate::rules::RuleErrors;
use crate::why::Stay;

/// The judge of a log that comes frame by frame; [`judge_log`](super::judge_log) reads one with it.
///
/// ```
/// use adsdv_oracle::candump::{FrameKind, Record};
/// use adsdv_oracle::log::{LogJudge, LogOptions};
///
/// let mut judge = LogJudge::new(LogOptions::default());
/// let mut heard = |time_ns, data: &[u8]| {
///     let kind = FrameKind::Standard;
///     let frame = Record {
///         line: 0, time_ns, interface: "can0", kind, id: 0x520, data, direction: None, terminated: true,
///     };
///     judge.frame(&frame);
/// };
/// heard(1_000_000_000, &[0, 0, 1, 0, 0, 0, 0, 0]);
/// heard(1_010_000_000, &[0, 0, 2, 0, 0, 0, 0, 0]);
/// // The transition is judged when its window has passed, whether or not another frame comes.
/// assert!(judge.news().0.is_empty());
/// judge.time_passes(1_100_000_000);
/// assert_eq!(judge.news().0.len(), 1);
/// assert_eq!(judge.finish(0)?.transitions.len(), 1);
/// # Ok::<(), adsdv_oracle::log::LogError>(())
/// ```
#[derive(Debug)]
pub struct LogJudge {
    pub(super) options: LogOptions,
    pub(super) judge: Judge,
    /// The interface that is judged, once it is known.
    pub(super) interface: Option<String>,
    /// The time of the first frame.
    pub(super) origin: Option<i64>,
    pub(super) first_broken: Option<crate::candump::LineError>,
    pub(super) frames: u64,
    pub(super) on_interface: u64,
    /// How many frames were not judged, by reason.
    pub(super) passed_over: BTreeMap<String, u64>,
    /// The interfaces that are not judged though they carry messages of the document.
    pub(super) neglected: BTreeSet<String>,
    pub(super) directions: Directions,
    /// What has come, as long as the edition is still to be recognised.
    pub(super) hearing: Option<Box<Hearing>>,
    pub(super) recognised: Option<Recognised>,
    pub(super) later: Option<Later>,
    /// Takes down what the frames are like, where that is asked for.
    pub(super) collector: Option<Box<Collector>>,
    /// What the edition has not of what the rules of the user's own name.
    pub(super) impossible: Option<Box<RuleErrors>>,
}

impl LogJudge {
    /// The edition of the interface that is judged by.
    pub const fn edition(&self) -> &Edition {
        self.judge.edition()
    }

    /// No frame has come yet.
    pub fn new(options: LogOptions) -> Self {
        let mut judge = Self {
            judge: Judge::new(options.judge),
            interface: options.interface.clone(),
            options,
            origin: None,
            first_broken: None,
            frames: 0,
            on_interface: 0,
            passed_over: BTreeMap::new(),
            neglected: BTreeSet::new(),
            directions: Directions::default(),
            hearing: None,
            recognised: None,
            later: None,
            collector: None,
            impossible: None,
        };
        judge.follow();
        judge
    }

    /// No frame has come yet, and the frames are to tell the edition. The one of the options is for frames that do not.
    ///
    /// Nothing is judged before enough was heard; then all of it is. That takes a second, or up to ten where the frames of the
    /// first do not tell, such as those of an AI Computer alone.
    ///
    /// ```
    /// use adsdv_oracle::log::{LogJudge, LogOptions};
    ///
    /// let mut judge = LogJudge::recognising(LogOptions::default());
    /// # let heard = |time_ns| adsdv_oracle::candump::Record {
    /// #     line: 0, time_ns, interface: "can0", kind: adsdv_oracle::candump::FrameKind::Standard, id: 0x524,
    /// #     data: &[0, 0, 0, 0, 0x11], direction: None, terminated: true,
    /// # };
    /// judge.frame(&heard(0)); // a 524h of five bytes
    /// assert_eq!(judge.recognised(), None);
    /// judge.time_passes(1_000_000_000); // which is in 4.0 as in 2026, so that more is to be heard
    /// assert_eq!(judge.recognised(), None);
    /// judge.time_passes(10_000_000_000);
    /// assert_eq!(judge.recognised().map(|recognised| recognised.edition.version), Some("2026"));
    /// ```
    pub fn recognising(options: LogOptions) -> Self {
        let hearing = Hearing::new(options.judge.edition, options.interface.clone());
        Self { hearing: Some(Box::new(hearing)), ..Self::new(options) }
    }

    /// The same, and what the frames are like is taken down.
    pub(crate) fn collecting(self) -> Self {
        Self { collector: Some(Box::default()), ..self }
    }

    /// The interface that is judged: the one of the options or, once one has carried a message of the document, that.
    pub fn interface(&self) -> Option<&str> {
        self.interface.as_deref()
    }

    /// When the last frame came, by the time that the judge gives it, in nanoseconds since the first frame: times of findings count so,
    /// also where the clock of the log was set back. `None` as long as nothing is judged.
    pub fn judged_at(&self) -> Option<i64> {
        self.hearing.is_none().then(|| self.judge.now_ns())
    }

    /// How it is judged, by the edition that was recognised.
    pub(crate) const fn options(&self) -> &LogOptions {
        &self.options
    }

    /// Which edition is judged by, and why, once that is decided. `None` before, and where it was not asked for.
    pub const fn recognised(&self) -> Option<&Recognised> {
        self.recognised.as_ref()
    }

    /// No frame has come up to this time, by the clock of the frames: what waited for it is judged.
    ///
    /// Before the first frame there is nothing to wait for, and a time before that of the last frame changes nothing.
    pub fn time_passes(&mut self, time_ns: i64) {
        if self.hearing.is_some() && self.still_hears(time_ns) {
            if self.has_frame() {
                self.hear(Held::TimePasses(time_ns));
            }
            return;
        }
        if let Some(origin) = self.origin {
            self.judge.time_passes(time_ns.saturating_sub(origin));
        }
    }

    /// So many frames were lost before the next one. What they said is unknown, so that the judge starts anew.
    pub fn lost(&mut self, count: u64) {
        if self.hearing.is_some() {
            return self.hear(Held::Lost(count));
        }
        self.judge.lost(count);
    }

    /// The log says that frames were lost before the next one; it concerns the judge if they came from the interface that is
    /// judged, or if that is not known yet.
    pub fn dropped(&mut self, dropped: &Dropped<'_>) {
        if self.hearing.is_some() {
            return self.hear(Held::dropped(dropped));
        }
        if self.interface.as_ref().is_none_or(|interface| interface == dropped.interface) {
            self.judge.lost(dropped.count);
        }
    }

    /// The transitions and findings that are new since this was last asked. The report has them as well, but for findings
    /// beyond the number that it lists: see [`Judge::news`].
    pub fn news(&mut self) -> (Vec<Transition>, Vec<Finding>) {
        self.judge.news()
    }

    /// The AS state that the VCU showed last, while its frames are fresh.
    pub fn state(&self) -> Option<AsState> {
        self.judge.state()
    }

    /// What is known now of the conditions of Figure 2.
    pub fn known(&self) -> Knowledge {
        self.judge.known()
    }

    /// What the VCU waits for: see [`Judge::waits`].
    pub fn waits(&self) -> Option<(i64, &Stay)> {
        self.judge.waits()
    }

    pub(super) fn warn(&mut self, rule: Rule, message: String) {
        let t_ns = self.judge.now_ns();
        self.judge.found(Finding::warning(Party::Log, "2", rule, t_ns).seen(message));
    }

    /// A line of the log could not be read.
    #[cold]
    pub fn broken(&mut self, error: crate::candump::LineError) {
        if self.hearing.is_some() {
            return self.hear(Held::Broken(error));
        }
        self.warn(Rule::BrokenLine, error.to_string());
        self.first_broken.get_or_insert(error);
    }
}
