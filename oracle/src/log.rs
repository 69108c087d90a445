//! From a log to a report: picks the interface, and lets the judge see every frame.
//!
//! [`judge_log`] reads a recorded log to its end. [`LogJudge`] takes frame by frame, for a bus that is live.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::io::Read;

use adsdv_spec::Edition;
use adsdv_spec::messages::{Ai2VcuStatus, Node, Vcu2AiStatus};

use crate::candump::{Direction, Dropped, Entry, FrameKind, ReadError, Reader, Record};
use crate::judge::{Finding, Judge, JudgeOptions, Party, Report, Rule, Severity, Transition};
use crate::recognise::{Hearing, Held, Later, Recognised};

/// How a log is judged.
#[derive(Clone, Debug, Default)]
pub struct LogOptions {
    /// What the judge may assume.
    pub judge: JudgeOptions,
    /// The interface to judge; `None` for the first that carries a message of the document.
    pub interface: Option<String>,
}

/// Why there is no report.
#[derive(Debug)]
pub enum LogError {
    /// The log could not be read to its end.
    Read(ReadError),
    /// Nothing in the log is a frame.
    NoFrame {
        /// How many lines there are.
        lines: u64,
        /// What is wrong with the first line that is not blank.
        first: Option<crate::candump::LineError>,
    },
    /// The log has frames, but none on the interface that was asked for.
    NoSuchInterface {
        /// The interface asked for.
        wanted: String,
        /// The interfaces that the log has.
        found: Vec<String>,
    },
}

impl fmt::Display for LogError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Read(error) => write!(f, "{error}"),
            Self::NoFrame { lines: 0, .. } => {
                write!(
                    f,
                    "the log is empty; expected lines of candump -L, such as (1.000000) can0 520#0000010000000000"
                )
            }
            Self::NoFrame { lines, first } => {
                write!(f, "no readable frame in {}", counted(*lines, "line"))?;
                if let Some(first) = first {
                    write!(f, "; {first}")?;
                }
                Ok(())
            }
            Self::NoSuchInterface { wanted, found } => {
                write!(f, "no data frame with an 11-bit identifier on interface {wanted}")?;
                if found.is_empty() { Ok(()) } else { write!(f, "; the log has {}", found.join(", ")) }
            }
        }
    }
}

impl std::error::Error for LogError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Read(error) => Some(error),
            _ => None,
        }
    }
}

/// What a step of reading came to, for showing progress.
#[derive(Clone, Copy, Debug)]
pub struct LogProgress {
    /// Lines read so far.
    pub lines: u64,
}

/// A log can name any number of interfaces; the first few tell enough.
const MAX_INTERFACES: usize = 64;

/// So many frames may be of one moment in a log whose times are coarse.
const TIMELESS: u64 = 100;

/// How many lines are read between two calls of the progress function.
const PROGRESS_LINES: u64 = 1 << 16;

/// Judges a log of `candump -L`, streaming, in memory that does not grow with it.
///
/// ```
/// use adsdv_oracle::log::{LogOptions, judge_log};
/// let log = "(1.000000) can0 520#0000010000000000\n(1.010000) can0 520#0000020000000000\n";
/// let report = judge_log(log.as_bytes(), &LogOptions::default(), |_| {})?;
/// assert_eq!(report.frames, 2);
/// assert_eq!(report.transitions.len(), 1); // AS_OFF -> AS_READY with all switches off
/// # Ok::<(), adsdv_oracle::log::LogError>(())
/// ```
///
/// # Errors
///
/// Fails if the source does, or if the log holds no frame at all. A line that is not one is a finding, no error.
pub fn judge_log(
    source: impl Read,
    options: &LogOptions,
    progress: impl FnMut(LogProgress),
) -> Result<Report, LogError> {
    match judge_readable(source, options, progress)? {
        (report, None) => Ok(report),
        (_, Some(error)) => Err(LogError::Read(error)),
    }
}

