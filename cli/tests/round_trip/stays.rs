//! The states that the VCU was in, and what blocked their arrows.

use adsdv_oracle::judge::JudgeOptions;
use adsdv_oracle::why::{Blocked, Condition, GoPress, Stay, Untaken};
use adsdv_spec::{AsState, Atom, Rules};
use serde::{Deserialize, Serialize};

use super::seconds;

#[derive(Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ReadStay {
    state: String,
    since: f64,
    until: f64,
    left_to: Option<String>,
    arrows: Vec<ReadArrow>,
}

#[derive(Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct ReadArrow {
    to: String,
    section: String,
    requirements: Vec<String>,
    blocked: Vec<ReadBlocked>,
    not_listed: u64,
}

#[derive(Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct ReadBlocked {
    since: f64,
    until: f64,
    failed: Vec<ReadCondition>,
    unknown: Vec<ReadCondition>,
    holding: Vec<String>,
}

#[derive(Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct ReadCondition {
    condition: String,
    needs: String,
    seen: Option<String>,
    whose: String,
    message: Option<String>,
}

#[derive(Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ReadPress {
    t: f64,
    ready_for: f64,
    why: String,
}

fn rules() -> Rules {
    JudgeOptions::default().edition.rules
}

pub(crate) fn expected(stay: &Stay) -> ReadStay {
    ReadStay {
        state: stay.state.name().to_owned(),
        since: seconds(stay.since_ns),
        until: seconds(stay.until_ns),
        left_to: stay.left_to.map(AsState::name).map(str::to_owned),
        arrows: stay.arrows.iter().map(arrow).collect(),
    }
}

fn arrow(arrow: &Untaken) -> ReadArrow {
    ReadArrow {
        to: arrow.to.name().to_owned(),
        section: arrow.section.to_owned(),
        requirements: arrow.requirements.iter().map(|&id| id.to_owned()).collect(),
        blocked: arrow.blocked.iter().map(blocked).collect(),
        not_listed: arrow.more,
    }
}

fn blocked(blocked: &Blocked) -> ReadBlocked {
    ReadBlocked {
        since: seconds(blocked.since_ns),
        until: seconds(blocked.until_ns),
        failed: blocked.failed.iter().map(condition).collect(),
        unknown: blocked.unknown.iter().map(unknown).collect(),
        holding: blocked.holding.iter().map(Atom::id).map(str::to_owned).collect(),
    }
}

/// Of what is not known, something may have been seen or not.
fn unknown(one: &Condition) -> ReadCondition {
    let seen = (!one.values.is_empty()).then(|| one.seen(&rules()));
    ReadCondition { seen, ..condition(one) }
}

fn condition(condition: &Condition) -> ReadCondition {
    ReadCondition {
        condition: condition.atom.id().to_owned(),
        needs: condition.needs(&rules()),
        seen: Some(condition.seen(&rules())),
        whose: condition.mover().name().to_owned(),
        message: condition.id.map(|id| format!("{id:03X}h")),
    }
}

pub(crate) fn expected_press(press: &GoPress) -> ReadPress {
    ReadPress { t: seconds(press.t_ns), ready_for: seconds(press.ready_for_ns), why: press.why(&rules()) }
}
