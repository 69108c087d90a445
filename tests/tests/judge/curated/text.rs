//! What the judge says of a run, a line each, as a person can review it.

use std::fmt::Write as _;

use adsdv_oracle::judge::{Finding, Judge, Report, Severity, Transition};
use adsdv_spec::{Knowledge, Term, Truth};

use super::runs::Run;

/// The report, each line with the time at which it was news.
pub(super) fn printed(run: &Run) -> String {
    let mut judge = Judge::new(run.options);
    let (mut news, origin) = (Vec::new(), run.log.first().map_or(0, |first| first.t));
    for recorded in &run.log {
        let now = recorded.t - origin;
        judge.frame(now, recorded.frame.id.into(), recorded.frame.data());
        let (transitions, findings) = judge.news();
        let lines = transitions.iter().map(transition).chain(findings.iter().map(finding));
        news.extend(lines.map(|line| (line, now)));
    }
    let state = judge.state().map_or("unknown".to_owned(), |state| state.to_string());
    let report = judge.finish();
    let (verdict, violations) = (report.verdict().name(), report.count(Severity::Violation));
    let Report { frames, duration_ns, transitions, findings, responses, .. } = report;
    let mut text = format!(
        "{frames} frames in {}, then {state}: {verdict}, {}\n",
        seconds(duration_ns),
        match violations {
            1 => "1 violation".to_owned(),
            several => format!("{several} violations"),
        }
    );
    if let (Some(min), Some(median), Some(max)) =
        (responses.min_ms(), responses.quantile_ms(0.5), responses.max_ms())
    {
        let _ = writeln!(text, "{} responses: {min} to {max} ms, median {median} ms", responses.count());
    }
    for line in transitions.iter().map(transition).chain(findings.iter().map(finding)) {
        let place = news.iter().position(|(one, _)| *one == line);
        let reported = place.map(|place| news.swap_remove(place).1);
        let reported = reported.map_or("at the end".to_owned(), |t| format!("at {}", seconds(t)));
        let _ = writeln!(text, "{line} [reported {reported}]");
    }
    for (line, t) in news {
        let _ = writeln!(text, "{line} [reported at {}, and not in the report]", seconds(t));
    }
    text
}

/// To the microsecond.
fn seconds(ns: i64) -> String {
    let us = ns.div_euclid(1000);
    format!("{}.{:06} s", us.div_euclid(1_000_000), us.rem_euclid(1_000_000))
}

fn transition(transition: &Transition) -> String {
    let Transition { t_ns, from, to, section, justified, decided, or, .. } = transition;
    let mut line = format!("{}: {from} -> {to} ({section}), {justified}", seconds(*t_ns));
    for (word, (term, known)) in
        decided.iter().map(|one| ("by", one)).chain(or.iter().map(|other| ("or by", other)))
    {
        let _ = write!(line, ", {word} {}", alternative(term, *known));
    }
    line
}

/// The conditions of an alternative with what was known of them; of one that holds, how many there are.
fn alternative(term: &Term, known: Knowledge) -> String {
    if term.truth(known) == Truth::True {
        return format!("all {} of {}", term.literals().count(), term.section);
    }
    let conditions: Vec<String> =
        term.literals().map(|(atom, _)| format!("{atom} {}", known.of(atom))).collect();
    conditions.join(" and ")
}

fn finding(finding: &Finding) -> String {
    let Finding { t_ns, severity, party, section, rule, .. } = finding;
    let message = finding.message();
    format!(
        "{}: {} of {} by {}, {section}: {message}",
        seconds(*t_ns),
        severity.name(),
        rule.id(),
        party.name()
    )
}
