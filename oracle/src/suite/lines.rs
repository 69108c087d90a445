//! The suite as JSON Lines: one test a line, for any language. `suite.schema.json` of the command says what a line has.

use std::fmt::{self, Write as _};
use std::io::BufRead;

use adsdv_spec::{Machine, Reading};
use serde::Deserialize;
use serde_json::value::RawValue;

use super::{Kind, Scenario, Step, Test};
use crate::protocol::{Answer, BadLine, Told};

impl Test {
    /// The test as a line, without the end of the line; what is expected is what the machine shows.
    pub fn to_line(&self, machine: &Machine) -> String {
        let mut line = String::new();
        let text = |text: &str| serde_json::Value::from(text).to_string();
        let requirements: Vec<String> = self.requirements.iter().map(|id| text(id)).collect();
        let reading = self.reading.map_or_else(|| "null".to_owned(), |reading| text(reading.id()));
        // Writing to a string does not fail.
        let _ = write!(
            line,
            "{{\"name\":{},\"kind\":{},\"about\":{},\"section\":{},\"requirements\":[{}],\"reading\":{reading},\"steps\":[",
            text(&self.name),
            text(self.kind.name()),
            text(&self.about),
            text(&self.section),
            requirements.join(","),
        );
        let shown = self.scenario.shown(machine);
        for (place, (step, expected)) in self.scenario.steps.iter().zip(shown).enumerate() {
            let comma = if place == 0 { "" } else { "," };
            let inputs = Told(step.inputs);
            let _ = write!(
                line,
                "{comma}{{\"dt_ms\":{},\"inputs\":{inputs},\"expected\":{expected}}}",
                step.dt_ms
            );
        }
        line.push_str("]}");
        line
    }
}

/// Why a line of a suite is no test of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BadTest {
    /// The number of the line, from 1.
    pub line: u64,
    /// What is wrong with it: what was found, and what was expected.
    pub why: String,
}

impl fmt::Display for BadTest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "line {}: {}", self.line, self.why)
    }
}

impl std::error::Error for BadTest {}

/// A suite as it was read: every line that is a test, and what is wrong with the others.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ReadSuite {
    /// The tests, in order.
    pub tests: Vec<Test>,
    /// The lines that are none.
    pub bad: Vec<BadTest>,
}

/// Reads a suite. A line that is no test does not keep the others from being read; empty lines are passed over.
///
/// What a step expects may be part of what it shows, and has to be what the machine shows: a suite is judged by the
/// specification, under every reading, and not by what a file says.
///
/// Errors: what the reader's own errors are. Bytes that are no UTF-8 are a line that is none.
pub fn read(mut reader: impl BufRead, machine: &Machine) -> std::io::Result<ReadSuite> {
    let mut suite = ReadSuite::default();
    let mut bytes = Vec::new();
    for line in 1.. {
        bytes.clear();
        if reader.read_until(b'\n', &mut bytes)? == 0 {
            break;
        }
        match read_line(&bytes, machine) {
            Ok(Some(test)) => match suite.tests.iter().find(|other| other.name == test.name) {
                Some(_) => suite.bad.push(BadTest {
                    line,
                    why: format!("the name {:?} is there already; expected one of its own", test.name),
                }),
                None => suite.tests.push(test),
            },
            Ok(None) => {}
            Err(why) => suite.bad.push(BadTest { line, why }),
        }
    }
    Ok(suite)
}

/// A line before it is looked at.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Line<'a> {
    name: String,
    kind: String,
    about: String,
    section: String,
    requirements: Vec<String>,
    #[serde(default)]
    reading: Option<String>,
    #[serde(borrow)]
    steps: Vec<RawStep<'a>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawStep<'a> {
    dt_ms: u32,
    #[serde(borrow)]
    inputs: &'a RawValue,
    #[serde(borrow, default)]
    expected: Option<&'a RawValue>,
}

/// Whether a text has the form of a requirement's identifier, such as `HS-9`.
fn is_identifier(id: &str) -> bool {
    id.split_once('-').is_some_and(|(prefix, number)| {
        !prefix.is_empty()
            && prefix.chars().all(|c| c.is_ascii_uppercase())
            && !number.is_empty()
            && number.chars().all(|c| c.is_ascii_digit())
    })
}

fn read_line(bytes: &[u8], machine: &Machine) -> Result<Option<Test>, String> {
    let line = std::str::from_utf8(bytes)
        .map_err(|_| "is not UTF-8; expected a test as one JSON object".to_owned())?;
    let line = line.trim();
    if line.is_empty() {
        return Ok(None);
    }
    let line: Line<'_> = serde_json::from_str(line).map_err(|error| {
        // The place in the line, without a line number of its own.
        let error = error.to_string().replace("line 1 column", "column");
        format!("{error}; expected a test as one JSON object")
    })?;
    let kind = Kind::ALL.into_iter().find(|kind| kind.name() == line.kind).ok_or_else(|| {
        let names = Kind::ALL.map(Kind::name).join(", ");
        format!("\"kind\" is {:?}; expected one of {names}", line.kind)
    })?;
    if line.steps.is_empty() {
        return Err("\"steps\" is empty; expected at least one step".to_owned());
    }
    if let Some(id) = line.requirements.iter().find(|id| !is_identifier(id)) {
        return Err(format!("\"requirements\" has {id:?}; expected identifiers such as \"HS-9\""));
    }
    let reading = line
        .reading
        .as_deref()
        .map(|id| id.parse::<Reading>().map_err(|error| format!("\"reading\" is {id:?}: {error}")));
    let mut scenario = Scenario::default();
    let mut answers = Vec::new();
    for (number, step) in (1..).zip(&line.steps) {
        let at = |error: BadLine| format!("step {number}: {error}");
        let Told(inputs) = step.inputs.get().parse().map_err(at)?;
        scenario.steps.push(Step { dt_ms: step.dt_ms, inputs });
        answers.push(step.expected.map(|expected| expected.get().parse::<Answer>().map_err(at)).transpose()?);
    }
    for (number, (answer, shown)) in (1..).zip(answers.iter().zip(scenario.shown(machine))) {
        if let Some(difference) = answer.as_ref().and_then(|answer| answer.differences(&shown).next()) {
            return Err(format!("step {number}: {difference}, which is what the specification shows"));
        }
    }
    Ok(Some(Test {
        name: line.name,
        kind,
        about: line.about,
        section: line.section,
        requirements: line.requirements,
        reading: reading.transpose()?,
        scenario,
    }))
}
