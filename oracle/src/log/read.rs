//! Reads a log to its end, and lets a judge see all of it.

use std::io::Read;

use super::{LogError, LogJudge, LogOptions};
use crate::candump::{Entries, Entry, ReadError, Reader};
use crate::compare::Collector;
use crate::judge::{Report, Rule};
use crate::recognise::Recognised;

/// What a step of reading came to, for showing progress.
#[derive(Clone, Copy, Debug)]
pub struct LogProgress {
    /// Lines read so far.
    pub lines: u64,
}

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
    judge_entries(Reader::new(source), options, progress)
}

/// Like [`judge_readable`], of a log of any format.
///
/// # Errors
///
/// As [`judge_readable`].
pub fn judge_entries(
    entries: impl Entries,
    options: &LogOptions,
    progress: impl FnMut(LogProgress),
) -> Result<(Report, Option<ReadError>), LogError> {
    let judged = judge_by(entries, options, false, progress)?;
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
    /// The interface that was judged; `None` if none carries a message of the edition, so that all were.
    pub interface: Option<String>,
}

/// Like [`judge_entries`], by the edition that the log itself tells; by that of the options where it does not.
///
/// ```
/// use adsdv_oracle::candump::Reader;
/// use adsdv_oracle::log::{LogOptions, judge_recognised};
///
/// let log = "(1.0) can0 521#000000000000\n(1.01) can0 520#0000010000000000\n";
/// let judged = judge_recognised(Reader::new(log.as_bytes()), &LogOptions::default(), |_| {})?;
/// let text = "version 2026, though 4.0 fits as well: 521h has 6 bytes (3.0: 8)";
/// assert_eq!(judged.recognised.to_string(), text);
/// # Ok::<(), adsdv_oracle::log::LogError>(())
/// ```
///
/// # Errors
///
/// As [`judge_readable`].
pub fn judge_recognised(
    entries: impl Entries,
    options: &LogOptions,
    progress: impl FnMut(LogProgress),
) -> Result<Judged, LogError> {
    judge_by(entries, options, true, progress)
}

/// The same by the edition of the options or, with `by_log`, by the one that the log tells.
///
/// # Errors
///
/// As [`judge_readable`].
pub fn judge_by(
    mut entries: impl Entries,
    options: &LogOptions,
    by_log: bool,
    mut progress: impl FnMut(LogProgress),
) -> Result<Judged, LogError> {
    let judge = if by_log { LogJudge::recognising } else { LogJudge::new };
    let (judged, _) = judge_all(&mut entries, judge(options.clone()), &mut progress, None)?;
    Ok(judged)
}

/// Sees each entry of a log after the judge.
pub(crate) type Then<'a> = &'a mut dyn FnMut(&mut LogJudge, &Entry<'_>);

/// Lets a judge see all of a log; `then` sees each entry after it. What the judge collected comes back with the report.
///
/// Compiled here, once, and not with each caller for each kind of log.
pub(crate) fn judge_all(
    entries: &mut dyn Entries,
    mut log: LogJudge,
    progress: &mut dyn FnMut(LogProgress),
    mut then: Option<Then<'_>>,
) -> Result<(Judged, Option<Box<Collector>>), LogError> {
    let mut next_progress = PROGRESS_LINES;
    let failure = loop {
        // It stays where the reader has written it: a copy for each frame is what takes time here.
        let next = entries.next_entry();
        let Ok(Some(entry)) = &next else { break next.err() };
        match entry {
            Entry::Frame(record) => {
                if record.line >= next_progress {
                    next_progress = record.line + PROGRESS_LINES;
                    progress(LogProgress { lines: record.line });
                }
                log.frame(record);
            }
            Entry::Dropped(dropped) => log.dropped(dropped),
            Entry::Broken(error) => log.broken(*error),
        }
        if let Some(then) = &mut then {
            then(&mut log, entry);
        }
        if log.rules_are_impossible() {
            break None;
        }
    };
    let failure = match failure {
        Some(error) if !log.has_frame() => return Err(LogError::Read(error)),
        failure => failure,
    };
    // What is warned of before the edition is decided is about a judge who begins anew then.
    log.decide();
    if let Some(error) = &failure {
        log.warn(Rule::BrokenLine, error.to_string());
    }
    let recognised =
        log.recognised().cloned().unwrap_or_else(|| Recognised::named(log.options.judge.edition));
    let (collector, interface) = (log.collector.take(), log.interface.clone());
    Ok((Judged { report: log.finish(entries.count())?, failure, recognised, interface }, collector))
}
