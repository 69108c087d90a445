//! The forms for programs. That of a report is described by `schema/check.schema.json`, and by `schema/watch.schema.json` for
//! a live bus.

mod compare;
mod exercised;
mod finding;
mod rules;
mod stays;

use adsdv_can::live::{Outage, Traffic};
use adsdv_oracle::judge::{Report, Required, ResponseTimes, Transition};
use adsdv_oracle::recognise::Recognised;
use adsdv_spec::{Choice, Edition, Reading};
use exercised::{ExercisedJson, MarginJson, RequiredJson};
use finding::FindingJson;
use rules::RuleJson;
use serde::Serialize;

pub(crate) use compare::compared;
use stays::{GoPressJson, StayJson};

use crate::error::Error;

/// The number of the form that every answer in JSON has, which is its first key; `schema/README.md` says when it changes.
pub(crate) const SCHEMA: u32 = 1;

/// The JSON Schema of what [`readings`] writes.
pub(crate) const READINGS_SCHEMA: &str = include_str!("../schema/readings.schema.json");

/// The JSON Schema of what `adsdv diff --json` writes.
pub(crate) const DIFF_SCHEMA: &str = include_str!("../schema/diff.schema.json");

/// The JSON Schema of what [`compared`] writes.
pub(crate) const COMPARE_SCHEMA: &str = include_str!("../schema/compare.schema.json");

/// The JSON Schema of what [`text`] writes.
pub(crate) const CHECK_SCHEMA: &str = include_str!("../schema/check.schema.json");

/// The JSON Schema of what [`text`] with the name of a log and [`unreadable`] write.
pub(crate) const LOGS_SCHEMA: &str = include_str!("../schema/logs.schema.json");

/// The JSON Schema of what [`watched`] writes.
pub(crate) const WATCH_SCHEMA: &str = include_str!("../schema/watch.schema.json");

/// The JSON Schema of what `adsdv conform --json` writes.
pub(crate) const CONFORM_SCHEMA: &str = include_str!("../schema/conform.schema.json");

/// The form of what `adsdv exam --json` prints.
pub(crate) const EXAM_SCHEMA: &str = include_str!("../schema/exam.schema.json");

/// The JSON Schema of what `adsdv verify --json` writes.
pub(crate) const VERIFY_SCHEMA: &str = include_str!("../schema/verify.schema.json");

/// The JSON Schema of a line that `adsdv suite` writes.
pub(crate) const SUITE_SCHEMA: &str = include_str!("../schema/suite.schema.json");

/// The JSON Schema of what `adsdv suite --prove --json` writes.
pub(crate) const PROVE_SCHEMA: &str = include_str!("../schema/prove.schema.json");

/// A report as one JSON object on one line, with whether it has what was required; with the name of the log, where it is one of
/// several.
pub(crate) fn text(
    log: Option<&str>,
    edition: &Edition,
    recognised: Option<&Recognised>,
    report: &Report,
    required: &[Required],
) -> String {
    let required = RequiredJson::all(required, report);
    line(&CheckJson { log, required, ..CheckJson::new(edition, recognised, report) })
}

/// One of several logs that could not be judged, as one JSON object on one line.
pub(crate) fn unreadable(log: &str, error: &Error) -> String {
    let Error { why, hint, .. } = error;
    line(&UnreadableJson { schema: SCHEMA, log, error: ErrorJson { why, hint } })
}

#[derive(Serialize)]
struct UnreadableJson<'a> {
    schema: u32,
    log: &'a str,
    error: ErrorJson<'a>,
}

#[derive(Serialize)]
struct ErrorJson<'a> {
    why: &'a str,
    hint: &'a str,
}

/// A report of a live bus, and what went over it, as one JSON object on one line.
pub(crate) fn watched(
    edition: &Edition,
    recognised: Option<&Recognised>,
    report: &Report,
    bus: &Bus<'_>,
) -> String {
    let report_json = CheckJson::new(edition, recognised, report);
    line(&WatchJson { report: report_json, bus: BusJson::new(bus, report.duration_ns) })
}

