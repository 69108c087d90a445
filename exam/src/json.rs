//! What came of an exam, for a program. Its form is described by `cli/schema/exam.schema.json`.

use adsdv_oracle::judge::ResponseTimes;
use adsdv_spec::Edition;
use serde::Serialize;

use crate::report::{ExamFinding, ExamReport, Outcome};
use crate::session::Sent;
use crate::shrink::Shorter;

/// The number of the form.
const SCHEMA: u32 = 1;

/// What the form says beside the report.
pub struct ExamForm<'a> {
    /// The edition of the interface.
    pub edition: &'static Edition,
    /// The program and its arguments; empty where none was started.
    pub program: Vec<String>,
    /// The shortest scenarios that were found.
    pub shorter: &'a Shorter,
    /// Why a requirement may fail, or why findings of a rule may be there that are against no single one; `None` if they may not.
    pub reason: &'a dyn Fn(&str) -> Option<&'a str>,
    /// What may fail, and does not.
    pub unused: Vec<&'a str>,
    /// The verdict.
    pub passes: bool,
}

impl ExamForm<'_> {
    /// A report as one JSON object on one line.
    pub fn text(&self, report: &ExamReport) -> String {
        let names: Vec<&str> = report.scenarios.iter().map(|scenario| scenario.name.as_str()).collect();
        let name = |place: usize| names.get(place).copied().unwrap_or_default();
        let requirements = report.requirements.iter().map(|one| RequirementJson {
            id: one.id,
            section: one.section,
            about: &one.about,
            outcome: one.outcome.name(),
            accepted: match one.outcome {
                Outcome::Fail(_) => (self.reason)(one.id),
                _ => None,
            },
            findings: match &one.outcome {
                Outcome::Fail(places) => places,
                _ => &[],
            },
            why: match &one.outcome {
                Outcome::NotExercised(why) => Some(why),
                _ => None,
            },
        });
        let scenarios = report.scenarios.iter().map(|one| ScenarioJson {
            name: &one.name,
            about: &one.about,
            duration: ms(one.duration_ms),
            frames: one.frames,
            findings: one.findings,
            exercised: &one.exercised,
            stuck: one.stuck.as_deref(),
        });
        let findings = report.findings.iter().enumerate().map(|(place, one)| FindingJson {
            accepted: one.ids().into_iter().all(|id| (self.reason)(id).is_some()),
            shortest: self.shorter.get(&place).map(|shortest| shortest.scenario.to_string()),
            ..FindingJson::of(one, name(one.scenario))
        });
        let form = ExamJson {
            schema: SCHEMA,
            edition: self.edition.version,
            program: &self.program,
            scenarios: scenarios.collect(),
            requirements: requirements.collect(),
            findings: findings.collect(),
            slowest_answer_ms: report.slowest.as_ref().and_then(ResponseTimes::max_ms),
            notes: &report.notes,
            unused: &self.unused,
            passes: self.passes,
        };
        // Nothing in it has a key that is no text, so that this does not fail.
        let mut text = serde_json::to_string(&form).unwrap_or_default();
        text.push('\n');
        text
    }
}

#[derive(Serialize)]
struct ExamJson<'a> {
    schema: u32,
    edition: &'static str,
    program: &'a [String],
    scenarios: Vec<ScenarioJson<'a>>,
    requirements: Vec<RequirementJson<'a>>,
    findings: Vec<FindingJson<'a>>,
    slowest_answer_ms: Option<f64>,
    notes: &'a [String],
    unused: &'a [&'a str],
    passes: bool,
}

#[derive(Serialize)]
struct ScenarioJson<'a> {
    name: &'a str,
    about: &'a str,
    duration: f64,
    frames: usize,
    findings: usize,
    exercised: &'a [&'static str],
    stuck: Option<&'a str>,
}

#[derive(Serialize)]
struct RequirementJson<'a> {
    id: &'a str,
    section: &'a str,
    about: &'a str,
    outcome: &'static str,
    accepted: Option<&'a str>,
    findings: &'a [usize],
    why: Option<&'a String>,
}

#[derive(Serialize)]
struct FindingJson<'a> {
    scenario: &'a str,
    t: f64,
    section: &'a str,
    rule: &'static str,
    requirements: &'a [&'static str],
    accepted: bool,
    seen: &'a str,
    expected: &'a str,
    operator: Vec<ActionJson<'a>>,
    car: &'a str,
    frames: Vec<FrameJson>,
    shortest: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    trace: Option<&'a str>,
}

#[derive(Serialize)]
struct ActionJson<'a> {
    t: f64,
    did: &'a str,
}

#[derive(Serialize)]
struct FrameJson {
    t: f64,
    by: &'static str,
    frame: String,
}

impl<'a> FindingJson<'a> {
    fn of(finding: &'a ExamFinding, scenario: &'a str) -> Self {
        let frame = |sent: &Sent| FrameJson {
            t: seconds(sent.t_ns),
            by: if sent.by_ai { "AI" } else { "VCU" },
            frame: sent.frame.to_string(),
        };
        Self {
            scenario,
            t: seconds(finding.t_ns),
            section: &finding.section,
            rule: finding.found_by.id(),
            requirements: &finding.requirements,
            accepted: false,
            shortest: None,
            seen: &finding.seen,
            expected: &finding.expected,
            operator: finding.operator.iter().map(|(time, did)| ActionJson { t: ms(*time), did }).collect(),
            car: &finding.car,
            frames: finding.frames.iter().map(frame).collect(),
            trace: finding.trace.as_deref(),
        }
    }
}

fn ms(ms: u64) -> f64 {
    seconds(i64::try_from(ms.saturating_mul(1_000_000)).unwrap_or(i64::MAX))
}

/// Nanoseconds as seconds, rounded to whole microseconds, which is what candump writes.
#[expect(clippy::cast_precision_loss, reason = "285 years of microseconds fit")]
fn seconds(ns: i64) -> f64 {
    ns.saturating_add(500).div_euclid(1000) as f64 / 1e6
}
