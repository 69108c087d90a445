//! What is wrong in a scenario: what the judge says of the AI Computer, what was to be done and was not, and what was around it.

use std::collections::BTreeMap;

use adsdv_oracle::judge::{Finding, Party, Rule, Severity};
use adsdv_spec::{AiMessages, Atoms, Edition};

use crate::catalogue;
use crate::expectation::{Expectation, Followed, Kind, Within};
use crate::expectations::{CYCLES, HOLDS_STILL};
use crate::program_error::Failure;
use crate::report::{ExamFinding, FoundBy};
use crate::session::{Change, Ran, Sent};

/// What is wrong in a scenario: what the judge says of the AI Computer, and what was to be done and was not.
pub(crate) fn findings(ran: &Ran, edition: &Edition) -> Vec<ExamFinding> {
    let mut found = judged(ran, edition);
    if let Some((time_ms, waiting)) = ran.flood {
        let cycles = edition.bus.cycle_requirements(AiMessages::IDS[0]).to_vec();
        found.push(ExamFinding {
            seen: format!("the bus cannot carry what the AI Computer sends: {waiting} of its frames wait"),
            expected: format!("each of its messages every {} ms", edition.rules.timing.cycle_ms),
            ..ExamFinding::new(ns(time_ms), "2.1", FoundBy::Exam, catalogue::held_by(edition, cycles))
        });
    }
    if let Some((time_ms, Failure { why, trace, expected })) = &ran.failed {
        found.push(ExamFinding {
            seen: why.clone(),
            expected: (*expected).to_owned(),
            trace: trace.clone(),
            ..ExamFinding::new(ns(*time_ms), "2.1", FoundBy::Stack, Vec::new())
        });
    }
    for followed in &ran.followed {
        // What the judge has said already is not said again.
        let is_said =
            |against: &[&str]| found.iter().any(|one| against.iter().all(|id| one.requirements.contains(id)));
        let missed = not_done(ran, edition, followed).filter(|missed| !is_said(&missed.requirements));
        found.extend(missed);
    }
    found.into_iter().map(|finding| finding.seen_in(ran)).collect()
}

impl ExamFinding {
    /// The same with what was around it.
    pub(crate) fn seen_in(self, ran: &Ran) -> Self {
        let time_ms = u64::try_from(self.t_ns / 1_000_000).unwrap_or_default();
        Self {
            operator: operator_until(ran, time_ms),
            frames: frames_around(ran, self.t_ns),
            car: car_after(ran, time_ms),
            ..self
        }
    }
}

/// What the judge says of the AI Computer.
fn judged(ran: &Ran, edition: &Edition) -> Vec<ExamFinding> {
    // The judge counts from the first frame.
    let start_ns = ran.sent.first().map_or(0, |sent| sent.t_ns);
    let judged = ran.report.findings.iter().filter(|finding| finding.party == Party::Ai && is_wrong(finding));
    let one = |finding: &Finding| {
        let t_ns = finding.t_ns + start_ns;
        let against = catalogue::held_by(edition, finding.requirements.clone());
        ExamFinding {
            seen: finding.seen.clone(),
            expected: finding.expected.clone(),
            slack_ms: slack_of_rule(finding.rule),
            ..ExamFinding::new(t_ns, &finding.section.to_string(), FoundBy::Judge(finding.rule), against)
        }
    };
    judged.map(one).collect()
}

/// What was to be done and was not. An edition that does not ask for it does not fail for it.
fn not_done(ran: &Ran, edition: &Edition, followed: &Followed) -> Option<ExamFinding> {
    let (time_ms, seen) = followed.failed.as_ref()?;
    let expectation = followed.expectation;
    let mut against = catalogue::held_by(edition, expectation.against.to_vec());
    if against.is_empty() {
        return None;
    }
    let mut held = None;
    if std::ptr::eq(expectation, &raw const HOLDS_STILL) {
        let broken = catalogue::of_requests(requests_at(ran, edition, ns(*time_ms)));
        against.retain(|id| broken.is_empty() || broken.contains(id));
        held = ran.report.findings.iter().find(|finding| finding.rule == Rule::ReadyHeld);
    }
    let found_by = held.map_or(FoundBy::Exam, |finding| FoundBy::Judge(finding.rule));
    Some(ExamFinding {
        seen: held.map_or(seen, |finding| &finding.seen).clone(),
        expected: held.map_or(expectation.expected, |finding| &finding.expected).to_owned(),
        slack_ms: slack(expectation, edition),
        ..ExamFinding::new(ns(*time_ms), expectation.section, found_by, against)
    })
}

