//! What to do next, in a sentence or three: of the page, and of what a terminal shows.

use adsdv_oracle::judge::{Finding, Party, Report, Severity, Standing};
use adsdv_spec::{AsState, Rules};

use crate::facts::{because, blocked, on};
use crate::time::Seconds;

/// What to do next about a recording that was judged like this.
///
/// A violation by the AI Computer comes first, for that is what a team can mend; then the first of anyone else, what the recording
/// lacks, the first warning, what the car waits for, and an emergency stop.
pub fn next(rules: &Rules, report: &Report) -> String {
    let worst = |severity| report.findings.iter().filter(move |one| one.severity == severity);
    let violations = || worst(Severity::Violation);
    if let Some(first) = violations().find(|one| one.party == Party::Ai) {
        return fix("Fix first, in", first, violations().count());
    }
    if let Some(first) = violations().next() {
        return match first.party {
            Party::Vcu => format!(
                "Nothing to fix in the AI Computer: no violation is its own. {} The maintainers of the VCU need the frames, which adsdv check --excerpt writes.",
                fix("First, in", first, 1),
            ),
            Party::Own => format!(
                "Broken: a rule of your own, at {}: {}.{}",
                first.section,
                first.seen,
                expected(first)
            ),
            _ => fix("First, in", first, violations().count()),
        };
    }
    if let Some(lack) = report.exercised.lacks().first() {
        return format!(
            "Record again: {}. Check that the recorder is on the bus of the vehicle, and that both sides are on.",
            lack.text()
        );
    }
    if let Some(first) = worst(Severity::Warning).next() {
        return format!("Look at the first warning, at {} s: {}.", Seconds(first.t_ns), first.seen);
    }
    if let Some((stay, now)) = report.stays.last().and_then(|stay| Some((stay, on(stay)?.blocked.last()?)))
        && !report.exercised.states.contains(&AsState::Driving)
    {
        return format!("It never drove. What {} waits for: {}.", stay.state, blocked(rules, now));
    }
    if let Some(stop) = report.transitions.iter().find(|one| one.to == AsState::EmergencyBrake) {
        return format!(
            "Both sides kept to the document, and the car made an emergency stop at {} s. Find out who was behind it: {}.",
            Seconds(stop.t_ns),
            because(rules, stop),
        );
    }
    let open = report.exercised.count(Standing::NotExercised);
    format!(
        "Nothing has to be mended. {} that a recording can show did not come up.",
        counted(open, "requirement"),
    )
}

fn expected(finding: &Finding) -> String {
    match finding.expected.as_str() {
        "" => String::new(),
        expected => format!(" Expected: {expected}."),
    }
}

/// One violation of so many, and what was expected instead.
fn fix(what: &str, first: &Finding, of: usize) -> String {
    let expected = expected(first);
    let after = if of > 1 {
        " Then judge a new recording: what follows a first violation is often its consequence."
    } else {
        ""
    };
    format!("{what} {}: {} (section {}).{expected}{after}", whose(first.party), first.seen, first.section)
}

pub(crate) const fn whose(party: Party) -> &'static str {
    match party {
        Party::Ai => "the AI Computer",
        Party::Vcu => "the VCU",
        Party::Log => "the recording itself",
        Party::Own => "a rule of your own",
    }
}

pub(crate) fn counted(count: usize, noun: &str) -> String {
    let s = if count == 1 { "" } else { "s" };
    format!("{count} {noun}{s}")
}
