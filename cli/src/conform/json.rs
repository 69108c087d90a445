//! What came of it for a program. Its form is described by `schema/conform.schema.json`.

use std::collections::BTreeMap;

use adsdv_conform::protocol::{Domain, INPUTS, Protocol, SHOWN, Shown, Value};
use adsdv_conform::suite::Step;
use adsdv_conform::{Break, ConformReport, Failure, Follows, Reply};
use adsdv_spec::{Choice, Inputs, Readings};
use serde::Serialize;
use serde_json::{Map, Value as Json};

use super::JudgedProgram;
use super::diagnosis::DiagnosedProgram;
use super::diagnosis::json::DiagnosisJson;
use crate::json::{SCHEMA, line};

/// The outcome as one JSON object on one line.
pub(super) fn text(subject: &JudgedProgram<'_>, report: &ConformReport) -> String {
    let protocol = Protocol::of(subject.edition.edition());
    let readings = subject.diagnosis.as_ref().map_or(report.readings, DiagnosedProgram::readings);
    line(&ConformJson {
        schema: SCHEMA,
        edition: subject.edition.edition().version,
        program: subject.args.command.iter().map(|word| word.to_string_lossy().into_owned()).collect(),
        tests: report.tests,
        failed_tests: report.failed_tests,
        observed_tests: report.observed_tests,
        runs: report.runs,
        failed_runs: report.failed_runs,
        observed_runs: report.observed_runs,
        strict: subject.args.strict,
        seed: subject.args.seed,
        steps: report.steps,
        latency: report.late,
        cycle_ms: report.cycle_ms,
        wall_clock: report.about.wall_clock,
        repeats: report.repeats,
        requirements: report
            .requirements
            .iter()
            .map(|requirement| ConformRequirementJson {
                id: &requirement.id,
                outcome: requirement.outcome.name(),
                tests: requirement.tests,
                checked: requirement.checked,
                failed: &requirement.failed,
            })
            .collect(),
        about_the_vcu: report.about_the_vcu,
        failures: report.failures.iter().map(|failure| FailureJson::of(&protocol, failure)).collect(),
        more_failures: report.more_failures,
        observations: report.observations.iter().map(|failure| FailureJson::of(&protocol, failure)).collect(),
        readings: report
            .follows
            .iter()
            .map(|Follows { reading, .. }| (reading.id(), readings.choice(*reading).id()))
            .collect(),
        follows: report.follows.iter().map(|follows| FollowsJson::of(subject, follows, readings)).collect(),
        not_shown: &report.not_shown,
        not_run: &report.not_run,
        notes: &report.notes,
        diagnosis: subject.diagnosis.as_ref().map(DiagnosisJson::from),
        conforms: subject.conforms,
    })
}

#[derive(Serialize)]
struct ConformJson<'a> {
    schema: u32,
    edition: &'static str,
    program: Vec<String>,
    tests: usize,
    failed_tests: usize,
    observed_tests: usize,
    runs: u32,
    failed_runs: u32,
    observed_runs: u32,
    strict: bool,
    seed: u64,
    steps: u64,
    latency: usize,
    cycle_ms: Option<u32>,
    wall_clock: bool,
    repeats: bool,
    requirements: Vec<ConformRequirementJson<'a>>,
    about_the_vcu: usize,
    failures: Vec<FailureJson<'a>>,
    more_failures: usize,
    observations: Vec<FailureJson<'a>>,
    readings: BTreeMap<&'static str, &'static str>,
    follows: Vec<FollowsJson<'a>>,
    not_shown: &'a [&'static str],
    /// The key is older than the name.
    #[serde(rename = "not_told")]
    not_run: &'a [String],
    notes: &'a [String],
    diagnosis: Option<DiagnosisJson<'a>>,
    conforms: bool,
}

#[derive(Serialize)]
struct ConformRequirementJson<'a> {
    id: &'a str,
    outcome: &'static str,
    tests: usize,
    checked: usize,
    failed: &'a [String],
}

#[derive(Serialize)]
struct FailureJson<'a> {
    name: &'a str,
    about: &'a str,
    requirements: &'a [String],
    also: &'a [String],
    explained_by: Vec<String>,
    why: Option<String>,
    row: Option<RowJson<'a>>,
    differences: Vec<DifferenceJson>,
    steps: Vec<StepJson>,
}

