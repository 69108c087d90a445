//! An answer, and what several of them are made with.

use adsdv_oracle::judge::{Margin, Measure};
use adsdv_spec::messages::Node;
use serde::Serialize;

use crate::facts::Facts;
use crate::mood::Mood;
use crate::time::micros;

/// Within so long the VCU has said what came of something, or says nothing.
pub(super) const SOON_NS: i64 = 100_000_000;
/// So many times tell enough.
pub(super) const SHOWN: usize = 4;

/// A question, its answer, and where to look.
#[derive(Debug, Serialize)]
pub(crate) struct AnswerJson {
    pub(crate) question: &'static str,
    pub(crate) answer: String,
    pub(crate) mood: Mood,
    /// The time to look at, in microseconds, if there is one.
    at: Option<i64>,
    /// The lane or plot to look at.
    show: &'static str,
}

/// An answer to a question.
pub(super) fn answer(
    question: &'static str,
    show: &'static str,
    mood: Mood,
    at_ns: Option<i64>,
    answer: String,
) -> AnswerJson {
    AnswerJson { question, answer, mood, at: at_ns.map(micros), show }
}

/// What the VCU named as the cause of a stop soon after it.
pub(super) fn cause(facts: &Facts<'_>, t_ns: i64) -> Option<String> {
    let found = facts.signal(Node::Vcu, "shutdown_cause");
    let raw = facts.at(found, t_ns.saturating_add(SOON_NS))?;
    let signal = found?.signal;
    (raw != 0).then(|| signal.display(raw).to_string())
}

/// The worst of what was measured.
pub(super) fn margin<'a>(facts: &Facts<'a>, what: Measure) -> Option<&'a Margin> {
    facts.report.margins.iter().find(|margin| margin.what == what)
}