/// Violations, and a length that the database does not have, which is only worth a note where a log was cut.
fn is_wrong(finding: &Finding) -> bool {
    finding.severity == Severity::Violation || finding.rule == Rule::Length
}

/// In real time, a machine that is late by a cycle may have kept a message or an answer waiting that long.
pub(crate) const CYCLE_MS: u64 = 10;

/// How late this machine may be before it is in doubt whether the AI Computer has broken a rule.
fn slack_of_rule(rule: Rule) -> Option<u64> {
    matches!(rule, Rule::HandshakeLate | Rule::MessageMissed | Rule::ReadyHeld).then_some(CYCLE_MS)
}

/// Or has not done something: half of the time that it has for that. What never is to be is so at once, but for gaps.
fn slack(expectation: &'static Expectation, edition: &Edition) -> Option<u64> {
    match expectation.kind {
        // A mission takes longer than any machine is late.
        Kind::Comes { within: Within::Mission, .. } => None,
        Kind::Comes { within, .. } => Some(within.ms(edition, u64::MAX) / 2),
        Kind::Ends { .. } => Some(CYCLE_MS),
        Kind::Never { .. } => CYCLES.iter().any(|one| std::ptr::eq(one, expectation)).then_some(CYCLE_MS),
    }
}

/// What holds of the AI Computer's requests at a time.
fn requests_at(ran: &Ran, edition: &Edition, t_ns: i64) -> Atoms {
    let mut said = AiMessages::default();
    for sent in ran.sent.iter().filter(|sent| sent.by_ai).take_while(|sent| sent.t_ns <= t_ns) {
        // What does not decode requests nothing.
        let _ = said.receive(&edition.bus, sent.frame.id, sent.frame.data());
    }
    let AiMessages { status, drive_f, drive_r, steer, .. } = said;
    status.atoms().union(drive_f.atoms()).union(drive_r.atoms()).union(steer.atoms())
}

fn operator_until(ran: &Ran, time_ms: u64) -> Vec<(u64, String)> {
    let mut by_time: BTreeMap<u64, Vec<String>> = BTreeMap::new();
    for (time, action) in ran.actions.iter().filter(|(time, _)| *time <= time_ms) {
        by_time.entry(*time).or_default().push(action.to_string());
    }
    by_time.into_iter().map(|(time, actions)| (time, actions.join(", "))).collect()
}

/// The last frame of each message before it, of those that both sides send to each other, and the first behind it.
fn frames_around(ran: &Ran, t_ns: i64) -> Vec<Sent> {
    const MOST: usize = 12;
    let before = ran.sent.iter().rev().skip_while(|sent| sent.t_ns > t_ns);
    let mut frames: Vec<Sent> = Vec::new();
    for sent in before.take(200) {
        let is_of_both = sent.by_ai || sent.frame.id == adsdv_spec::messages::Vcu2AiStatus::ID;
        let is_new = frames.iter().all(|one| one.frame.id != sent.frame.id);
        if (is_of_both && is_new || sent.t_ns == t_ns) && frames.len() < MOST {
            frames.push(*sent);
        }
    }
    frames.reverse();
    frames
}

/// What became of the car in the second behind a finding, or what it was in.
fn car_after(ran: &Ran, time_ms: u64) -> String {
    /// So much later it has nothing to do with it.
    const LATER_MS: u64 = 1000;
    let name = |state: Option<adsdv_spec::AsState>| state.map_or("no power", adsdv_spec::AsState::name);
    let followed = ran.changes.iter().find(|change| {
        // A finding about FINISHED or NEUTRAL at speed is settled when the car has reacted.
        (time_ms.saturating_sub(10)..=time_ms + LATER_MS).contains(&change.time_ms)
    });
    let last = ran.changes.iter().rfind(|change| change.time_ms <= time_ms);
    match (followed, last) {
        (Some(Change { time_ms: at, from, to, cause }), _) => {
            let cause = if cause.raw() == 0 { String::new() } else { format!(" ({cause})") };
            format!("{} -> {} at {}.{:03} s{cause}", name(*from), name(*to), at / 1000, at % 1000)
        }
        (None, Some(last)) => format!("it stays in {}", name(last.to)),
        (None, None) => "it has no power yet".to_owned(),
    }
}

fn ns(ms: u64) -> i64 {
    i64::try_from(ms.saturating_mul(1_000_000)).unwrap_or(i64::MAX)
}
