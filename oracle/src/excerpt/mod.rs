//! Excerpts of a log: for each violation and warning the few frames that show it, as a log that gives the same finding.
//!
//! ```text
//! log --> judge ----> what is new --+
//!    +--> Recent (the last seconds) +--> Excerpts: cut, judge the cut, widen it until it shows the finding, thin it
//! ```
//!
//! A log is read once, since standard input cannot be read twice: what was read in the last seconds is kept, and an excerpt is cut
//! as soon as what follows its finding has come.
//!
//! ```
//! use adsdv_oracle::candump::Reader;
//! use adsdv_oracle::excerpt::judge_with_excerpts;
//! use adsdv_oracle::judge::Severity;
//! use adsdv_oracle::log::LogOptions;
//!
//! let frame = |place: u32| format!("({}.{:02}) can0 520#00000{}0000000000\n", place / 100, place % 100, 1 + place / 150 * 2);
//! let log: String = (0..300).map(frame).collect(); // AS_OFF, and from 1.5 s on AS_DRIVING
//! let (judged, excerpts) = judge_with_excerpts(Reader::new(log.as_bytes()), &LogOptions::default(), false, |_| {})?;
//! let found = [Severity::Violation, Severity::Warning].map(|severity| judged.report.count(severity));
//! assert_eq!(excerpts.cut.len(), found.iter().sum::<usize>()); // a note needs none
//! let first = excerpts.cut.first().expect("an excerpt");
//! assert!(first.shows && first.frames < 50 && first.name(1) == "01-no-such-arrow.log");
//! # Ok::<(), adsdv_oracle::log::LogError>(())
//! ```

mod cut;
mod recent;

use crate::candump::{Entries, Entry};
use crate::judge::{Finding, Severity};
use crate::log::{Judged, LogError, LogJudge, LogOptions, LogProgress, judge_all};

use cut::AFTER_NS;
use recent::Recent;

/// So many findings get an excerpt.
pub const MOST: usize = 20;
/// After so many lines it is seen what is new.
const LOOK: u64 = 256;

/// The frames around a finding.
#[derive(Clone, Debug, PartialEq)]
pub struct Cut {
    /// The finding, as it is in the whole log.
    pub finding: Finding,
    /// A log of `candump -L`.
    pub log: Vec<u8>,
    /// How many lines it has.
    pub frames: usize,
    /// How much of the log before the finding was needed, in nanoseconds.
    pub before_ns: i64,
    /// Whether it gives the same finding: of that rule, party, section and severity, at that time.
    pub shows: bool,
}

impl Cut {
    /// The name of its file, where it is this one, such as `01-transition-unjustified.log`.
    pub fn name(&self, number: usize) -> String {
        format!("{number:02}-{}.log", self.finding.rule.id())
    }
}

/// The excerpts of a log.
#[derive(Debug, Default)]
pub struct Excerpts {
    /// Those that were cut, in order of time.
    pub cut: Vec<Cut>,
    /// How many violations and warnings there are besides.
    pub more: usize,
}

/// Cuts while the log is read.
#[derive(Debug, Default)]
struct Cutter {
    recent: Recent,
    /// What is to be cut once what follows it has come.
    waiting: Vec<Finding>,
    excerpts: Excerpts,
    lines: u64,
}

/// Judges a log, as [`judge_entries`](crate::log::judge_entries), or by the edition that it tells, as
/// [`judge_recognised`](crate::log::judge_recognised), and cuts excerpts of it.
///
/// # Errors
///
/// As these.
pub fn judge_with_excerpts(
    mut entries: impl Entries,
    options: &LogOptions,
    by_log: bool,
    mut progress: impl FnMut(LogProgress),
) -> Result<(Judged, Excerpts), LogError> {
    let judge = if by_log { LogJudge::recognising } else { LogJudge::new };
    let mut cutter = Cutter::default();
    let options_under = |judged: &Judged| LogOptions {
        judge: options.judge.under(judged.recognised.edition),
        ..options.clone()
    };
    let watching = &mut cutter;
    let mut watch = |log: &mut LogJudge, entry: &Entry<'_>| {
        watching.recent.keep(log.judged_at(), entry);
        watching.lines += 1;
        if watching.lines.is_multiple_of(LOOK) {
            watching.look(log);
        }
    };
    let (judged, _) = judge_all(&mut entries, judge(options.clone()), &mut progress, Some(&mut watch))?;
    let options = options_under(&judged);
    let of_report = judged.report.findings.iter().filter(|finding| finding.severity != Severity::Note);
    let all: Vec<Finding> = of_report.cloned().collect();
    cutter.end(&options, &all);
    Ok((judged, cutter.excerpts))
}

impl Cutter {
    /// Sees what is new, and cuts what can be cut.
    fn look(&mut self, log: &mut LogJudge) {
        let Some(now) = log.judged_at() else { return };
        for finding in log.news().1 {
            if finding.severity != Severity::Note && self.waiting.len() + self.excerpts.cut.len() < MOST {
                self.waiting.push(finding);
            }
        }
        let options = log.options().clone();
        for finding in self.waiting.extract_if(.., |finding| finding.t_ns + AFTER_NS < now) {
            self.excerpts.cut.push(cut::cut(&self.recent, finding, &options));
        }
    }

    /// There is no more to come: these were found.
    fn end(&mut self, options: &LogOptions, found: &[Finding]) {
        for finding in self.waiting.drain(..) {
            self.excerpts.cut.push(cut::cut(&self.recent, finding, options));
        }
        for finding in found {
            let known = self.excerpts.cut.iter().any(|cut| cut.finding == *finding);
            if !known && self.excerpts.cut.len() < MOST {
                self.excerpts.cut.push(cut::cut(&self.recent, finding.clone(), options));
            }
        }
        self.excerpts.more = found.len().saturating_sub(self.excerpts.cut.len());
        self.excerpts.cut.sort_by_key(|cut| cut.finding.t_ns);
    }
}
