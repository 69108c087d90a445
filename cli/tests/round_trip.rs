//! What `adsdv check --json` prints of random logs: it keeps to its schema, reads back to the report that the judge made of the
//! same log, and what was read is written again as the same bytes.
//!
//! With `PROPTEST_CASES` more logs are tried. A log that has failed once is kept in `round_trip.regressions`, and tried first.

#![forbid(unsafe_code)]

#[path = "round_trip/stays.rs"]
mod stays;

use std::io::Write as _;
use std::process::{Command, Stdio};
use std::sync::LazyLock;
use std::thread;

use adsdv_oracle::candump::write_frame;
use adsdv_oracle::judge::{Evidence, Exercised, Margin, Report, RequirementStanding};
use adsdv_oracle::log::{LogError, LogOptions, judge_log};
use adsdv_spec::Edition;
use adsdv_spec::messages::AnyMessage;
use adsdv_tests::property::Home;
use jsonschema::Validator;
use proptest::prelude::{Just, Strategy, any, prop_oneof};
use proptest::{collection, sample};
use serde::{Deserialize, Serialize};

/// How many logs are tried.
const CASES: u32 = 100;

/// A report, as a program reads it.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Read {
    schema: u32,
    edition: String,
    frames: u64,
    duration_s: f64,
    transitions: Vec<ReadTransition>,
    findings: Vec<ReadFinding>,
    stays: Vec<stays::ReadStay>,
    go_presses: Vec<stays::ReadPress>,
    margins: Vec<ReadMargin>,
    handshake_response_ms: Option<ReadResponse>,
    exercised: ReadExercised,
    verdict: String,
}

#[derive(Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct ReadTransition {
    t: f64,
    from: String,
    to: String,
    section: String,
    justified: String,
}

#[derive(Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct ReadFinding {
    t: f64,
    severity: String,
    party: String,
    section: String,
    rule: String,
    requirements: Vec<String>,
    message: String,
    seen: String,
    expected: Option<String>,
    unless: Option<String>,
    evidence: Vec<ReadEvidence>,
}

#[derive(Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct ReadEvidence {
    t: f64,
    id: String,
}

#[derive(Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct ReadMargin {
    what: String,
    message: Option<String>,
    party: String,
    section: String,
    requirements: Vec<String>,
    value: f64,
    limit: f64,
    unit: String,
    basis: String,
    left: f64,
    t: f64,
}

#[derive(Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct ReadExercised {
    ai: bool,
    vcu: bool,
    states: Vec<String>,
    requirements: Vec<ReadRequirement>,
}

#[derive(Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct ReadRequirement {
    id: String,
    told: String,
}

#[derive(Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct ReadResponse {
    count: u64,
    min: f64,
    median: f64,
    p99: f64,
    max: f64,
}

/// Seconds that are as many microseconds as these nanoseconds, which is what logs have.
#[allow(clippy::cast_precision_loss, reason = "the times here are days at most")]
fn seconds(ns: i64) -> f64 {
    assert_eq!(ns % 1000, 0, "the times of these logs are microseconds");
    (ns / 1000) as f64 / 1e6
}

