//! What came of it all.

use adsdv_oracle::requirements::are_decisions;
use adsdv_spec::{Choice, Inputs, Readings};

use super::broken::Break;
use super::own_bit::HANDSHAKE;
use super::requirements::{Outcome, Requirement};
use super::vcu::Reply;
use super::verdict::Follows;
use crate::protocol::{About, Domain, INPUTS, InputField, Shown, Value};
use crate::suite::{Scenario, Step};

/// Whether a program conforms, and all that is known of why and how.
#[derive(Clone, Debug)]
pub struct ConformReport {
    /// How many tests of the suite were run.
    pub tests: usize,
    /// How many of them failed.
    pub failed_tests: usize,
    /// How many of them are only against decisions of ours, and so have not failed.
    pub observed_tests: usize,
    /// How many random scenarios were run.
    pub runs: u32,
    /// How many of them failed.
    pub failed_runs: u32,
    /// How many of them are only against decisions of ours.
    pub observed_runs: u32,
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
    /// What is otherwise than we decided where the document is silent, likewise.
    pub observations: Vec<Failure>,
    /// How many more things are wrong that the report does not list.
    pub more_failures: usize,
    /// The outputs that it never shows.
    pub not_shown: Vec<&'static str>,
    /// The tests that were not run: that steps of its cycle cannot express, need an input that it does not have, or more time than there was.
    pub not_run: Vec<String>,
    /// What else is worth knowing.
    pub notes: Vec<String>,
    /// Whether it answered alike what it was asked again. What is said of a program that does not may be otherwise the next time.
    pub repeats: bool,
    /// The cycle at which it stepped, in milliseconds; `None`: any time passed between two steps.
    pub cycle_ms: Option<u32>,
    /// What the program said of itself.
    pub about: About,
}

impl ConformReport {
    /// Whether one combination of readings explains everything that the document asks for.
    pub fn conforms(&self) -> bool {
        self.failures.is_empty() && self.requirements.iter().all(|one| one.outcome != Outcome::Fail)
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
    /// Whether all of them are decisions of ours, where the document is silent, and that is no failure.
    pub observed: bool,
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

/// Whether all that is broken are decisions of ours. What was not wrong when it was asked for again breaks more than that.
pub(super) fn is_observation(ids: &[String], found: Option<&Break>) -> bool {
    found.is_some() && are_decisions(ids)
}

/// Whether the AI Computer answers the handshake, as a value.
const fn answer(answers: bool) -> Value {
    const WORDS: Domain = Domain::Names(&[(0, "unanswered"), (1, "answered")]);
    Value { domain: WORDS, raw: Some(answers as i32) }
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
    /// The inputs that changed before the first; of the handshake whether the AI Computer answers it.
    pub changes: Vec<(&'static str, Value)>,
    /// The AS_STATE that is expected; `None` before a late program has anything to show.
    pub expected: Option<Value>,
    /// The AS_STATE that the program shows.
    pub actual: Option<Value>,
    /// Whether the answer is wrong.
    pub wrong: bool,
}

impl Failure {
    /// The scenario as what changed, step by step, up to the first wrong answer. Of the handshake it says whether the AI Computer
    /// answers it; so nothing that matters is left out.
    pub fn timeline(&self) -> Vec<Stretch> {
        let usual = Step { dt_ms: 0, inputs: Inputs::default() };
        let late = self.found.as_ref().map_or(0, |found| found.step - found.about.min(found.step));
        let last = self.found.as_ref().map(|found| found.step);
        let mut moments: Vec<Stretch> = Vec::new();
        let mut time_ms = 0;
        let (mut before, mut answered) = (&usual, true);
        for (place, (step, reply)) in self.steps().zip(&self.replies).enumerate() {
            time_ms += u64::from(step.dt_ms);
            let answers = self.answers(place, step);
            let differs = |field: &&InputField| {
                field.key != HANDSHAKE && (field.get)(&step.inputs) != (field.get)(&before.inputs)
            };
            let given =
                INPUTS.iter().filter(differs).map(|field| (field.key, self.input(field, &step.inputs)));
            let turned = (answers != answered).then_some((HANDSHAKE, answer(answers)));
            let changes: Vec<_> = given.chain(turned).collect();
            let expected =
                place.checked_sub(late).and_then(|about| self.expected.get(about)?.get("as_state"));
            let actual = match reply {
                Reply::Answer(answer) => answer.get("as_state"),
                Reply::Nothing => None,
            };
            let wrong = last == Some(place);
            match moments.last_mut() {
                Some(moment)
                    if !wrong
                        && changes.is_empty()
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
            (before, answered) = (step, answers);
            if wrong {
                break;
            }
        }
        moments
    }

    /// Whether the AI Computer answers the handshake in a step: whether its bit is the one that it should have seen last.
    fn answers(&self, place: usize, step: &Step) -> bool {
        // After all steps a late program is asked for the last one again.
        let about = place.min(self.expected.len().saturating_sub(1));
        let seen = about.checked_sub(1).and_then(|before| self.expected.get(before)?.get(HANDSHAKE)?.raw);
        step.inputs.ai.status.handshake == seen.is_some_and(|bit| bit != 0)
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
