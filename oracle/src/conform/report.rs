//! What came of it all.

use adsdv_spec::{Choice, Inputs, Readings};

use super::broken::Break;
use super::requirements::Requirement;
use super::vcu::Reply;
use super::verdict::Follows;
use crate::protocol::{INPUTS, InputField, Shown, Value};
use crate::suite::{Scenario, Step};

/// Whether a program conforms, and all that is known of why and how.
#[derive(Clone, Debug)]
pub struct ConformReport {
    /// How many tests of the suite were run.
    pub tests: usize,
    /// How many of them failed.
    pub failed_tests: usize,
    /// How many random scenarios were run.
    pub runs: u32,
    /// How many of them failed.
    pub failed_runs: u32,
    /// How many steps the program has made in them.
    pub steps: u64,
    /// How many steps late its outputs are.
    pub late: usize,
    /// The combination of readings that it was judged by in the end: one that explains the most tests.
    pub readings: Readings,
    /// What is known of how it answers each question that the document leaves open.
    pub follows: Vec<Follows>,
    /// What was passed, failed and not checked.
    pub requirements: Vec<Requirement>,
    /// How many requirements are about what a VCU does; the rest of them is about what no output of the protocol shows.
    pub about_the_vcu: usize,
    /// What failed, one for each thing that is wrong.
    pub failures: Vec<Failure>,
    /// How many more things are wrong that are not told.
    pub more_failures: usize,
    /// The outputs that it never shows.
    pub not_shown: Vec<&'static str>,
    /// The tests that cannot be told at its cycle.
    pub not_told: Vec<String>,
    /// What else is worth knowing.
    pub notes: Vec<String>,
}

impl ConformReport {
    /// Whether one combination of readings explains everything.
    pub fn conforms(&self) -> bool {
        self.failures.is_empty()
    }
}

/// Something that is wrong.
#[derive(Clone, Debug)]
pub struct Failure {
    /// The test that shows it, or the random scenario.
    pub name: String,
    /// What that test checks; empty for a random scenario.
    pub about: String,
    /// The requirements that it breaks.
    pub requirements: Vec<String>,
    /// The other tests that fail for the same reason.
    pub also: Vec<String>,
    /// The choices that would explain this test, if it is only that the readings are mixed.
    pub explained_by: Vec<Choice>,
    /// The shortest scenario that was found.
    pub scenario: Scenario,
    /// The answers to its steps.
    pub replies: Vec<Reply>,
    /// What was expected of them.
    pub expected: Vec<Shown>,
    /// The first wrong answer; `None` if there was none when the test was asked for again.
    pub found: Option<Break>,
}

/// Steps of a failing scenario that are alike, or one step.
#[derive(Clone, Debug, PartialEq)]
pub struct Stretch {
    /// The first of them, from 1.
    pub first: usize,
    /// The last of them.
    pub last: usize,
    /// The time of the last since power-on, in milliseconds.
    pub time_ms: u64,
    /// The inputs that changed before the first.
    pub changes: Vec<(&'static str, Value)>,
    /// The AS_STATE that is expected; `None` before a late program has anything to show.
    pub expected: Option<Value>,
    /// The AS_STATE that the program shows.
    pub actual: Option<Value>,
    /// Whether the answer is wrong.
    pub wrong: bool,
}

impl Failure {
    /// The scenario as what changed, step by step, up to the first wrong answer.
    pub fn timeline(&self) -> Vec<Stretch> {
        let usual = Step { dt_ms: 0, inputs: Inputs::default() };
        let late = self.found.as_ref().map_or(0, |found| found.step - found.about.min(found.step));
        let last = self.found.as_ref().map(|found| found.step);
        let mut moments: Vec<Stretch> = Vec::new();
        let mut time_ms = 0;
        let (mut before, mut handshake_only) = (&usual, 0);
        for (place, (step, reply)) in self.steps().zip(&self.replies).enumerate() {
            time_ms += u64::from(step.dt_ms);
            let differs = |field: &&InputField| (field.get)(&step.inputs) != (field.get)(&before.inputs);
            let changes: Vec<_> = INPUTS
                .iter()
                .filter(differs)
                .map(|field| (field.key, self.input(field, &step.inputs)))
                .collect();
            let expected =
                place.checked_sub(late).and_then(|about| self.expected.get(about)?.get("as_state"));
            let actual = match reply {
                Reply::Answer(answer) => answer.get("as_state"),
                Reply::Nothing => None,
            };
            let wrong = last == Some(place);
            let alternates = changes.iter().all(|(key, _)| *key == "handshake");
            handshake_only = if alternates { handshake_only + 1 } else { 0 };
            match moments.last_mut() {
                // A handshake that goes on and on is told once.
                Some(moment)
                    if !wrong
                        && (changes.is_empty() || handshake_only > 2)
                        && step.dt_ms == before.dt_ms
                        && (moment.expected, moment.actual) == (expected, actual) =>
                {
                    (moment.last, moment.time_ms) = (place + 1, time_ms);
                }
                _ => moments.push(Stretch {
                    first: place + 1,
                    last: place + 1,
                    time_ms,
                    changes,
                    expected,
                    actual,
                    wrong,
                }),
            }
            before = step;
            if wrong {
                break;
            }
        }
        moments
    }

    /// A value of an input, in the words of what was expected.
    fn input(&self, field: &InputField, inputs: &Inputs) -> Value {
        match self.expected.first() {
            Some(shown) => shown.input(field, inputs),
            None => Value { domain: field.domain, raw: Some((field.get)(inputs)) },
        }
    }

    /// The steps as they were asked for: a late program is asked for its last step until it has answered all.
    fn steps(&self) -> impl Iterator<Item = &Step> {
        let steps = &self.scenario.steps;
        steps.iter().chain(std::iter::repeat(steps.last()).flatten())
    }
}