#[derive(Serialize)]
struct RowJson<'a> {
    from: &'static str,
    to: &'static str,
    section: &'static str,
    guard: &'a [String],
}

#[derive(Serialize)]
struct DifferenceJson {
    key: &'static str,
    found: Json,
    expected: Json,
}

#[derive(Serialize)]
struct StepJson {
    dt_ms: u32,
    inputs: Map<String, Json>,
    expected: Map<String, Json>,
    actual: Map<String, Json>,
}

#[derive(Serialize)]
struct FollowsJson<'a> {
    reading: &'static str,
    possible: Vec<&'static str>,
    mixes: Vec<SideJson<'a>>,
}

#[derive(Serialize)]
struct SideJson<'a> {
    choice: &'static str,
    tests: &'a [String],
}

impl<'a> FailureJson<'a> {
    fn of(protocol: &Protocol, failure: &'a Failure) -> Self {
        let found = failure.found.as_ref();
        let steps = failure.scenario.steps.iter().zip(&failure.expected).zip(&failure.replies);
        Self {
            name: &failure.name,
            about: &failure.about,
            requirements: &failure.requirements,
            also: &failure.also,
            explained_by: failure.explained_by.iter().map(ToString::to_string).collect(),
            why: found.map(|found| found.why.to_string()),
            row: found.and_then(|found| found.why.row()).map(|row| RowJson {
                from: row.from.name(),
                to: row.to.name(),
                section: row.section,
                guard: &row.guard,
            }),
            differences: found.map(differences).unwrap_or_default(),
            steps: steps
                .map(|((step, expected), reply)| StepJson::of(protocol, step, expected, reply))
                .collect(),
        }
    }
}

fn differences(found: &Break) -> Vec<DifferenceJson> {
    let one = |difference: &adsdv_conform::protocol::Difference| DifferenceJson {
        key: difference.key,
        found: json(difference.found),
        expected: json(difference.expected),
    };
    found.differences.iter().map(one).collect()
}

impl StepJson {
    fn of(protocol: &Protocol, step: &Step, expected: &Shown, reply: &Reply) -> Self {
        let usual = Inputs::default();
        let given = INPUTS.iter().filter(|field| (field.get)(&step.inputs) != (field.get)(&usual));
        let inputs = given.map(|field| (field.key.to_owned(), json(protocol.input(field, &step.inputs))));
        let actual = SHOWN.iter().filter_map(|field| match reply {
            Reply::Answer(answer) => Some((field.key.to_owned(), json(answer.get(field.key)?))),
            Reply::Nothing => None,
        });
        Self {
            dt_ms: step.dt_ms,
            inputs: inputs.collect(),
            expected: expected.iter().map(|(field, value)| (field.key.to_owned(), json(value))).collect(),
            actual: actual.collect(),
        }
    }
}

impl<'a> FollowsJson<'a> {
    /// What the tests speak for, and what explains them by deviations.
    fn of(subject: &JudgedProgram<'_>, follows: &'a Follows, readings: Readings) -> Self {
        let choices = subject.edition.edition().choices;
        let unclear = subject.diagnosis.as_ref().is_some_and(|program| program.is_unclear(follows.reading));
        // What is not known may be any.
        let open = follows.reading.choices().iter().copied().filter(|choice| choices.has(*choice));
        let open = open.filter(|choice| unclear && !follows.possible.contains(choice));
        let other =
            Some(readings.choice(follows.reading)).filter(|choice| !follows.possible.contains(choice));
        let other = other.filter(|_| !follows.possible.is_empty() && !unclear);
        Self {
            reading: follows.reading.id(),
            possible: follows.possible.iter().copied().chain(other).chain(open).map(Choice::id).collect(),
            mixes: follows
                .mixes
                .iter()
                .map(|side| SideJson { choice: side.choice.id(), tests: &side.tests })
                .collect(),
        }
    }
}

/// A value as the protocol has it.
fn json(value: Value) -> Json {
    match (value.domain, value.raw) {
        (_, None) => Json::Null,
        (Domain::Flag, Some(raw)) => (raw != 0).into(),
        // A number that has no name is a number.
        (Domain::Names(_), Some(raw)) if value.to_string() != raw.to_string() => value.to_string().into(),
        (Domain::Names(_) | Domain::Number { .. }, Some(raw)) => raw.into(),
    }
}