/// Judges as much of a log as can be read: where the source fails in the middle, the report of what came before, which has a
/// warning that says so, and the failure.
///
/// ```
/// use std::io::Read;
///
/// use adsdv_oracle::log::{LogOptions, judge_readable};
///
/// /// A disk that fails.
/// struct Failing;
///
/// impl Read for Failing {
///     fn read(&mut self, _: &mut [u8]) -> std::io::Result<usize> {
///         Err(std::io::ErrorKind::TimedOut.into())
///     }
/// }
///
/// let log = "(1.000000) can0 520#0000010000000000\n(1.010000) can0 520#0000020000000000\n";
/// let (report, failure) = judge_readable(log.as_bytes().chain(Failing), &LogOptions::default(), |_| {})?;
/// assert_eq!((report.frames, report.transitions.len()), (2, 1));
/// assert_eq!(failure.map(|failure| failure.line), Some(2));
/// # Ok::<(), adsdv_oracle::log::LogError>(())
/// ```
///
/// # Errors
///
/// Fails if the source does before the first frame, or if the log holds no frame at all.
pub fn judge_readable(
    source: impl Read,
    options: &LogOptions,
    progress: impl FnMut(LogProgress),
) -> Result<(Report, Option<ReadError>), LogError> {
    let judged = judge_all(source, LogJudge::new(options.clone()), progress)?;
    Ok((judged.report, judged.failure))
}

/// What became of a log of which the edition was recognised.
#[derive(Debug)]
pub struct Judged {
    /// The report by that edition.
    pub report: Report,
    /// Why not all of the log could be read.
    pub failure: Option<ReadError>,
    /// Which edition it was judged by, and why.
    pub recognised: Recognised,
}

/// Like [`judge_readable`], by the edition that the log itself tells; by that of the options where it does not.
///
/// ```
/// use adsdv_oracle::log::{LogOptions, judge_recognised};
///
/// let log = "(1.0) can0 521#000000000000\n(1.01) can0 520#0000010000000000\n";
/// let judged = judge_recognised(log.as_bytes(), &LogOptions::default(), |_| {})?;
/// let text = "version 2026, though 4.0 fits as well: 521h has 6 bytes (3.0: 8)";
/// assert_eq!(judged.recognised.to_string(), text);
/// # Ok::<(), adsdv_oracle::log::LogError>(())
/// ```
///
/// # Errors
///
/// As [`judge_readable`].
pub fn judge_recognised(
    source: impl Read,
    options: &LogOptions,
    progress: impl FnMut(LogProgress),
) -> Result<Judged, LogError> {
    judge_all(source, LogJudge::recognising(options.clone()), progress)
}

fn judge_all(
    source: impl Read,
    mut log: LogJudge,
    mut progress: impl FnMut(LogProgress),
) -> Result<Judged, LogError> {
    let mut reader = Reader::new(source);
    let mut next_progress = PROGRESS_LINES;
    let failure = loop {
        let entry = match reader.next_record() {
            Ok(Some(entry)) => entry,
            Ok(None) => break None,
            Err(error) if !log.has_frame() => return Err(LogError::Read(error)),
            Err(error) => break Some(error),
        };
        match entry {
            Entry::Frame(record) => {
                if record.line >= next_progress {
                    next_progress = record.line + PROGRESS_LINES;
                    progress(LogProgress { lines: record.line });
                }
                log.frame(&record);
            }
            Entry::Dropped(dropped) => log.dropped(&dropped),
            Entry::Broken(error) => log.broken(error),
        }
    };
    // What is warned of before the edition is decided is about a judge who begins anew then.
    log.decide();
    if let Some(error) = &failure {
        log.warn(Rule::BrokenLine, error.to_string());
    }
    let recognised =
        log.recognised().cloned().unwrap_or_else(|| Recognised::named(log.options.judge.edition));
    Ok(Judged { report: log.finish(reader.line())?, failure, recognised })
}

/// The judge of a log that is told frame by frame; [`judge_log`] reads one with it.
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
    options: LogOptions,
    judge: Judge,
    /// The interface that is judged, once it is known.
    interface: Option<String>,
    /// The time of the first frame.
    origin: Option<i64>,
    first_broken: Option<crate::candump::LineError>,
    frames: u64,
    on_interface: u64,
    /// How many frames were not judged, by reason.
    passed_over: BTreeMap<String, u64>,
    /// The interfaces that are not judged though they carry messages of the document.
    neglected: BTreeSet<String>,
    directions: Directions,
    /// What has come, as long as the edition is still to be recognised.
    hearing: Option<Box<Hearing>>,
    recognised: Option<Recognised>,
    later: Option<Later>,
}

/// In which direction each side's status message went, as far as the log says.
#[derive(Debug, Default)]
struct Directions {
    ai: [u64; 2],
    vcu: [u64; 2],
}

impl Directions {
    fn count(&mut self, id: u16, direction: Option<Direction>) {
        let counts = match id {
            Ai2VcuStatus::ID => &mut self.ai,
            Vcu2AiStatus::ID => &mut self.vcu,
            _ => return,
        };
        match direction {
            Some(Direction::Rx) => counts[0] += 1,
            Some(Direction::Tx) => counts[1] += 1,
            None => {}
        }
    }

