//! The suite as JSON Lines: one test a line, for any language. `suite.schema.json` of the command says what a line has.

use std::borrow::Cow;
use std::collections::HashSet;
use std::fmt::{self, Write as _};
use std::io::{self, BufRead};
use std::sync::OnceLock;

use adsdv_spec::{Edition, Machine, Reading};
use serde::Deserialize;

use super::steps::{self, RawStep};
use super::{Kind, Test, untested};
use crate::protocol::{InputsAsJson, Protocol, UNSAID};

/// The number of the form that a line has. A line that says another one is not read; one that says none has this form, or is not
/// read for what else is wrong with it.
pub const SCHEMA: u32 = 1;

impl Test {
    /// The test as a line, without the end of the line; what is expected is what the machine shows.
    pub fn to_line(&self, machine: &Machine) -> String {
        let mut line = String::new();
        let protocol = Protocol::of(machine.edition());
        let text = |text: &str| serde_json::Value::from(text).to_string();
        let requirements: Vec<String> = self.requirements.iter().map(|id| text(id)).collect();
        let reading = self.reading.map_or_else(|| "null".to_owned(), |reading| text(reading.id()));
        // Writing to a string does not fail.
        let _ = write!(
            line,
            "{{\"schema\":{SCHEMA},\"edition\":{},\"name\":{},\"kind\":{},\"about\":{},\"section\":{},\"requirements\":[{}],\"reading\":{reading},\"steps\":[",
            text(machine.edition().version),
            text(&self.name),
            text(self.kind.name()),
            text(&self.about),
            text(&self.section),
            requirements.join(","),
        );
        let shown = self.scenario.shown(machine);
        for (place, (step, expected)) in self.scenario.steps.iter().zip(shown).enumerate() {
            let comma = if place == 0 { "" } else { "," };
            let inputs = InputsAsJson(step.inputs);
            let _ = write!(
                line,
                "{comma}{{\"dt_ms\":{},\"inputs\":{},\"expected\":{expected}}}",
                step.dt_ms,
                protocol.object(&inputs),
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

/// The longest line that is read, in bytes: a test of thousands of steps. A longer one is passed over, and reported; without a limit,
/// a file without line ends would fill the memory.
pub const MAX_LINE: usize = 4 << 20;

/// So many lines that are no tests are reported in full; the others are counted.
pub const MAX_BAD: usize = 1000;

/// So many steps all tests have together at most: repeated steps are short to write.
pub const MAX_STEPS: usize = 1_000_000;

/// A suite as it was read: every line that is a test, and what is wrong with the others.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ReadSuite {
    /// The tests, in order.
    pub tests: Vec<Test>,
    /// The first lines that are none, at most [`MAX_BAD`].
    pub bad: Vec<BadTest>,
    /// How many more lines are none.
    pub more_bad: u64,
}

impl ReadSuite {
    fn is_bad(&mut self, line: u64, why: String) {
        if self.bad.len() < MAX_BAD {
            self.bad.push(BadTest { line, why });
        } else {
            self.more_bad += 1;
        }
    }
}

/// Reads a suite. A line that is no test does not keep the others from being read; empty lines are passed over.
///
/// What a step expects, if it says that, has to be what the machine shows, or part of it, `as_state` at least: a suite is judged by
/// the specification, under every reading, and not by what a file says. A line is of the machine's edition: one that says none
/// is of [`UNSAID`]. A test names requirements that there are: those of the tests that [`generate`](super::generate) makes, and
/// those that [`untested`](super::untested) has.
///
/// Who writes a test by hand needs steps and nothing else:
///
/// ```
/// use adsdv_conform::suite;
/// use adsdv_spec::Machine;
///
/// let line = r#"{"steps":[{"dt_ms":10,"inputs":{"tsms":true}},{"dt_ms":10,"times":100,"answers":true,"inputs":{"tsms":true}}]}"#;
/// let read = suite::read(line.as_bytes(), &Machine::REFERENCE)?;
/// assert_eq!((read.tests[0].name.as_str(), read.tests[0].scenario.steps.len()), ("line 1", 101));
/// # Ok::<(), std::io::Error>(())
/// ```
///
/// # Errors
///
/// Fails where the reader does. Bytes that are no UTF-8 are a line that is no test.
pub fn read(mut reader: impl BufRead, machine: &Machine) -> io::Result<ReadSuite> {
    let mut suite = ReadSuite::default();
    let requirements = requirements(machine.edition());
    let mut names = HashSet::new();
    let (mut bytes, mut steps) = (Vec::new(), 0);
    for line in 1.. {
        match next_line(&mut reader, &mut bytes)? {
            End::Suite => break,
            End::TooLong => {
                suite.is_bad(
                    line,
                    format!("is longer than {MAX_LINE} bytes; expected a test as one JSON object"),
                );
                continue;
            }
            End::Line => {}
        }
        match read_line(line, &bytes, machine, &requirements) {
            Ok(Some(test)) if steps + test.scenario.steps.len() > MAX_STEPS => {
                suite.is_bad(
                    line,
                    format!(
                        "{} steps are too many; expected at most {MAX_STEPS} in all tests",
                        test.scenario.steps.len()
                    ),
                );
            }
            Ok(Some(test)) if names.contains(&test.name) => {
                suite.is_bad(
                    line,
                    format!("the name {:?} is there already; expected one of its own", test.name),
                );
            }
            Ok(Some(test)) => {
                steps += test.scenario.steps.len();
                names.insert(test.name.clone());
                suite.tests.push(test);
            }
            Ok(None) => {}
            Err(why) => suite.is_bad(line, why),
        }
    }
    Ok(suite)
}

/// What came when a line was asked for.
enum End {
    /// Nothing: the suite is over.
    Suite,
    /// A line, all of it.
    Line,
    /// The beginning of a line of more than [`MAX_LINE`] bytes, which has been read to its end.
    TooLong,
}

/// Reads the next line, with its line feed.
fn next_line(reader: &mut impl BufRead, bytes: &mut Vec<u8>) -> io::Result<End> {
    bytes.clear();
    let mut end = End::Suite;
    loop {
        let buffer = match reader.fill_buf() {
            Ok(buffer) => buffer,
            Err(error) if error.kind() == io::ErrorKind::Interrupted => continue,
            Err(error) => return Err(error),
        };
        if buffer.is_empty() {
            return Ok(end);
        }
        let feed = memchr::memchr(b'\n', buffer);
        let piece = feed.and_then(|feed| buffer.get(..=feed)).unwrap_or(buffer);
        if matches!(end, End::TooLong) || bytes.len() + piece.len() > MAX_LINE {
            end = End::TooLong;
        } else {
            bytes.extend_from_slice(piece);
            end = End::Line;
        }
        let used = piece.len();
        reader.consume(used);
        if feed.is_some() {
            return Ok(end);
        }
    }
}

/// A line before it is looked at. A test needs steps; all else can be left out by who writes one by hand.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct TestLine<'a> {
    #[serde(default)]
    schema: Option<u32>,
    #[serde(default)]
    edition: Option<String>,
    #[serde(default)]
    name: Option<String>,
    #[serde(default)]
    kind: Option<String>,
    #[serde(default)]
    about: String,
    #[serde(default)]
    section: String,
    #[serde(default)]
    requirements: Vec<String>,
    #[serde(default)]
    reading: Option<String>,
    #[serde(borrow)]
    steps: Vec<RawStep<'a>>,
}

/// The identifiers of all requirements that there are.
fn requirements(edition: &Edition) -> Cow<'static, HashSet<String>> {
    // Making all tests takes longer than reading most suites.
    static OF_EDITIONS: [OnceLock<HashSet<String>>; Edition::ALL.len()] =
        [const { OnceLock::new() }; Edition::ALL.len()];
    let known = Edition::ALL.iter().zip(&OF_EDITIONS).find(|(known, _)| **known == edition);
    match known {
        Some((_, found)) => Cow::Borrowed(found.get_or_init(|| requirements_of(edition))),
        None => Cow::Owned(requirements_of(edition)),
    }
}

fn requirements_of(edition: &Edition) -> HashSet<String> {
    let tested = super::generate(edition).into_iter().flat_map(|test| test.requirements);
    tested.chain(untested(edition).map(|untested| untested.id)).collect()
}

/// The same without control characters: a key that is rubbish does not reach a terminal.
fn printable(text: &str) -> String {
    text.chars()
        .map(|c| if c.is_control() { c.escape_default().to_string() } else { c.to_string() })
        .collect()
}

fn read_line(
    number: u64,
    bytes: &[u8],
    machine: &Machine,
    requirements: &HashSet<String>,
) -> Result<Option<Test>, String> {
    let line = std::str::from_utf8(bytes)
        .map_err(|_| "is not UTF-8; expected a test as one JSON object".to_owned())?;
    let line = line.trim();
    if line.is_empty() {
        return Ok(None);
    }
    let line: TestLine<'_> = serde_json::from_str(line).map_err(|error| {
        // The place in the line, without a line number of its own.
        let error = printable(&error.to_string().replace("line 1 column", "column"));
        format!("{error}; expected a test as one JSON object")
    })?;
    if let Some(schema) = line.schema.filter(|&schema| schema != SCHEMA) {
        return Err(format!(
            "\"schema\" is {schema}; expected {SCHEMA}, which is the form that this program reads"
        ));
    }
    let (said, asked) = (line.edition.as_deref().unwrap_or(UNSAID.version), machine.edition().version);
    if said != asked {
        return Err(format!("\"edition\" is {said:?}; expected {asked:?}, the edition that was asked for"));
    }
    if line.name.as_deref() == Some("") {
        return Err("\"name\" is empty; expected a name of its own, or none".to_owned());
    }
    let kind = |name: &str| {
        Kind::ALL.into_iter().find(|kind| kind.name() == name).ok_or_else(|| {
            let names = Kind::ALL.map(Kind::name).join(", ");
            format!("\"kind\" is {name:?}; expected one of {names}")
        })
    };
    let kind = line.kind.as_deref().map_or(Ok(Kind::Written), kind)?;
    if line.steps.is_empty() {
        return Err("\"steps\" is empty; expected at least one step".to_owned());
    }
    if let Some(id) = line.requirements.iter().find(|&id| !requirements.contains(id)) {
        return Err(format!(
            "\"requirements\" has {id:?}, which there is not; expected identifiers of spec/REQUIREMENTS.md such as \"HS-9\""
        ));
    }
    let reading = line
        .reading
        .as_deref()
        .map(|id| id.parse::<Reading>().map_err(|error| format!("\"reading\" is {id:?}: {error}")));
    let scenario = steps::read(&line.steps, machine)?;
    Ok(Some(Test {
        name: line.name.unwrap_or_else(|| format!("line {number}")),
        kind,
        about: line.about,
        section: line.section,
        requirements: line.requirements,
        reading: reading.transpose()?,
        scenario,
    }))
}