/// What has to be read of a report.
fn expected(report: &Report) -> Read {
    let ms = |ms: Option<f64>| ms.map(|ms| (ms * 1e3).round() / 1e3).unwrap_or_default();
    let times = &report.responses;
    Read {
        schema: 1,
        edition: LogOptions::default().judge.edition.version.to_owned(),
        frames: report.frames,
        duration_s: seconds(report.duration_ns),
        transitions: report
            .transitions
            .iter()
            .map(|transition| ReadTransition {
                t: seconds(transition.t_ns),
                from: transition.from.name().to_owned(),
                to: transition.to.name().to_owned(),
                section: transition.section.to_owned(),
                justified: transition.justified.name().to_owned(),
            })
            .collect(),
        findings: report
            .findings
            .iter()
            .map(|finding| ReadFinding {
                t: seconds(finding.t_ns),
                severity: finding.severity.name().to_owned(),
                party: finding.party.name().to_owned(),
                section: finding.section.to_string(),
                rule: finding.rule.id().to_owned(),
                requirements: finding.requirements.iter().map(|&id| id.to_owned()).collect(),
                message: finding.message(),
                seen: finding.seen.clone(),
                expected: (!finding.expected.is_empty()).then(|| finding.expected.clone()),
                unless: finding.excuse().map(str::to_owned),
                evidence: finding.evidence.iter().map(evidence).collect(),
            })
            .collect(),
        stays: report.stays.iter().map(stays::expected).collect(),
        go_presses: report.go_presses.iter().map(stays::expected_press).collect(),
        margins: report.margins.iter().map(margin).collect(),
        handshake_response_ms: (times.count() > 0).then(|| ReadResponse {
            count: times.count(),
            min: ms(times.min_ms()),
            median: ms(times.quantile_ms(0.5)),
            p99: ms(times.quantile_ms(0.99)),
            max: ms(times.max_ms()),
        }),
        exercised: exercised(&report.exercised),
        verdict: report.verdict().name().to_owned(),
    }
}

fn evidence(frame: &Evidence) -> ReadEvidence {
    ReadEvidence { t: seconds(frame.t_ns), id: format!("{:03X}h", frame.id) }
}

fn margin(margin: &Margin) -> ReadMargin {
    let rounded = |value: f64, steps: f64| (value * steps).round() / steps;
    ReadMargin {
        what: margin.what.id().to_owned(),
        message: margin.message.map(|id| format!("{id:03X}h")),
        party: margin.party.name().to_owned(),
        section: margin.section.to_owned(),
        requirements: margin.requirements.iter().map(|&id| id.to_owned()).collect(),
        value: rounded(margin.value, 1e3),
        limit: rounded(margin.limit, 1e3),
        unit: margin.unit.to_owned(),
        basis: margin.basis.name().to_owned(),
        left: rounded(margin.left(), 1e6),
        t: seconds(margin.t_ns),
    }
}

fn exercised(exercised: &Exercised) -> ReadExercised {
    let requirement = |one: &RequirementStanding| ReadRequirement {
        id: one.id.to_owned(),
        told: one.standing.name().to_owned(),
    };
    ReadExercised {
        ai: exercised.ai,
        vcu: exercised.vcu,
        states: exercised.states.iter().map(|state| state.name().to_owned()).collect(),
        requirements: exercised.requirements.iter().map(requirement).collect(),
    }
}

/// A line of a log.
#[derive(Clone, Debug)]
enum Line {
    /// A frame, so many microseconds after the one before.
    Frame { after_us: i64, id: u16, data: Vec<u8> },
    /// Something else: quotes, control characters, other alphabets.
    Rubbish(String),
    /// Frames were lost.
    Dropped(u32),
}

fn any_line() -> impl Strategy<Value = Line> {
    let after_us = || prop_oneof![8 => 0..12_000_i64, 1 => 0..2_000_000_i64];
    let frame = |(after_us, message): (i64, AnyMessage)| {
        let frame = Edition::DEFAULT.bus.encode(message).unwrap_or_default();
        Line::Frame { after_us, id: frame.id, data: frame.data().to_vec() }
    };
    // Of the states alone, so that there are transitions and answers to the handshake.
    let status = (after_us(), 1..=5_u8, any::<bool>(), sample::select(vec![0x520, 0x510])).prop_map(
        |(after_us, state, bit, id)| Line::Frame {
            after_us,
            id,
            data: vec![u8::from(bit), 0, if id == 0x520 { state } else { 1 }, 0, 0, 0, 0, 0],
        },
    );
    let ids = AnyMessage::IDS.to_vec();
    let bits =
        (after_us(), prop_oneof![sample::select(ids), 0..0x800_u16], collection::vec(any::<u8>(), 0..=8))
            .prop_map(|(after_us, id, data)| Line::Frame { after_us, id, data });
    prop_oneof![
        8 => status,
        4 => (after_us(), any::<AnyMessage>()).prop_map(frame),
        2 => bits,
        1 => any::<String>().prop_map(Line::Rubbish),
        1 => Just("\"\\\u{1b}[2J\u{2028}\u{fffd}\t".to_owned()).prop_map(Line::Rubbish),
        1 => any::<u32>().prop_map(Line::Dropped),
    ]
}

