//! Counterexamples: what fails, as a log that `adsdv check` reads.

use std::collections::HashSet;
use std::path::{Path, PathBuf};
use std::{fs, io};

use adsdv_model::Run;
use adsdv_oracle::candump;
use adsdv_oracle::judge::{JudgeOptions, Report};
use adsdv_oracle::log::{LogOptions, judge_log};
use adsdv_spec::{Choice, Choices, Edition, Readings};

use super::outcome::{Checked, Outcome};
use crate::error::Error;

/// The interface that the frames are said to be from.
const INTERFACE: &str = "vcan0";

/// A property that fails, and the run that shows it.
#[derive(Debug)]
pub(super) struct Failure {
    /// The property's name.
    pub(super) name: &'static str,
    /// The log.
    pub(super) log: PathBuf,
    /// What the judge of logs assumes: where readings were chosen, the default, which the property asks for.
    pub(super) pins: Vec<Choice>,
    /// What the judge of logs makes of it.
    pub(super) report: Report,
}

/// Whether logs can be written there: better asked before a long exploration than after it.
pub(super) fn expect_directory(dir: &Path) -> Result<(), Error> {
    if dir.is_dir() { Ok(()) } else { Err(Error::write(dir, &io::ErrorKind::NotADirectory.into())) }
}

/// Writes and judges the log of every failure; of a property that fails in two models, that of the first. Those that can be
/// written are, and why another could not is reported with them: what was explored for so long is not lost with it.
pub(super) fn write(
    edition: &'static Edition,
    outcome: &Outcome,
    dir: &Path,
) -> Result<(Vec<Failure>, Option<Error>), Error> {
    let pins = pins(edition, outcome.machine.readings());
    let mut names = HashSet::new();
    let failed = outcome.models.iter().flat_map(|model| &model.results);
    let runs =
        failed.filter_map(|Checked { name, counterexample, .. }| Some((name, counterexample.as_ref()?)));
    let runs = runs.filter(|(name, _)| names.insert(**name));
    let mut failures = Vec::new();
    let mut unwritten = None;
    for (name, run) in runs {
        let log = dir.join(format!("counterexample-{name}.log"));
        let text = text(run);
        if let Err(error) = fs::write(&log, &text) {
            unwritten.get_or_insert(Error::write(&log, &error));
            continue;
        }
        let report = judge_log(text.as_slice(), &options(edition, &pins), |_| {})
            .map_err(|error| Error::log(&log.display().to_string(), &error))?;
        failures.push(Failure { name, log, pins: pins.clone(), report });
    }
    Ok((failures, unwritten))
}

/// How a counterexample's log is judged.
pub(super) fn options(edition: &'static Edition, pins: &[Choice]) -> LogOptions {
    let readings = pins.iter().copied().fold(edition.choices, Choices::pin);
    LogOptions { judge: JudgeOptions { readings, ..JudgeOptions::of(edition) }, ..LogOptions::default() }
}

/// The defaults of the questions that were answered otherwise.
fn pins(edition: &Edition, readings: Readings) -> Vec<Choice> {
    let usual = edition.readings;
    let others = readings.choices().difference(usual.choices());
    others.iter().map(|choice| usual.choice(choice.reading())).collect()
}

/// A run as candump prints it.
fn text(run: &Run) -> Vec<u8> {
    let mut text = Vec::new();
    for (time_ns, frame) in run.frames() {
        // Writing to a vector does not fail, and frames of the interface can be read back.
        let _ = candump::write_frame(&mut text, time_ns, INTERFACE, frame.id.into(), frame.data());
    }
    text
}