/// What a live bus was like.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bus<'a> {
    pub(crate) traffic: Traffic,
    pub(crate) outages: &'a [Outage],
}

/// The questions that an edition leaves open as one JSON object on one line.
pub(crate) fn readings(edition: &Edition) -> String {
    line(&ReadingsJson {
        schema: SCHEMA,
        edition: edition.version,
        readings: edition.questions().map(|reading| ReadingJson::of(edition, reading)).collect(),
    })
}

/// Nothing here can fail to be written: all keys are text, and all numbers finite.
pub(crate) fn line(value: &impl Serialize) -> String {
    let mut text = serde_json::to_string(value).unwrap_or_default();
    text.push('\n');
    text
}

#[derive(Serialize)]
struct CheckJson<'a> {
    schema: u32,
    /// Its name, where it is one of several.
    #[serde(skip_serializing_if = "Option::is_none")]
    log: Option<&'a str>,
    edition: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    recognised: Option<RecognisedJson<'a>>,
    frames: u64,
    duration_s: f64,
    transitions: Vec<TransitionJson>,
    findings: Vec<FindingJson<'a>>,
    stays: Vec<StayJson>,
    go_presses: Vec<GoPressJson>,
    margins: Vec<MarginJson>,
    handshake_response_ms: Option<ResponseJson>,
    exercised: ExercisedJson,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    rules: Vec<RuleJson<'a>>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    required: Vec<RequiredJson>,
    verdict: &'static str,
}

#[derive(Serialize)]
struct RecognisedJson<'a> {
    certain: bool,
    evidence: &'a [String],
    against: &'a [String],
}

impl<'a> RecognisedJson<'a> {
    fn of(recognised: &'a Recognised) -> Self {
        let Recognised { certain, evidence, against, .. } = recognised;
        Self { certain: *certain, evidence, against }
    }
}

#[derive(Serialize)]
struct WatchJson<'a> {
    #[serde(flatten)]
    report: CheckJson<'a>,
    bus: BusJson,
}

#[derive(Serialize)]
struct BusJson {
    frames_per_second: RateJson,
    error_frames: u64,
    dropped_frames: u64,
    troubles: Vec<TroubleJson>,
    troubles_not_listed: u64,
}

#[derive(Serialize)]
struct RateJson {
    mean: f64,
    busiest: u64,
}

#[derive(Serialize)]
struct TroubleJson {
    t: f64,
    until: Option<f64>,
    what: String,
}

#[derive(Serialize)]
struct TransitionJson {
    t: f64,
    from: &'static str,
    to: &'static str,
    section: &'static str,
    justified: &'static str,
}

#[derive(Serialize)]
struct ResponseJson {
    count: u64,
    min: f64,
    median: f64,
    p99: f64,
    max: f64,
}

#[derive(Serialize)]
struct ReadingsJson {
    schema: u32,
    edition: &'static str,
    readings: Vec<ReadingJson>,
}

#[derive(Serialize)]
struct ReadingJson {
    id: &'static str,
    section: &'static str,
    question: &'static str,
    choices: Vec<ChoiceJson>,
}

#[derive(Serialize)]
struct ChoiceJson {
    id: &'static str,
    text: &'static str,
    default: bool,
}

impl<'a> CheckJson<'a> {
    fn new(edition: &Edition, recognised: Option<&'a Recognised>, report: &'a Report) -> Self {
        Self {
            schema: SCHEMA,
            log: None,
            edition: edition.version,
            recognised: recognised.map(RecognisedJson::of),
            frames: report.frames,
            duration_s: seconds(report.duration_ns),
            transitions: report.transitions.iter().map(TransitionJson::from).collect(),
            findings: report.findings.iter().map(FindingJson::from).collect(),
            stays: report.stays.iter().map(|stay| StayJson::of(&edition.rules, stay)).collect(),
            go_presses: report
                .go_presses
                .iter()
                .map(|press| GoPressJson::of(&edition.rules, press))
                .collect(),
            margins: report.margins.iter().map(MarginJson::from).collect(),
            handshake_response_ms: ResponseJson::of(&report.responses),
            exercised: ExercisedJson::from(&report.exercised),
            rules: report.rules.iter().map(RuleJson::from).collect(),
            required: Vec::new(),
            verdict: report.verdict().name(),
        }
    }
}

