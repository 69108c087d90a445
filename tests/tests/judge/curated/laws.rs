//! What holds of any recording, whatever happens in it.

use std::collections::BTreeSet;

use adsdv_oracle::judge::{Evidence, Finding, Judge, JudgeOptions, Party, Report, Rule, Severity};
use adsdv_tests::world::{Chance, MS, Random, Recorded, judge, violations};

use super::runs::Run;

/// The violations, as far as they are the same in every recording of the same run.
fn blames(report: &Report) -> BTreeSet<(&'static str, &'static str)> {
    let violations = report.findings.iter().filter(|finding| finding.severity == Severity::Violation);
    violations.map(|finding| (finding.party.name(), finding.rule.id())).collect()
}

/// Losing frames adds no violation, or what it adds.
pub(crate) fn losing_frames_adds_nothing(
    log: &[Recorded],
    options: JudgeOptions,
    seed: u64,
) -> Result<(), String> {
    let whole = judge(log, options);
    let mut random = Random::with_seed(seed);
    let loss = random.pick(&[5, 10, 20, 100]);
    let thinned: Vec<Recorded> = log.iter().copied().filter(|_| !random.one_in(loss)).collect();
    let fewer = judge(&thinned, options);
    let added: Vec<_> = blames(&fewer).difference(&blames(&whole)).copied().collect();
    if added.is_empty() {
        return Ok(());
    }
    let (fewer, whole) = (violations(&fewer), violations(&whole));
    Err(format!(
        "with 1 in {loss} frames lost (seed {seed}) there is more, {added:?}:\n{fewer:#?}\n{whole:#?}"
    ))
}

/// A live judge tells what the judge of a log reports, or what differs.
pub(crate) fn live_is_the_same(log: &[Recorded], options: JudgeOptions) -> Result<(), String> {
    let whole = judge(log, options);
    let mut judge = Judge::new(options);
    let origin = log.first().map_or(0, |first| first.t);
    let (mut transitions, mut reported) = (Vec::new(), Vec::new());
    for recorded in log {
        judge.frame(recorded.t - origin, recorded.frame.id.into(), recorded.frame.data());
        let (taken, found) = judge.news();
        transitions.extend(taken);
        reported.extend(found);
    }
    let report = judge.finish();
    if (&report.transitions, &report.findings) != (&whole.transitions, &whole.findings) {
        return Err(format!("who asks for news gets another report: {report:#?}\n{whole:#?}"));
    }
    let strange = transitions.iter().find(|transition| !whole.transitions.contains(transition));
    if let Some(strange) = strange {
        return Err(format!(
            "the live judge tells of a transition that the report does not have: {strange:?}"
        ));
    }
    // Of what the report only counts, one a second is reported, behind a finding that says so.
    let counted = |rule: Rule| {
        whole.findings.iter().any(|one| one.rule == Rule::Repeated && one.message().contains(rule.id()))
    };
    let strange = reported
        .iter()
        .find(|one| !whole.findings.contains(one) && one.rule != Rule::Repeated && !counted(one.rule));
    strange.map_or(Ok(()), |one| Err(format!("the live judge tells what the report does not have: {one:?}")))
}

/// The violations of the VCU in a recording that is late by up to 20 ms, and has lost some frames in every second one.
pub(crate) fn blame_of_the_vcu(run: &Run, seed: u64) -> Vec<String> {
    let mut random = Random::with_seed(seed);
    let loss = if random.one_in(2) { random.pick(&[10, 20, 50]) } else { 0 };
    let report = judge(&run.world.disturbed(seed, random.pick(&[0, 5, 10, 20]) * MS, loss), run.options);
    let blames = |f: &&Finding| f.severity == Severity::Violation && f.party == Party::Vcu;
    let found = report.findings.iter().filter(blames);
    found.map(|finding| format!("{}: {}", finding.rule.id(), finding.message())).collect()
}

/// What is wrong with the data of a finding about one side.
pub(crate) fn shown_wrongly(finding: &Finding, log: &[Recorded]) -> Option<String> {
    const REQUIREMENTS: &str = include_str!("../../../../spec/REQUIREMENTS.md");
    let origin = log.first().map_or(0, |first| first.t);
    let came = |evidence: &&Evidence| {
        log.iter().any(|one| (one.t - origin, one.frame.id) == (evidence.t_ns, evidence.id))
    };
    if let Some(evidence) = finding.evidence.iter().find(|evidence| !came(evidence)) {
        return Some(format!("there is no such frame: {evidence:?}"));
    }
    if finding.evidence.is_empty() && finding.rule != Rule::Repeated {
        return Some("no frame shows it".to_owned());
    }
    if !finding.evidence.is_sorted_by_key(|evidence| evidence.t_ns) {
        return Some("the frames are not in order of time".to_owned());
    }
    let unknown = finding.requirements.iter().find(|id| !REQUIREMENTS.contains(&format!("**{id}**")));
    if let Some(unknown) = unknown {
        return Some(format!("there is no requirement {unknown}"));
    }
    // A value or a length is what it is.
    let of_a_frame = matches!(finding.rule, Rule::Value | Rule::TooShort | Rule::Repeated);
    let excused = finding.excuse().is_some() != (finding.severity == Severity::Note);
    (!of_a_frame && !excused).then(|| format!("excused by {:?}", finding.excuse()))
}