    /// Whether the AI Computer itself recorded: its own messages are all sent, and the VCU's are received but for
    /// single ones.
    fn recorded_by_ai(&self) -> bool {
        let ([ai_rx, ai_tx], [vcu_rx, vcu_tx]) = (self.ai, self.vcu);
        ai_tx > 0 && ai_rx == 0 && vcu_rx > 4 && vcu_rx > 4 * vcu_tx
    }
}

impl LogJudge {
    /// The edition of the interface that is judged by.
    pub const fn edition(&self) -> &Edition {
        self.judge.edition()
    }

    /// Nothing has been told yet.
    pub fn new(options: LogOptions) -> Self {
        Self {
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
        }
    }

    /// Nothing has been told yet, and the frames are to tell the edition. The one of the options is for frames that do not.
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

    /// Which edition is judged by, and why, once that is decided. `None` before, and where it was not asked for.
    pub const fn recognised(&self) -> Option<&Recognised> {
        self.recognised.as_ref()
    }

    /// Something came while it is not known yet by which edition to judge.
    #[cold]
    fn hear(&mut self, held: Held) {
        if self.hearing.as_mut().is_some_and(|hearing| hearing.hear(held)) {
            self.decide();
        }
    }

    /// Whether it is still not known, when it is this time, by which edition to judge.
    #[cold]
    fn still_hears(&mut self, time_ns: i64) -> bool {
        if self.hearing.as_mut().is_some_and(|hearing| hearing.is_enough_before(time_ns)) {
            self.decide();
        }
        self.hearing.is_some()
    }

    /// Judges by the edition that was recognised, from the first frame on.
    ///
    /// It is decided by what has come so far, where that is not done yet. Nobody has to ask for it but who wants to know the
    /// edition before the end of frames that are few.
    pub fn decide(&mut self) {
        let Some(hearing) = self.hearing.take() else { return };
        let (recognised, held, later) = hearing.end();
        self.options.judge = self.options.judge.under(recognised.edition);
        self.judge = Judge::new(self.options.judge);
        if !recognised.certain || !recognised.against.is_empty() {
            self.note_edition(&recognised.to_string());
        }
        self.recognised = Some(recognised);
        for held in held {
            match held {
                Held::Frame(frame) => self.frame(&frame.record()),
                Held::TimePasses(time_ns) => self.time_passes(time_ns),
                Held::Lost(count) => self.lost(count),
                Held::Dropped { line, interface, count, total } => {
                    self.dropped(&Dropped { line, interface: &interface, count, total });
                }
                Held::Broken(error) => self.broken(error),
            }
        }
        self.later = Some(later);
    }

    fn note_edition(&mut self, what: &str) {
        let message = format!("judged by {what}");
        self.judge.report(Severity::Note, Party::Log, "2", Rule::Edition, message);
    }

    /// A frame that came later fits another edition better.
    #[cold]
    fn fits_another(&mut self, other: &Recognised) {
        let version = self.judge.edition().version;
        self.note_edition(&format!(
            "version {version} all the same, but from here on the frames fit {other}"
        ));
    }

    /// Whether a frame has come, of whatever kind.
    fn has_frame(&self) -> bool {
        self.frames > 0 || self.hearing.as_ref().is_some_and(|hearing| hearing.has_frame())
    }

    /// Judges a frame, of whatever kind.
    #[inline]
    pub fn frame(&mut self, record: &Record<'_>) {
        if self.hearing.is_some() && self.still_hears(record.time_ns) {
            return self.hear(Held::frame(record));
        }
        self.frames += 1;
        let t = record.time_ns.saturating_sub(*self.origin.get_or_insert(record.time_ns));
        let ours = match &self.interface {
            Some(interface) => interface == record.interface,
            None => self.choose(record),
        };
        if !ours || record.kind != FrameKind::Standard {
            return self.pass_over(t, record, ours);
        }
        self.on_interface += 1;
        if !record.terminated && self.is_cut_off(record) {
            return self.cut_off(t, record);
        }
        if record.direction.is_some() && self.forged(t, record) {
            return;
        }
        self.judge.frame(t, record.id, record.data);
        if let Some(later) = &mut self.later
            && let Some(other) = later.frame(record.id, record.data, self.judge.edition().version)
        {
            self.fits_another(&other);
        }
    }

