//! The first that a reader sees: the verdict in a sentence, what to do next, and the three things that matter most.

use adsdv_oracle::judge::{Basis, Finding, Needs, Party, Severity, Standing, Verdict};
use adsdv_spec::AsState;
use serde::Serialize;

use crate::facts::{Facts, because, blocked, number, on};
use crate::mood::Mood;
use crate::next::{counted, next, whose};
use crate::time::micros;

/// So many things matter most.
const MATTER: usize = 3;

/// What stands above all.
#[derive(Debug, Serialize)]
pub(crate) struct SummaryJson {
    mood: Mood,
    verdict: String,
    next: String,
    matters: Vec<MatterJson>,
}

/// A thing that matters.
#[derive(Debug, Serialize)]
struct MatterJson {
    mood: Mood,
    title: String,
    text: String,
    /// When, in microseconds.
    at: Option<i64>,
    /// The place of the finding in the report, if it is one.
    #[serde(skip_serializing_if = "Option::is_none")]
    finding: Option<usize>,
}

pub(crate) fn summary(facts: &Facts<'_>) -> SummaryJson {
    let mut matters = matters(facts);
    let next = next(facts.rules(), facts.report);
    matters.truncate(MATTER);
    let report = facts.report;
    let mood = match report.verdict() {
        Verdict::Violates => Mood::Bad,
        Verdict::Conforms if !report.exercised.lacks().is_empty() => Mood::Unknown,
        Verdict::Conforms if report.count(Severity::Warning) > 0 => Mood::Care,
        Verdict::Conforms => Mood::Good,
    };
    SummaryJson { mood, verdict: verdict(facts), next, matters }
}

fn verdict(facts: &Facts<'_>) -> String {
    let report = facts.report;
    let of = |party: Party| {
        let count = facts.of_severity(Severity::Violation).filter(|one| one.party == party).count();
        (count > 0).then(|| format!("{count} by {}", whose(party)))
    };
    let warnings = match report.count(Severity::Warning) {
        0 => "no warning".to_owned(),
        count => counted(count, "warning"),
    };
    match report.verdict() {
        Verdict::Violates => {
            let parties: Vec<String> =
                [Party::Ai, Party::Vcu, Party::Own, Party::Log].into_iter().filter_map(of).collect();
            let count = counted(report.count(Severity::Violation), "violation");
            format!("The recording violates the document: {count} ({}), {warnings}.", parties.join(", "))
        }
        Verdict::Conforms => {
            let lacks: Vec<&str> = report.exercised.lacks().iter().map(|lack| lack.text()).collect();
            let far = if lacks.is_empty() {
                String::new()
            } else {
                format!(", as far as it goes: {}", lacks.join(", "))
            };
            format!("The recording conforms to the document{far}. No violation, {warnings}.")
        }
    }
}

/// What matters, the most important first.
fn matters(facts: &Facts<'_>) -> Vec<MatterJson> {
    let mut matters = Vec::new();
    findings(facts, Severity::Violation, Mood::Bad, &mut matters);
    matters.extend(stop(facts));
    findings(facts, Severity::Warning, Mood::Care, &mut matters);
    matters.extend(vain(facts));
    matters.extend(waits(facts));
    matters.extend(closest(facts));
    matters.extend(shown(facts));
    matters
}

/// Of each rule that each party broke, the first time.
fn findings(facts: &Facts<'_>, severity: Severity, mood: Mood, matters: &mut Vec<MatterJson>) {
    let mut listed: Vec<&Finding> = Vec::new();
    for (place, finding) in
        facts.report.findings.iter().enumerate().filter(|(_, one)| one.severity == severity)
    {
        if listed.iter().any(|other| (other.rule, other.party) == (finding.rule, finding.party)) {
            continue;
        }
        listed.push(finding);
        matters.push(MatterJson {
            mood,
            title: format!("{} by {}", capital(severity.name()), whose(finding.party)),
            text: finding.message(),
            at: Some(micros(finding.t_ns)),
            finding: Some(place),
        });
    }
}

fn capital(word: &str) -> String {
    let mut letters = word.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

fn matter(mood: Mood, title: &str, text: String, at_ns: Option<i64>) -> MatterJson {
    MatterJson { mood, title: title.to_owned(), text, at: at_ns.map(micros), finding: None }
}

fn stop(facts: &Facts<'_>) -> Option<MatterJson> {
    let stop = facts.report.transitions.iter().find(|one| one.to == AsState::EmergencyBrake)?;
    let text = format!("{} to {}: {}", stop.from, stop.to, because(facts.rules(), stop));
    Some(matter(Mood::Bad, "Emergency stop", text, Some(stop.t_ns)))
}

fn vain(facts: &Facts<'_>) -> Option<MatterJson> {
    let press = facts.report.go_presses.first()?;
    let text = format!("\"Go\" started nothing: {}", press.why(facts.rules()));
    Some(matter(Mood::Care, "\"Go\" in vain", text, Some(press.t_ns)))
}

fn waits(facts: &Facts<'_>) -> Option<MatterJson> {
    if facts.report.exercised.states.contains(&AsState::Driving) {
        return None;
    }
    let stay = facts.report.stays.last()?;
    let untaken = on(stay)?;
    let now = untaken.blocked.last()?;
    let text = format!("{} to {} is blocked: {}", stay.state, untaken.to, blocked(facts.rules(), now));
    Some(matter(Mood::Care, "It never drove", text, Some(now.since_ns)))
}

fn closest(facts: &Facts<'_>) -> Option<MatterJson> {
    let margin = facts.report.margins.iter().find(|margin| margin.basis != Basis::Cycle)?;
    let message = margin.message.map_or_else(String::new, |id| format!(" of {id:03X}h"));
    let limit = match margin.what.needs() {
        Needs::AtMost => "at most",
        Needs::AtLeast => "at least",
    };
    let text = format!(
        "{}{message}: {} {unit}, where {limit} {} {unit} is right",
        margin.what.id(),
        number(margin.value),
        number(margin.limit),
        unit = margin.unit,
    );
    Some(matter(Mood::Good, "Closest to a limit", text, Some(margin.t_ns)))
}

fn shown(facts: &Facts<'_>) -> Option<MatterJson> {
    let exercised = &facts.report.exercised;
    let all = exercised.requirements.len();
    let open = exercised.count(Standing::NotExercised);
    let text = format!("{open} of {all} requirements that a recording can show did not come up in this one");
    (all > 0).then(|| matter(Mood::Unknown, "Not exercised", text, None))
}