impl BusJson {
    fn new(bus: &Bus<'_>, duration_ns: i64) -> Self {
        let Traffic { frames, errors, dropped, troubles, busiest, .. } = bus.traffic;
        let listed = u64::try_from(bus.outages.len()).unwrap_or(troubles);
        Self {
            frames_per_second: RateJson { mean: mean(frames, duration_ns), busiest },
            error_frames: errors,
            dropped_frames: dropped,
            troubles: bus.outages.iter().map(TroubleJson::from).collect(),
            troubles_not_listed: troubles.saturating_sub(listed),
        }
    }
}

impl From<&Outage> for TroubleJson {
    fn from(outage: &Outage) -> Self {
        Self {
            t: seconds(outage.t_ns),
            until: outage.until_ns.map(seconds),
            what: outage.trouble.to_string(),
        }
    }
}

/// Frames in a second, with one decimal; of a run shorter than a second, the frames themselves.
#[allow(clippy::cast_precision_loss, reason = "a rate for display")]
fn mean(frames: u64, duration_ns: i64) -> f64 {
    let seconds = (duration_ns as f64 / 1e9).max(1.0);
    (frames as f64 / seconds * 10.0).round() / 10.0
}

impl From<&Transition> for TransitionJson {
    fn from(transition: &Transition) -> Self {
        Self {
            t: seconds(transition.t_ns),
            from: transition.from.name(),
            to: transition.to.name(),
            section: transition.section,
            justified: transition.justified.name(),
        }
    }
}

impl ResponseJson {
    fn of(times: &ResponseTimes) -> Option<Self> {
        Some(Self {
            count: times.count(),
            min: to_microseconds(times.min_ms()?),
            median: to_microseconds(times.quantile_ms(0.5)?),
            p99: to_microseconds(times.quantile_ms(0.99)?),
            max: to_microseconds(times.max_ms()?),
        })
    }
}

impl ReadingJson {
    fn of(edition: &Edition, reading: Reading) -> Self {
        Self {
            id: reading.id(),
            section: reading.section(),
            question: reading.question(),
            choices: edition
                .choices
                .of_reading(reading)
                .map(|choice| ChoiceJson::of(edition, choice))
                .collect(),
        }
    }
}

impl ChoiceJson {
    fn of(edition: &Edition, choice: Choice) -> Self {
        Self { id: choice.id(), text: choice.text(), default: edition.readings.is(choice) }
    }
}

/// Nanoseconds as seconds, rounded to whole microseconds, which is what candump writes.
#[allow(clippy::cast_precision_loss, reason = "285 years of microseconds fit")]
pub(crate) fn seconds(ns: i64) -> f64 {
    ns.saturating_add(500).div_euclid(1000) as f64 / 1e6
}

/// Milliseconds rounded to whole microseconds.
fn to_microseconds(ms: f64) -> f64 {
    (ms * 1e3).round() / 1e3
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_rounded_to_microseconds() {
        let cases = [
            (0, "0.0"),
            (499, "0.0"),
            (500, "1e-6"),
            (13_015_234_567, "13.015235"),
            (-400, "0.0"),
            (3_600_000_000_001_499, "3600000.000001"),
        ];
        for (ns, text) in cases {
            assert_eq!(serde_json::to_string(&seconds(ns)).ok().as_deref(), Some(text), "{ns} ns");
        }
        assert!(seconds(i64::MAX).is_finite() && seconds(i64::MIN).is_finite());
    }
}
