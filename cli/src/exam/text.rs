//! What came of it as text for a person.

use std::fmt::{self, Write as _};
use std::time::Duration;

use adsdv_exam::{
    BESIDE, ExamFinding, ExamOptions, ExamReport, ExamScenario, Examined, FINDINGS, FRAMES, Outcome, Pieces,
    estimate,
};

use super::Examinee;
use crate::layout::{Seconds, counted, wrapped};
use crate::report::style::{self, Styled};

/// The columns of a requirement.
const ID: usize = 7;

/// The scenarios, a line each with how long it is, and how long all of them take in real time.
pub(super) fn list(scenarios: &[ExamScenario], options: &ExamOptions) -> String {
    let width = scenarios.iter().map(|scenario| scenario.name.len()).max().unwrap_or_default();
    let lengths: Vec<Duration> = scenarios.iter().map(|scenario| scenario.length(options)).collect();
    let mut text = String::new();
    for (ExamScenario { name, about, .. }, length) in scenarios.iter().zip(&lengths) {
        // Writing to a string does not fail.
        let _ = writeln!(text, "{name:width$}  {:3} s  {about}", length.as_secs_f64().ceil());
    }
    let whole = Minutes(estimate(&lengths, BESIDE, 1));
    let _ = writeln!(text, "\n{}: {whole} in real time", counted(scenarios.len() as u64, "scenario"));
    text
}

/// A duration such as `2 min 5 s`.
pub(super) struct Minutes(pub(super) Duration);

impl fmt::Display for Minutes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.0.as_secs() / 60, self.0.as_secs() % 60) {
            (0, seconds) => write!(f, "{seconds} s"),
            (minutes, 0) => write!(f, "{minutes} min"),
            (minutes, seconds) => write!(f, "{minutes} min {seconds} s"),
        }
    }
}

pub(super) fn text(subject: &Examinee<'_>, report: &ExamReport, width: usize) -> String {
    let mut text = String::new();
    // Writing to a string does not fail.
    let _ = write(&mut text, subject, report, width);
    text
}

fn write(out: &mut String, subject: &Examinee<'_>, report: &ExamReport, width: usize) -> fmt::Result {
    writeln!(out, "{}", subject.edition)?;
    let time_ms: u64 = report.scenarios.iter().map(|scenario| scenario.duration_ms).sum();
    let scenarios = counted(report.scenarios.len() as u64, "scenario");
    let time = if subject.args.stdio { "simulated" } else { "real" };
    writeln!(out, "{}: {scenarios}, {} s of {time} time", subject.name, Seconds(ms_to_ns(time_ms)))?;
    for note in &report.notes {
        writeln!(out, "{} {note}", Styled(style::CARE, "note:"))?;
    }
    let shown = report.shown();
    failed(out, (subject, report), &shown, width)?;
    findings(out, (subject, report), &shown, width)?;
    passed(out, subject, report)?;
    not_exercised(out, report, width)?;
    verdict(out, subject, report)
}

