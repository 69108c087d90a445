//! The questions that a team has after a run, each with its answer and the place that shows it.
//!
//! The judge's own findings and measurements answer where there are any; `requests.rs` follows what was asked of the wheels.

mod ai;
mod answer;
mod circuit;
mod course;

pub(crate) use answer::AnswerJson;

use crate::facts::Facts;

/// All of them, in the order of a team's interest.
pub(crate) fn questions(facts: &Facts<'_>) -> Vec<AnswerJson> {
    let ask = [
        course::stopped,
        course::went,
        course::waited,
        ai::answered,
        ai::reached,
        ai::finished,
        circuit::opened,
        circuit::lost,
        course::straight,
        circuit::mend,
    ];
    ask.iter().map(|ask| ask(facts)).collect()
}