    /// The first interface that carries a message of the document is the one to judge.
    #[cold]
    fn choose(&mut self, record: &Record<'_>) -> bool {
        if self.is_known(record) {
            self.interface = Some(record.interface.to_owned());
        }
        true
    }

    #[cold]
    fn pass_over(&mut self, t: i64, record: &Record<'_>, ours: bool) {
        self.judge.other_frame(t);
        if !ours && self.is_known(record) && self.neglected.len() < MAX_INTERFACES {
            self.neglected.insert(record.interface.to_owned());
        }
        let reason = match record.kind {
            _ if !ours => format!("on interface {}", record.interface),
            FrameKind::Standard => return,
            FrameKind::Extended => "with an extended identifier".to_owned(),
            FrameKind::Remote { .. } => "of the remote kind".to_owned(),
            FrameKind::Error => "of the error kind".to_owned(),
            FrameKind::Fd { .. } => "of CAN FD".to_owned(),
            FrameKind::Xl => "of CAN XL".to_owned(),
        };
        if self.passed_over.len() < MAX_INTERFACES || self.passed_over.contains_key(&reason) {
            *self.passed_over.entry(reason).or_default() += 1;
        } else {
            *self.passed_over.entry("on further interfaces".to_owned()).or_default() += 1;
        }
    }

    #[cold]
    fn cut_off(&mut self, t: i64, record: &Record<'_>) {
        self.judge.other_frame(t);
        let message = format!(
            "line {}: the log ends in the middle of frame {:03X}h; expected a line feed at its end",
            record.line, record.id
        );
        self.warn(Rule::BrokenLine, message);
    }

    /// Uses the direction of a frame: whether the log was recorded by the AI Computer, and sent by it what only others
    /// may send. Such a frame is the AI Computer's fault, and says nothing about the VCU.
    #[cold]
    fn forged(&mut self, t: i64, record: &Record<'_>) -> bool {
        let Ok(id) = u16::try_from(record.id) else { return false };
        self.directions.count(id, record.direction);
        let forged = self.directions.recorded_by_ai()
            && record.direction == Some(Direction::Tx)
            && !self.judge.edition().bus.may_send(Node::Ai, id);
        if forged {
            self.judge.sent_by_ai(t, record.id);
        }
        forged
    }

    /// No frame has come up to this time, which is told by the clock of the frames: what waited for it is judged.
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

    fn warn(&mut self, rule: Rule, message: String) {
        self.judge.report(Severity::Warning, Party::Log, "2", rule, message);
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

    /// The end of the log, which had so many lines: settles what is still open.
    pub fn finish(mut self, lines: u64) -> Result<Report, LogError> {
        self.decide();
        if self.frames == 0 {
            return Err(LogError::NoFrame { lines, first: self.first_broken });
        }
        if let (0, Some(wanted)) = (self.on_interface, &self.options.interface) {
            let found = self
                .passed_over
                .keys()
                .filter_map(|reason| reason.strip_prefix("on interface "))
                .map(str::to_owned)
                .collect();
            return Err(LogError::NoSuchInterface { wanted: wanted.clone(), found });
        }
        self.judge.end();
        for (reason, count) in &self.passed_over {
            let message = format!("{} {reason}, not judged", counted(*count, "frame"));
            self.judge.report(Severity::Note, Party::Log, "2", Rule::NotJudged, message);
        }
        for interface in self.neglected.iter().filter(|_| self.options.interface.is_none()) {
            let message = format!(
                "{interface} carries messages of the document, too, and was not judged; --interface {interface} judges it"
            );
            self.judge.report(Severity::Warning, Party::Log, "2", Rule::NotJudged, message);
        }
        if self.frames > TIMELESS && self.judge.now_ns() == 0 {
            let message = format!(
                "no time passes in {} frames, so that nothing was judged that takes time; expected the time of each frame, as candump -L writes it",
                self.frames
            );
            self.warn(Rule::NotJudged, message);
        }
        Ok(self.judge.finish())
    }

    /// Whether a frame has the identifier of a message of the document.
    fn is_known(&self, record: &Record<'_>) -> bool {
        self.judge.message(record.id).is_some() && record.kind == FrameKind::Standard
    }

    /// Whether a frame lacks data that its message has.
    fn is_cut_off(&self, record: &Record<'_>) -> bool {
        self.judge.message(record.id).is_some_and(|def| record.data.len() < def.bytes_needed())
    }
}

/// A number with its noun, in the plural where it takes one.
fn counted(count: u64, noun: &str) -> String {
    let s = if count == 1 { "" } else { "s" };
    format!("{count} {noun}{s}")
}
