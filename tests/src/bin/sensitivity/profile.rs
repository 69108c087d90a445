//! How a recording is made, and what the judge says of it.

use std::path::{Path, PathBuf};
use std::{fmt, fs, io};

use adsdv_oracle::candump::write_frame;
use adsdv_oracle::judge::{Finding, JudgeOptions, Party, Report, Rule, Severity};
use adsdv_spec::Edition;
use adsdv_tests::world::{MS, Recorded, judge, violations};

use super::drive::Run;

/// How a recording is made.
#[derive(Clone, Copy)]
pub(crate) struct Profile {
    /// By how much a frame may be late.
    jitter_ms: i64,
    /// One in so many frames is lost; 0: none.
    loss: u64,
    /// Whether somebody vouches that none is.
    complete: bool,
}

/// What is tried.
pub(crate) const PROFILES: [Profile; 9] = [
    Profile { jitter_ms: 0, loss: 0, complete: true },
    Profile { jitter_ms: 2, loss: 0, complete: true },
    Profile { jitter_ms: 5, loss: 0, complete: true },
    Profile { jitter_ms: 20, loss: 0, complete: true },
    Profile { jitter_ms: 0, loss: 0, complete: false },
    Profile { jitter_ms: 5, loss: 0, complete: false },
    Profile { jitter_ms: 10, loss: 0, complete: false },
    Profile { jitter_ms: 20, loss: 0, complete: false },
    Profile { jitter_ms: 20, loss: 10, complete: false },
];

/// What is said of the VCU, the most serious last.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Detection {
    Nothing,
    /// By this rule.
    Warning(Rule),
    Violation {
        /// How long after the VCU first did something else.
        delay_ms: i64,
    },
}

impl Profile {
    /// What the recorder keeps of a run.
    fn recording(&self, run: &Run) -> Vec<Recorded> {
        let mut log = run.world.disturbed(run.seed, self.jitter_ms * MS, self.loss);
        log.drain(..log.len() * run.cut / 100);
        log
    }

    /// Whether all that a document excludes has to be a violation: somebody vouches for the recording, and it is hardly late.
    pub(crate) const fn is_to_tell(&self) -> bool {
        self.complete && self.loss == 0 && self.jitter_ms <= 5
    }

    /// Writes a recording into a directory, for `adsdv check`.
    pub(crate) fn keep(&self, directory: &Path, run: &Run) -> io::Result<PathBuf> {
        fs::create_dir_all(directory)?;
        let mut log = Vec::new();
        for recorded in self.recording(run) {
            write_frame(&mut log, recorded.t, "can0", recorded.frame.id.into(), recorded.frame.data())?;
        }
        let edition = run.world.vcu.edition().version;
        let complete = if self.complete { "-complete" } else { "" };
        let name = format!("{edition}-{}-{}ms-{}{complete}.log", run.seed, self.jitter_ms, self.loss);
        let path = directory.join(name);
        fs::write(&path, log)?;
        Ok(path)
    }

    /// The report, and when the recording begins.
    fn report(&self, edition: &'static Edition, run: &Run) -> (Report, i64) {
        let options =
            JudgeOptions { complete: self.complete, readings: run.readings, ..JudgeOptions::of(edition) };
        let log = self.recording(run);
        let origin = log.first().map_or(0, |first| first.t);
        (judge(&log, options), origin)
    }

    /// The violations of the VCU, a line each.
    pub(crate) fn blame(&self, edition: &'static Edition, run: &Run) -> Vec<String> {
        let (report, _) = self.report(edition, run);
        violations(&report).into_iter().filter(|line| line.split(' ').nth(1) == Some("VCU")).collect()
    }

    /// The first of the most serious findings about the VCU; notes do not count.
    pub(crate) fn worst(&self, edition: &'static Edition, run: &Run) -> Option<Finding> {
        let findings = self.report(edition, run).0.findings;
        let about_vcu =
            findings.into_iter().filter(|one| one.party == Party::Vcu && one.severity != Severity::Note);
        about_vcu.min_by_key(|one| one.severity)
    }

    /// What the judge says of the VCU; notes do not count.
    pub(crate) fn judge(&self, edition: &'static Edition, run: &Run) -> Detection {
        let (report, origin) = self.report(edition, run);
        let about_vcu = report.findings.iter().filter(|finding| finding.party == Party::Vcu);
        let said = about_vcu.filter_map(|finding| match finding.severity {
            Severity::Violation => {
                let since = run.differs_at.map_or(0, |at| finding.t_ns + origin - at);
                Some(Detection::Violation { delay_ms: since / MS })
            }
            Severity::Warning => Some(Detection::Warning(finding.rule)),
            Severity::Note => None,
        });
        said.max().unwrap_or(Detection::Nothing)
    }
}

impl fmt::Display for Profile {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.jitter_ms {
            0 => write!(f, "in time")?,
            ms => write!(f, "late by up to {ms} ms")?,
        }
        if self.loss > 0 {
            write!(f, ", 1 of {} frames lost", self.loss)?;
        }
        f.write_str(if self.complete { ", --complete" } else { "" })
    }
}
