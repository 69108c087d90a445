//! A comparison as text: what comes first matters most.

use std::fmt::{self, Write as _};

use adsdv_oracle::compare::{Comparison, FoundOnce, LastedDiffers, OnlyTransition, Recording, Which};
use adsdv_oracle::judge::{Severity, Verdict};

use super::section::{heading, more};
use super::{frames, margins, parting, requests};
use crate::layout::{Seconds, counted, wrapped};
use crate::report::style::{self, Styled};

/// So many lines, or groups of lines, of one section tell enough: a comparison fits on a screen.
const SHOWN: usize = 6;
/// Where text stands below the first line of a finding.
const INDENT: usize = 6;

/// The whole comparison, with ANSI styles, wrapped to `width` columns.
pub(super) fn text(
    recordings: [&Recording; 2],
    names: &[String; 2],
    comparison: &Comparison<'_>,
    width: usize,
) -> String {
    let mut text = String::new();
    // Writing to a string does not fail.
    let _ = write(&mut text, recordings, names, comparison, width);
    text
}

fn write(
    out: &mut String,
    recordings: [&Recording; 2],
    names: &[String; 2],
    comparison: &Comparison<'_>,
    width: usize,
) -> fmt::Result {
    writeln!(out, "{}", editions(recordings))?;
    for ((which, recording), name) in [Which::Good, Which::Bad].into_iter().zip(recordings).zip(names) {
        header(out, which, recording, name)?;
    }
    parting::write(out, recordings, comparison.begin, comparison.parting.as_ref(), width)?;
    transitions(out, &comparison.transitions)?;
    lasted(out, &comparison.lasted)?;
    found(out, &comparison.found, width)?;
    requests::write(out, &comparison.ranges, &comparison.sequences, width)?;
    margins::write(out, &comparison.margins)?;
    frames::write(out, &comparison.frames, comparison.answers.as_ref(), width)?;
    let (style, said) = match summary(comparison) {
        Some(said) => (style::CARE, format!("they differ: {said}")),
        None => (style::GOOD, "nothing that matters differs".to_owned()),
    };
    out.push('\n');
    let (head, rest) = said.split_once(": ").unwrap_or((&said, ""));
    let mut line = Styled(style, head).to_string();
    if !rest.is_empty() {
        write!(line, ": {rest}")?;
    }
    writeln!(out, "{line}")
}

/// The line about the editions that the two were judged by.
fn editions([good, bad]: [&Recording; 2]) -> String {
    let versions = [good, bad].map(|recording| recording.edition.version);
    match (versions[0] == versions[1], good.recognised.is_some()) {
        (true, false) => format!("edition {}", versions[0]),
        (true, true) => format!("edition {} (recognised in both)", versions[0]),
        (false, _) => format!("edition {} in GOOD, edition {} in BAD (recognised)", versions[0], versions[1]),
    }
}

fn header(out: &mut String, which: Which, recording: &Recording, name: &str) -> fmt::Result {
    let report = &recording.report;
    let style = match report.verdict() {
        Verdict::Conforms => style::GOOD,
        Verdict::Violates => style::BAD,
    };
    let (frames, verdict) = (counted(report.frames, "frame"), Styled(style, report.verdict().name()));
    writeln!(out, "{:4}  {name}: {frames} in {} s, {verdict}", which.name(), Seconds(report.duration_ns))
}

fn transitions(out: &mut String, transitions: &[OnlyTransition]) -> fmt::Result {
    heading(out, "TRANSITIONS", transitions.is_empty())?;
    for OnlyTransition { which, t_ns, from, to } in transitions.iter().take(SHOWN) {
        writeln!(out, "  only {:4} {:>10} s  {from} -> {to}", which.name(), Seconds(*t_ns))?;
    }
    more(out, transitions.len(), SHOWN)
}

fn lasted(out: &mut String, lasted: &[LastedDiffers]) -> fmt::Result {
    heading(out, "STATES", lasted.is_empty())?;
    for LastedDiffers { state, since_ns, for_ns } in lasted.iter().take(SHOWN) {
        let [good, bad] = for_ns.map(Seconds);
        let [good_since, bad_since] = since_ns.map(Seconds);
        let (good, bad) = (format!("{good} s from {good_since} s"), format!("{bad} s from {bad_since} s"));
        writeln!(out, "  {state:15}  GOOD lasted {good}, BAD {bad}")?;
    }
    more(out, lasted.len(), SHOWN)
}

fn found(out: &mut String, found: &[FoundOnce<'_>], width: usize) -> fmt::Result {
    heading(out, "FINDINGS", found.is_empty())?;
    for FoundOnce { which, first, count } in found.iter().take(SHOWN) {
        let style = style::of(first.severity);
        write!(
            out,
            "  only {:4} {:>10} s  {:9}  {:3}  {:<8}  {}",
            which.name(),
            Seconds(first.t_ns),
            Styled(style, first.severity.name()),
            first.party.name(),
            first.section,
            first.rule.id(),
        )?;
        if *count > 1 {
            write!(out, " ({count} times, first here)")?;
        }
        out.push('\n');
        let mut message = String::new();
        wrapped(&mut message, first.message().split_whitespace(), INDENT, width);
        // A note is a fact, and its beginning tells which.
        match message.split_once('\n') {
            Some((line, rest)) if first.severity == Severity::Note && !rest.is_empty() => {
                writeln!(out, "{} ...", shortened(line, width))?;
            }
            _ => out.push_str(&message),
        }
    }
    more(out, found.len(), SHOWN)
}

/// A line with room for what says that there is more.
fn shortened(line: &str, width: usize) -> &str {
    match line.rfind(' ') {
        Some(at) if line.chars().count() + 4 > width => line.get(..at).unwrap_or(line),
        _ => line,
    }
}

/// What differs, in a line.
fn summary(comparison: &Comparison<'_>) -> Option<String> {
    let Comparison {
        editions,
        begin,
        parting,
        transitions,
        lasted,
        found,
        ranges,
        sequences,
        frames,
        answers,
        margins,
    } = comparison;
    let way = parting.as_ref().map(|parting| format!("the way from {} on", parting.state));
    let requests = ranges.len() + sequences.len();
    let parts = [
        editions.is_some().then(|| "the edition".to_owned()),
        begin.is_some().then(|| "the state at the beginning".to_owned()),
        way,
        number(transitions.len(), "transition"),
        number(lasted.len(), "duration"),
        number(found.len(), "finding"),
        number(requests, "request"),
        number(margins::that_matter(margins).len(), "margin"),
        number(frames.len(), "identifier"),
        answers.is_some().then(|| "handshake".to_owned()),
    ];
    let parts: Vec<String> = parts.into_iter().flatten().collect();
    (!parts.is_empty()).then(|| parts.join(", "))
}

fn number(count: usize, noun: &str) -> Option<String> {
    (count > 0).then(|| counted(count as u64, noun))
}