/// The text of a log.
fn text(lines: &[Line]) -> Vec<u8> {
    let mut text = Vec::new();
    let mut time_us = 1_795_209_995_000_000;
    for line in lines {
        match line {
            Line::Frame { after_us, id, data } => {
                time_us += after_us;
                write_frame(&mut text, time_us * 1000, "can0", (*id).into(), data).expect("a vector");
            }
            Line::Rubbish(rubbish) => writeln!(text, "{rubbish}").expect("a vector"),
            Line::Dropped(count) => {
                writeln!(
                    text,
                    "DROPCOUNT: dropped {count} CAN frames on 'can0' socket (total drops {count})"
                )
                .expect("a vector");
            }
        }
    }
    text
}

/// Runs the command with this on its standard input.
fn adsdv(args: &[&str], input: &[u8]) -> (Option<i32>, String) {
    let mut child = Command::new(env!("CARGO_BIN_EXE_adsdv"))
        .args(args)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .expect("the command starts");
    let mut stdin = child.stdin.take().expect("a pipe");
    let output = thread::scope(|scope| {
        scope.spawn(move || stdin.write_all(input).ok());
        child.wait_with_output().expect("the command ends")
    });
    (output.status.code(), String::from_utf8(output.stdout).expect("text"))
}

/// The schema that the command prints.
static SCHEMA: LazyLock<Validator> = LazyLock::new(|| {
    let (_, schema) = adsdv(&["schema", "check"], b"");
    let schema = serde_json::from_str(&schema).expect("JSON");
    jsonschema::draft202012::new(&schema).expect("a schema that can be used")
});

fn round_trip(lines: &[Line]) -> Result<(), String> {
    let log = text(lines);
    let (status, printed) = adsdv(&["check", "--edition", "3.0", "-", "--json"], &log);
    let report = match judge_log(log.as_slice(), &LogOptions::default(), |_| {}) {
        Ok(report) => report,
        Err(LogError::Read(error)) => return Err(error.to_string()),
        // A log without a frame has no report.
        Err(_) if status == Some(2) && printed.is_empty() => return Ok(()),
        Err(error) => return Err(format!("{error}, but {status:?}: {printed}")),
    };
    let as_value = serde_json::from_str(&printed).map_err(|error| error.to_string())?;
    if let Some(error) = SCHEMA.iter_errors(&as_value).next() {
        return Err(format!("not by the schema: {error}"));
    }
    let read: Read = serde_json::from_str(&printed).map_err(|error| error.to_string())?;
    let expected = expected(&report);
    if read != expected {
        return Err(format!("read {read:#?}\nexpected {expected:#?}"));
    }
    let again = serde_json::to_string(&read).map_err(|error| error.to_string())?;
    if again + "\n" != printed {
        return Err(format!("it is written again otherwise than {printed}"));
    }
    Ok(())
}

#[test]
fn a_report_reads_back() {
    let home = Home {
        package: env!("CARGO_PKG_NAME"),
        test: env!("CARGO_CRATE_NAME"),
        regressions: concat!(env!("CARGO_MANIFEST_DIR"), "/tests/round_trip.regressions"),
    };
    let logs = collection::vec(any_line(), 0..80);
    let printed = |lines: &Vec<Line>| String::from_utf8_lossy(&text(lines)).into_owned();
    home.holds(CASES, &logs, |lines| round_trip(lines), printed);
}
