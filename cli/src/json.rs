//! The forms for programs. That of a report is described by `schema/check.schema.json`, and by `schema/watch.schema.json` for
//! a live bus. Those that the page shows as well are of `adsdv_report`.

use adsdv_can::live::{Outage, Traffic};
use adsdv_oracle::judge::{Report, Required};
use adsdv_oracle::recognise::Recognised;
use adsdv_report::json::{CheckJson, ReadingsJson, seconds};
use adsdv_spec::Edition;
use serde::Serialize;

pub(crate) use adsdv_report::json::{SCHEMA, compared, line};

use crate::error::Error;

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

/// The JSON Schema of each line that `adsdv verify --readings --json` writes.
pub(crate) const COSTS_SCHEMA: &str = include_str!("../schema/costs.schema.json");

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
    line(&CheckJson::new(edition, recognised, report).of_log(log).requiring(required, report))
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
    line(&ReadingsJson::new(edition))
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
