//! The questions that an edition leaves open: raised, settled, or with other answers.

use adsdv_spec::{Edition, Reading};
use serde::Serialize;

/// The questions of which the editions say different things.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub(super) struct Questions {
    /// Open now, and not before.
    pub(super) new: Vec<Question>,
    /// Open before, and not any more.
    pub(super) settled: Vec<Question>,
    /// As open as before, with other answers, or another that holds by default.
    pub(super) changed: Vec<Question>,
}

/// A question, and its answers before and after.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct Question {
    pub(super) id: &'static str,
    #[serde(rename = "question")]
    pub(super) words: &'static str,
    pub(super) from: Answers,
    pub(super) to: Answers,
}

/// The answers to a question in an edition.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct Answers {
    /// The possible ones; where there is one only, the question is settled.
    pub(super) choices: Vec<&'static str>,
    /// The one that holds where nobody gives another.
    pub(super) default: &'static str,
}

impl Answers {
    fn of(edition: &Edition, reading: Reading) -> Self {
        Self {
            choices: edition.choices.of_reading(reading).map(adsdv_spec::Choice::id).collect(),
            default: edition.readings.choice(reading).id(),
        }
    }

    fn are_open(&self) -> bool {
        self.choices.len() > 1
    }
}

impl Questions {
    pub(super) fn is_empty(&self) -> bool {
        self.new.is_empty() && self.settled.is_empty() && self.changed.is_empty()
    }
}

/// The questions of which the editions say different things.
pub(super) fn compare(from: &Edition, to: &Edition) -> Questions {
    let mut questions = Questions::default();
    for &reading in Reading::ALL {
        let (from, to) = (Answers::of(from, reading), Answers::of(to, reading));
        if from == to {
            continue;
        }
        let list = match (from.are_open(), to.are_open()) {
            (false, true) => &mut questions.new,
            (true, false) => &mut questions.settled,
            _ => &mut questions.changed,
        };
        list.push(Question { id: reading.id(), words: reading.question(), from, to });
    }
    questions
}
