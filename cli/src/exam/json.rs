//! What came of it for a program. Its form is described by `schema/exam.schema.json`.

use adsdv_exam::{ExamFinding, ExamReport, Outcome, Sent};
use serde::Serialize;

use super::Examinee;
use crate::json::{SCHEMA, line, seconds};

/// The outcome as one JSON object on one line.
pub(super) fn text(subject: &Examinee<'_>, report: &ExamReport) -> String {
    let names: Vec<&str> = report.scenarios.iter().map(|scenario| scenario.name.as_str()).collect();
    let name = |place: usize| names.get(place).copied().unwrap_or_default();
    let requirements = report.requirements.iter().map(|one| ExamRequirementJson {
        id: one.id,
        section: one.section,
        about: &one.about,
        outcome: one.outcome.name(),
        accepted: match one.outcome {
            Outcome::Fail(_) => subject.verdict.reason(one.id),
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
        stuck: one.stuck.as_deref(),
    });
    line(&ExamJson {
        schema: SCHEMA,
        edition: subject.edition.edition().version,
        program: subject.args.command.iter().map(|word| word.to_string_lossy().into_owned()).collect(),
        scenarios: scenarios.collect(),
        requirements: requirements.collect(),
        findings: report
            .findings
            .iter()
            .enumerate()
            .map(|(place, one)| ExamFindingJson {
                accepted: subject.verdict.accepts(one),
                shortest: subject.shorter.get(&place).map(|shortest| shortest.scenario.to_string()),
                ..ExamFindingJson::of(one, name(one.scenario))
            })
            .collect(),
        slowest_answer_ms: report.slowest.as_ref().and_then(adsdv_oracle::judge::ResponseTimes::max_ms),
        notes: &report.notes,
        unused: subject.verdict.unused(report).into_iter().map(|(id, _)| id).collect(),
        passes: !subject.early && subject.verdict.passes(report),
    })
}

fn ms(ms: u64) -> f64 {
    seconds(i64::try_from(ms.saturating_mul(1_000_000)).unwrap_or(i64::MAX))
}

#[derive(Serialize)]
struct ExamJson<'a> {
    schema: u32,
    edition: &'static str,
    program: Vec<String>,
    scenarios: Vec<ScenarioJson<'a>>,
    requirements: Vec<ExamRequirementJson<'a>>,
    findings: Vec<ExamFindingJson<'a>>,
    slowest_answer_ms: Option<f64>,
    notes: &'a [String],
    unused: Vec<&'a str>,
    passes: bool,
}

#[derive(Serialize)]
struct ScenarioJson<'a> {
    name: &'a str,
    about: &'a str,
    duration: f64,
    frames: usize,
    findings: usize,
    stuck: Option<&'a str>,
}

#[derive(Serialize)]
struct ExamRequirementJson<'a> {
    id: &'a str,
    section: &'a str,
    about: &'a str,
    outcome: &'static str,
    accepted: Option<&'a str>,
    findings: &'a [usize],
    why: Option<&'a String>,
}

#[derive(Serialize)]
struct ExamFindingJson<'a> {
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

impl<'a> ExamFindingJson<'a> {
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
        }
    }
}
