//! A report as text for a person: what was judged, the timeline, the findings, the notes, the
//! user's own rules, the margins, what was exercised, what to do next, the
//! verdict.

mod exercised;
mod findings;
pub(crate) mod margins;
mod rules;
pub(crate) mod style;
mod timeline;
mod why;

use std::fmt::{self, Write as _};

use adsdv_oracle::judge::{Finding, Report, Required, Severity, Transition, Verdict};
use adsdv_oracle::log::LogOptions;
use adsdv_oracle::recognise::Recognised;
use adsdv_report::asked::settings;
use adsdv_spec::{Choice, Rules};

use style::Styled;
pub(crate) use why::{by, waits};

use crate::layout::{Seconds, counted, wrapped};
use crate::output;

/// Where text stands below the time of its line.
pub(crate) const INDENT: usize = 14;

/// What was judged, and how.
#[derive(Clone, Copy, Debug)]
pub(crate) struct JudgedLog<'a> {
    /// The line about the edition that it was judged by, if nothing before the report says it.
    pub(crate) edition: Option<&'a str>,
    /// The log, as the user named it.
    pub(crate) name: &'a str,
    /// How it was judged.
    pub(crate) options: &'a LogOptions,
    /// The readings that were pinned.
    pub(crate) pins: &'a [Choice],
    /// What the log is to show.
    pub(crate) required: &'a [Required],
}

impl JudgedLog<'_> {
    /// How it was judged, where that is not as usual: a line each.
    pub(crate) fn settings(&self) -> Vec<String> {
        settings(self.options, self.pins)
    }
}

/// The whole report, with ANSI styles, wrapped to `width` columns.
pub(crate) fn text(subject: &JudgedLog<'_>, report: &Report, width: usize) -> String {
    let mut text = String::new();
    // Writing to a string does not fail.
    let _ = write(&mut text, subject, report, width);
    text
}

/// What a judge has found while it still judges, in order of time.
pub(crate) fn news(rules: &Rules, transitions: &[Transition], findings: &[Finding], width: usize) -> String {
    let mut text = String::new();
    // Writing to a string does not fail.
    let _ = write_news(&mut text, rules, transitions, findings, width);
    text
}

/// The line about an edition that was recognised, and by what; two where one fact is too long for it. What does not fit is among the findings.
pub(crate) fn recognised(recognised: &Recognised) -> String {
    let line = |shown| {
        let facts = first(&recognised.evidence, shown);
        let why = facts.into_iter().chain(recognised.doubt()).collect::<Vec<_>>().join("; ");
        format!("edition {} (recognised: {why})", recognised.edition.version)
    };
    let mut lines = (1..=FACTS).rev().map(line);
    lines.find(|line| line.chars().count() <= output::WIDTH).unwrap_or_else(|| {
        let mut broken = String::new();
        wrapped(&mut broken, line(1).split(' '), 0, output::WIDTH);
        broken.trim_end().to_owned()
    })
}

/// So many facts tell enough.
pub(crate) const FACTS: usize = 2;

/// What an edition was recognised by, in a line: so many facts, and how many there are besides; `None` where there is nothing.
pub(crate) fn first(evidence: &[String], shown: usize) -> Option<String> {
    let mut facts: Vec<String> = evidence.iter().take(shown).cloned().collect();
    if let Some(more) = evidence.len().checked_sub(shown).filter(|more| *more > 0) {
        facts.push(format!("{more} more such"));
    }
    (!facts.is_empty()).then(|| facts.join("; "))
}

fn write_news(
    out: &mut String,
    rules: &Rules,
    transitions: &[Transition],
    findings: &[Finding],
    width: usize,
) -> fmt::Result {
    let mut findings = findings.iter().peekable();
    for transition in transitions {
        while let Some(finding) = findings.next_if(|finding| finding.t_ns < transition.t_ns) {
            findings::write_one(out, finding, 1, width)?;
        }
        timeline::write_one(out, rules, transition, width)?;
    }
    findings.try_for_each(|finding| findings::write_one(out, finding, 1, width))
}

fn write(out: &mut String, subject: &JudgedLog<'_>, report: &Report, width: usize) -> fmt::Result {
    header(out, subject, report)?;
    why::write(out, &subject.options.judge.edition.rules, report, width)?;
    timeline::write(out, &subject.options.judge.edition.rules, &report.transitions, width)?;
    findings::write(out, &report.findings, width)?;
    rules::write(out, &report.rules, width)?;
    margins::write(out, &report.margins)?;
    answers(out, report)?;
    exercised::write(out, &report.exercised)?;
    let next = adsdv_report::next(&subject.options.judge.edition.rules, report);
    wrapped(out, format!("next: {next}").split(' '), 0, width);
    verdict(out, subject, report)?;
    exercised::missing(out, subject.name, report, subject.required, width);
    Ok(())
}

fn header(out: &mut String, subject: &JudgedLog<'_>, report: &Report) -> fmt::Result {
    if let Some(edition) = subject.edition {
        writeln!(out, "{edition}")?;
    }
    let frames = counted(report.frames, "frame");
    writeln!(out, "{}: {frames} in {} s", subject.name, Seconds(report.duration_ns))?;
    subject.settings().iter().try_for_each(|setting| writeln!(out, "{setting}"))
}

fn answers(out: &mut String, report: &Report) -> fmt::Result {
    let times = &report.responses;
    write!(out, "\nAI handshake: ")?;
    match (times.min_ms(), times.quantile_ms(0.5), times.quantile_ms(0.99), times.max_ms()) {
        (Some(min), Some(median), Some(p99), Some(max)) => writeln!(
            out,
            "{}; min {min:.2}, median {median:.2}, p99 {p99:.2}, max {max:.2} ms",
            counted(times.count(), "answer"),
        ),
        _ => writeln!(out, "no answers seen"),
    }
}

fn verdict(out: &mut String, subject: &JudgedLog<'_>, report: &Report) -> fmt::Result {
    let verdict = report.verdict();
    let style = match verdict {
        Verdict::Conforms => style::GOOD,
        Verdict::Violates => style::BAD,
    };
    let count = |severity: Severity| counted(report.count(severity) as u64, severity.name());
    writeln!(
        out,
        "{}: {}{} ({}, {}, {})",
        subject.name,
        Styled(style, verdict.name()),
        exercised::reservation(&report.exercised),
        count(Severity::Violation),
        count(Severity::Warning),
        count(Severity::Note),
    )
}
