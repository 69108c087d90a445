//! What the sentences on the page are made from.

use adsdv_oracle::judge::{Decided, Finding, Report, Rule, Severity, Transition};
use adsdv_oracle::why::{Blocked, Condition, Stay, Untaken, next_of_mission};
use adsdv_spec::messages::Node;
use adsdv_spec::{Edition, Rules};
use serde::Serialize;

use crate::recording::{Found, Recording, signal};

/// A judged recording.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Facts<'a> {
    pub(crate) edition: &'static Edition,
    pub(crate) report: &'a Report,
    pub(crate) recording: &'a Recording,
}

/// A condition of an arrow, as it was when the arrow was taken.
#[derive(Debug, Serialize)]
pub(crate) struct DecidedJson {
    text: String,
    /// `true`, `false` or `unknown`: whether it was as it must be.
    held: &'static str,
}

impl<'a> Facts<'a> {
    pub(crate) const fn rules(&self) -> &'static Rules {
        &self.edition.rules
    }

    pub(crate) fn signal(&self, sender: Node, field: &str) -> Option<Found> {
        signal(&self.edition.bus, sender, field)
    }

    /// The value that a signal had last at a time.
    pub(crate) fn at(&self, found: Option<Found>, t_ns: i64) -> Option<i32> {
        self.recording.series(found).take_while(|(t, _)| *t <= t_ns).last().map(|(_, raw)| raw)
    }

    /// When a signal became this.
    pub(crate) fn became(&self, found: Option<Found>, is: impl Fn(i32) -> bool) -> Vec<i64> {
        // What is so from the first frame on did not become so.
        let mut before = true;
        let mut times = Vec::new();
        for (t, raw) in self.recording.series(found) {
            let now = is(raw);
            if now && !before {
                times.push(t);
            }
            before = now;
        }
        times
    }

    /// The state at a time.
    pub(crate) fn stay_at(&self, t_ns: i64) -> Option<&'a Stay> {
        self.report.stays.iter().rev().find(|stay| stay.since_ns <= t_ns)
    }

    pub(crate) fn of_rule(&self, rule: Rule) -> impl Iterator<Item = &'a Finding> {
        self.report.findings.iter().filter(move |finding| finding.rule == rule)
    }

    pub(crate) fn of_severity(&self, severity: Severity) -> impl Iterator<Item = &'a Finding> {
        self.report.findings.iter().filter(move |finding| finding.severity == severity)
    }
}

/// The arrow that the mission goes on by.
pub(crate) fn on(stay: &Stay) -> Option<&Untaken> {
    stay.arrows.iter().find(|untaken| untaken.to == next_of_mission(stay.state))
}

/// What blocked an arrow, in a sentence.
pub(crate) fn blocked(rules: &Rules, blocked: &Blocked) -> String {
    let failed = blocked
        .failed
        .iter()
        .map(|one| format!("{} (needs {}; {})", one.seen(rules), one.needs(rules), whose(one)));
    let mut parts: Vec<String> = failed.collect();
    let unknown: Vec<String> =
        blocked.unknown.iter().map(|one| format!("{} ({})", one.needs(rules), whose(one))).collect();
    if !unknown.is_empty() {
        let word = if parts.is_empty() { "waits for" } else { "not known:" };
        parts.push(format!("{word} {}", unknown.join(", ")));
    }
    parts.join("; ")
}

/// Whose move it is, and where it shows.
fn whose(condition: &Condition) -> String {
    let whose = condition.mover().name();
    match condition.id {
        Some(id) if condition.is_unheard() => format!("{whose}: no {id:03X}h has come"),
        Some(id) => format!("{whose}, {id:03X}h"),
        None => whose.to_owned(),
    }
}

/// The conditions that decided a transition, each as it was.
pub(crate) fn decided(rules: &Rules, transition: &Transition) -> Vec<DecidedJson> {
    let one = |one: &Decided| DecidedJson { text: one.text(rules), held: one.held.name() };
    transition.conditions().iter().map(one).collect()
}

/// Why a transition came, in a clause.
pub(crate) fn because(rules: &Rules, transition: &Transition) -> String {
    let texts: Vec<String> = decided(rules, transition)
        .into_iter()
        .map(|one| match one.held {
            "true" => one.text,
            "unknown" => format!("{} (not certain)", one.text),
            _ => format!("{} (which was not so)", one.text),
        })
        .collect();
    let mut text =
        if texts.is_empty() { "for a reason that no frame shows".to_owned() } else { texts.join(", ") };
    for other in transition.others(rules) {
        text.push_str("; or ");
        text.push_str(&other);
    }
    text
}

/// The first few of many, and how many there are besides.
pub(crate) fn first(texts: &[String], shown: usize) -> String {
    let text = texts.iter().take(shown).cloned().collect::<Vec<_>>().join("; ");
    match texts.len().checked_sub(shown) {
        None | Some(0) => text,
        Some(more) => format!("{text}; and {more} more"),
    }
}

/// A number with up to two decimals.
pub(crate) fn number(value: f64) -> String {
    let text = format!("{value:.2}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}