fn failed(
    out: &mut String,
    (subject, report): (&Examinee<'_>, &ExamReport),
    shown: &[usize],
    width: usize,
) -> fmt::Result {
    if report.findings.is_empty() {
        return Ok(());
    }
    writeln!(out, "\n{}", Styled(style::HEADING, "FAILED"))?;
    for Examined { id, about, outcome, .. } in &report.requirements {
        let Outcome::Fail(places) = outcome else { continue };
        let number = places.first().and_then(|first| shown.iter().position(|place| place == first));
        let number = number.map_or(String::new(), |number| format!("; finding {}", number + 1));
        let scenarios = counted(report.scenarios_of(places), "scenario");
        let line = format!("{about} ({scenarios}{number})");
        let reason = subject.verdict.reason(id);
        let style = if reason.is_some() { style::CARE } else { style::BAD };
        write!(out, "  {} ", Styled(style, format!("{id:ID$}")))?;
        let mut text = String::new();
        wrapped(&mut text, line.split(' '), ID + 3, width);
        out.push_str(text.trim_start());
        accepted(out, reason, width);
    }
    let mut rules: Vec<(&str, u64)> = Vec::new();
    for finding in report.findings.iter().filter(|finding| finding.requirements.is_empty()) {
        let rule = finding.found_by.id();
        match rules.iter_mut().find(|(known, _)| *known == rule) {
            Some((_, count)) => *count += 1,
            None => rules.push((rule, 1)),
        }
    }
    for (rule, count) in rules {
        let what = counted(count, "finding");
        let reason = subject.verdict.reason(rule);
        let style = if reason.is_some() { style::CARE } else { style::BAD };
        let id = Styled(style, format!("{:ID$}", "-"));
        writeln!(out, "  {id} {what} of {rule}, against no single requirement")?;
        accepted(out, reason, width);
    }
    Ok(())
}

fn accepted(out: &mut String, reason: Option<&str>, width: usize) {
    if let Some(reason) = reason {
        wrapped(out, format!("accepted: {reason}").split(' '), ID + 3, width);
    }
}

fn findings(
    out: &mut String,
    (subject, report): (&Examinee<'_>, &ExamReport),
    shown: &[usize],
    width: usize,
) -> fmt::Result {
    if shown.is_empty() {
        return Ok(());
    }
    writeln!(out, "\n{}", Styled(style::HEADING, "FINDINGS"))?;
    let found = shown.iter().filter_map(|place| Some((place, report.findings.get(*place)?)));
    for (number, (place, finding)) in found.enumerate().take(FINDINGS) {
        one(out, report, number + 1, finding, width)?;
        if let Some(shortest) = subject.shorter.get(place) {
            lines(out, "shortest", &shortest.scenario.to_string());
        }
    }
    if let Some(more) = shown.len().checked_sub(FINDINGS).filter(|more| *more > 0) {
        writeln!(out, "\n  and {more} more (--json has all)")?;
    }
    Ok(())
}

fn one(
    out: &mut String,
    report: &ExamReport,
    number: usize,
    finding: &ExamFinding,
    width: usize,
) -> fmt::Result {
    if number > 1 {
        writeln!(out)?;
    }
    writeln!(
        out,
        "  {number:2}  {} s  AI   {:9} {}  {}",
        Seconds(finding.t_ns),
        finding.section,
        finding.found_by.id(),
        finding.requirements.join(" "),
    )?;
    wrapped(out, finding.words().split(' '), 6, width);
    let pieces = Pieces::of(report, finding);
    field(out, "scenario", &pieces.scenario, width);
    field(out, "operator", &pieces.operator, width);
    field(out, "car", pieces.car, width);
    for (place, frames) in pieces.frames.chunks(FRAMES).enumerate() {
        let label = if place == 0 { "frames" } else { "" };
        writeln!(out, "      {label:9} {}", frames.join("   "))?;
    }
    Ok(())
}

/// Lines that are to stay as they are, to be copied.
fn lines(out: &mut String, label: &str, text: &str) {
    for (place, line) in text.lines().enumerate() {
        let label = if place == 0 { label } else { "" };
        // Writing to a string does not fail.
        let _ = writeln!(out, "      {label:9} {line}");
    }
}

fn field(out: &mut String, label: &str, value: &str, width: usize) {
    if value.is_empty() {
        return;
    }
    let mut text = String::new();
    wrapped(&mut text, value.split(' '), 16, width);
    // Writing to a string does not fail.
    let _ = write!(out, "      {label:9} {}", text.trim_start());
}

fn passed(out: &mut String, subject: &Examinee<'_>, report: &ExamReport) -> fmt::Result {
    let passed = report.count("pass");
    writeln!(out, "\n{}", Styled(style::HEADING, "PASSED"))?;
    if !subject.args.all {
        let hint = if passed > 0 { " (--all lists them)" } else { "" };
        return writeln!(out, "  {}{hint}", counted(passed as u64, "requirement"));
    }
    for one in report.requirements.iter().filter(|one| one.outcome == Outcome::Pass) {
        writeln!(out, "  {} {}", Styled(style::GOOD, format!("{:ID$}", one.id)), one.about)?;
    }
    Ok(())
}

fn not_exercised(out: &mut String, report: &ExamReport, width: usize) -> fmt::Result {
    let mut whys: Vec<(&str, Vec<&str>)> = Vec::new();
    for one in &report.requirements {
        let Outcome::NotExercised(why) = &one.outcome else { continue };
        match whys.iter_mut().find(|(known, _)| known == why) {
            Some((_, ids)) => ids.push(one.id),
            None => whys.push((why, vec![one.id])),
        }
    }
    if whys.is_empty() {
        return Ok(());
    }
    writeln!(out, "\n{}", Styled(style::HEADING, "NOT EXERCISED"))?;
    for (why, ids) in whys {
        wrapped(out, format!("{}: {why}", ids.join(", ")).split(' '), 2, width);
    }
    Ok(())
}

fn verdict(out: &mut String, subject: &Examinee<'_>, report: &ExamReport) -> fmt::Result {
    writeln!(out)?;
    let limit = subject.edition.edition().rules.timing.handshake_ms;
    match &report.slowest {
        Some(times) => {
            let ms = |value: Option<f64>| value.unwrap_or_default();
            writeln!(
                out,
                "handshake: in the slowest scenario median {:.2}, max {:.2} ms, limit {limit} ms",
                ms(times.quantile_ms(0.5)),
                ms(times.max_ms()),
            )?;
        }
        None => writeln!(out, "handshake: never answered, limit {limit} ms")?,
    }
    let [pass, fail, not] = ["pass", "fail", "not exercised"].map(|outcome| report.count(outcome));
    let accepted = match subject.verdict.count(report) {
        0 => String::new(),
        count => format!(" ({count} accepted)"),
    };
    writeln!(out, "requirements: {fail} failed{accepted}, {pass} passed, {not} not exercised")?;
    for (_, why) in subject.verdict.unused(report) {
        writeln!(out, "{} {why}", Styled(style::CARE, "warning:"))?;
    }
    if subject.early {
        writeln!(out, "{}: {}", subject.name, Styled(style::CARE, "no verdict, since the exam ended early"))
    } else if report.passes() {
        let passes = Styled(style::GOOD, "passes");
        match report.leaves_open() {
            Some(open) => writeln!(out, "{}: {passes}, as far as it goes: {open}", subject.name),
            None => writeln!(out, "{}: {passes}", subject.name),
        }
    } else if subject.verdict.passes(report) {
        writeln!(out, "{}: {} but for what is accepted", subject.name, Styled(style::GOOD, "passes"))
    } else {
        writeln!(out, "{}: {}", subject.name, Styled(style::BAD, "fails"))
    }
}

fn ms_to_ns(ms: u64) -> i64 {
    i64::try_from(ms).unwrap_or(i64::MAX / 1_000_000).saturating_mul(1_000_000)
}
