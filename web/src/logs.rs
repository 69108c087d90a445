//! A log, judged.

use std::io::Read;

use adsdv_formats::open;
use adsdv_oracle::judge::{Report, Severity};
use adsdv_oracle::log::{Judged, LogError};
use adsdv_report::json::{CheckJson, line};
use adsdv_report::{Asked, Recorder, Subject};
use serde::Serialize;
use serde_json::value::RawValue;

use crate::error::Refusal;
use crate::subject;

/// A log that is to be judged.
#[derive(Clone, Debug)]
pub(crate) struct LogAsked {
    pub(crate) name: String,
    pub(crate) edition: Option<String>,
    pub(crate) readings: Vec<String>,
    /// The verdict alone, of many logs.
    pub(crate) brief: bool,
}

/// A log that was judged.
#[derive(Serialize)]
pub(crate) struct JudgedJson {
    format: &'static str,
    edition: &'static str,
    recognised: bool,
    verdict: &'static str,
    violations: usize,
    warnings: usize,
    frames: u64,
    duration_s: f64,
    /// Why not all of it could be read.
    failure: Option<Refusal>,
    /// What the page shows.
    data: Option<Box<RawValue>>,
}

/// Judges a log.
pub(crate) fn judge(asked: &LogAsked, source: Box<dyn Read + Send>) -> Result<JudgedJson, Refusal> {
    let edition = subject::edition(asked.edition.as_deref())?;
    let pins = subject::readings(&asked.readings)?;
    let how = Asked::new(edition, &pins).map_err(|error| Refusal::pin(&error))?;
    let log = open(source).map_err(|error| Refusal::open(&asked.name, &error))?;
    let format = log.format().name();
    let refused = |error: LogError| Refusal::log(&asked.name, &error);
    if asked.brief {
        let judged = how.judge(log, |_| {}).map_err(refused)?;
        how.under(judged.recognised.edition).map_err(|error| Refusal::pin(&error))?;
        return Ok(judged_json(asked, &how, format, judged, None));
    }
    let mut recorder = Recorder::new(log, how.options.judge.window_ms);
    let judged = how.judge(&mut recorder, |_| {}).map_err(refused)?;
    let edition = judged.recognised.edition;
    let how = how.under(edition).map_err(|error| Refusal::pin(&error))?;
    let recording = recorder.finish(judged.interface.as_deref());
    let recognised = how.by_log.then_some(&judged.recognised);
    let check = line(&CheckJson::new(edition, recognised, &judged.report));
    let page = Subject {
        name: &asked.name,
        settings: &how.settings(),
        check: check.trim_end(),
        edition,
        report: &judged.report,
        recording: &recording,
    };
    let data = page.data().and_then(RawValue::from_string);
    let data = data.map_err(|error| Refusal::of_request(format!("the report is no JSON: {error}")))?;
    Ok(judged_json(asked, &how, format, judged, Some(data)))
}

fn judged_json(
    asked: &LogAsked,
    how: &Asked,
    format: &'static str,
    judged: Judged,
    data: Option<Box<RawValue>>,
) -> JudgedJson {
    let Judged { report, failure, recognised, .. } = judged;
    JudgedJson {
        format,
        edition: recognised.edition.version,
        recognised: how.by_log,
        verdict: report.verdict().name(),
        violations: count(&report, Severity::Violation),
        warnings: count(&report, Severity::Warning),
        frames: report.frames,
        duration_s: adsdv_report::json::seconds(report.duration_ns),
        failure: failure.map(|error| Refusal::log(&asked.name, &LogError::Read(error))),
        data,
    }
}

fn count(report: &Report, severity: Severity) -> usize {
    report.findings.iter().filter(|finding| finding.severity == severity).count()
}
