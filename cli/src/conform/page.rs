//! What came of it as a page to look at.

use adsdv_conform::{ConformReport, Outcome as Came};
use adsdv_report::{Mood, Outcome, PageError, Shown};
use adsdv_spec::AsState;

use super::{JudgedProgram, json};
use crate::layout::counted;

/// The page.
pub(super) fn html(subject: &JudgedProgram<'_>, report: &ConformReport) -> Result<String, PageError> {
    let arrows: Vec<(AsState, AsState)> = subject
        .diagnosis
        .iter()
        .flat_map(|program| &program.figure)
        .map(|arrow| (arrow.from, arrow.to))
        .collect();
    Outcome {
        title: &format!("adsdv conform: {}", subject.name),
        about: &about(subject, report),
        mood: mood(subject, report),
        verdict: &verdict(subject, report),
        next: &next(subject, report),
        json: &json::text(subject, report),
        shown: Shown::Conform(&arrows),
    }
    .html()
}

/// How it was judged.
fn about(subject: &JudgedProgram<'_>, report: &ConformReport) -> Vec<String> {
    let args = subject.args;
    let (tests, runs) = (report.tests as u64, u64::from(report.runs));
    let mut lines = vec![
        subject.edition.to_string(),
        format!(
            "{}, {} (seed {}), {}",
            counted(tests, "test"),
            counted(runs, "random scenario"),
            args.seed,
            counted(report.steps, "step")
        ),
    ];
    lines.extend(args.readings.iter().map(|pin| format!("reading {pin}: {}", pin.text())));
    if args.latency > 0 {
        lines.push(format!("outputs {} late", counted(report.late as u64, "step")));
    }
    lines.extend(report.cycle_ms.map(|cycle_ms| format!("cycle {cycle_ms} ms")));
    if args.strict {
        lines.push("strict: what is only decided here counts as the document's requirements do".to_owned());
    }
    lines.extend(subject.undiagnosed.map(|why| format!("deviations were not looked for: {why}")));
    lines
}

fn mood(subject: &JudgedProgram<'_>, report: &ConformReport) -> Mood {
    let clean = report.conforms() && report.observations.is_empty();
    match (subject.conforms, clean) {
        (true, true) => Mood::Good,
        (true, false) => Mood::Care,
        (false, _) => Mood::Bad,
    }
}

fn verdict(subject: &JudgedProgram<'_>, report: &ConformReport) -> String {
    let count = |wanted: Came| report.requirements.iter().filter(|one| one.outcome == wanted).count() as u64;
    let passed = format!(
        "{} of {} that tests name {} kept",
        count(Came::Pass),
        counted(report.requirements.len() as u64, "requirement"),
        if count(Came::Pass) == 1 { "is" } else { "are" },
    );
    let failed = format!(
        "{} of {} and {} of {} fail",
        report.failed_tests,
        counted(report.tests as u64, "test"),
        report.failed_runs,
        counted(report.runs.into(), "random scenario"),
    );
    match (subject.conforms, report.conforms()) {
        (true, true) => format!("It conforms: {passed}."),
        (true, false) => format!("It conforms but for what is accepted: {passed}; {failed}."),
        (false, _) => format!("It does not conform: {passed}; {failed}."),
    }
}

/// What is to be done next.
fn next(subject: &JudgedProgram<'_>, report: &ConformReport) -> String {
    if let Some(program) = subject.diagnosis.as_ref().filter(|_| !subject.conforms) {
        if let Some(first) = program.first_that_counts() {
            return format!(
                "Begin with this deviation: {first}. The scenario below is the shortest that shows it; the others may go with it."
            );
        }
        if let Some(seconds) = program.longer() {
            return format!(
                "The search for what it does otherwise ended early: run again with --diagnosis-limit {seconds}."
            );
        }
    }
    let first = report.failures.first().filter(|_| !subject.conforms);
    if let Some(failure) = first {
        let why = failure.found.as_ref().map(|found| format!(": {}", found.why)).unwrap_or_default();
        return format!(
            "Begin with the first failure, {}{why}. It is the shortest scenario that was found.",
            failure.name
        );
    }
    if !report.observations.is_empty() {
        return "Nothing has to be done. Where the document is silent it does otherwise than this project decided: know where, below."
            .to_owned();
    }
    "Nothing has to be done. Run this in CI, so that it stays so.".to_owned()
}
