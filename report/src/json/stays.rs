//! The states that the VCU was in, and what blocked their arrows.

use adsdv_oracle::why::{Blocked, Condition, GoPress, Stay, Untaken};
use adsdv_spec::Rules;
use serde::Serialize;

use super::number::seconds;

/// A state, and what blocked its arrows: one of the `stays` of `adsdv check --json`.
#[derive(Serialize)]
pub struct StayJson {
    state: &'static str,
    since: f64,
    until: f64,
    left_to: Option<&'static str>,
    arrows: Vec<UntakenJson>,
}

#[derive(Serialize)]
struct UntakenJson {
    to: &'static str,
    section: &'static str,
    requirements: &'static [&'static str],
    blocked: Vec<BlockedJson>,
    not_listed: u64,
}

#[derive(Serialize)]
pub(super) struct BlockedJson {
    since: f64,
    until: f64,
    failed: Vec<ConditionJson>,
    unknown: Vec<ConditionJson>,
    holding: Vec<&'static str>,
}

#[derive(Serialize)]
struct ConditionJson {
    condition: &'static str,
    needs: String,
    seen: Option<String>,
    whose: &'static str,
    message: Option<String>,
}

#[derive(Serialize)]
pub(super) struct GoPressJson {
    t: f64,
    ready_for: f64,
    why: String,
}

impl StayJson {
    /// In the words of an edition's rules.
    pub fn of(rules: &Rules, stay: &Stay) -> Self {
        Self {
            state: stay.state.name(),
            since: seconds(stay.since_ns),
            until: seconds(stay.until_ns),
            left_to: stay.left_to.map(adsdv_spec::AsState::name),
            arrows: stay.arrows.iter().map(|untaken| UntakenJson::of(rules, untaken)).collect(),
        }
    }
}

impl UntakenJson {
    fn of(rules: &Rules, untaken: &Untaken) -> Self {
        Self {
            to: untaken.to.name(),
            section: untaken.section,
            requirements: untaken.requirements,
            blocked: untaken.blocked.iter().map(|blocked| BlockedJson::of(rules, blocked)).collect(),
            not_listed: untaken.more,
        }
    }
}

impl BlockedJson {
    pub(super) fn of(rules: &Rules, blocked: &Blocked) -> Self {
        let failed = |one: &Condition| ConditionJson::of(rules, one);
        // Of what is not known, a signal may have been seen, which was too old or could not be read.
        let unknown = |one: &Condition| {
            let seen = (!one.values.is_empty()).then(|| one.seen(rules));
            ConditionJson { seen, ..failed(one) }
        };
        Self {
            since: seconds(blocked.since_ns),
            until: seconds(blocked.until_ns),
            failed: blocked.failed.iter().map(failed).collect(),
            unknown: blocked.unknown.iter().map(unknown).collect(),
            holding: blocked.holding.iter().map(adsdv_spec::Atom::id).collect(),
        }
    }
}

impl ConditionJson {
    fn of(rules: &Rules, condition: &Condition) -> Self {
        Self {
            condition: condition.atom.id(),
            needs: condition.needs(rules),
            seen: Some(condition.seen(rules)),
            whose: condition.mover().name(),
            message: condition.id.map(|id| format!("{id:03X}h")),
        }
    }
}

impl GoPressJson {
    pub(super) fn of(rules: &Rules, press: &GoPress) -> Self {
        Self { t: seconds(press.t_ns), ready_for: seconds(press.ready_for_ns), why: press.why(rules) }
    }
}
