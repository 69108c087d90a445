//! What came of it as Markdown, for the summary page of a CI run.

use std::fmt::{self, Write as _};

use adsdv_exam::{ExamFinding, ExamReport, FINDINGS, Outcome, Pieces};

use super::Examinee;
use crate::layout::{Seconds, counted};
use crate::markdown::{escaped, escaped_html};

/// The text.
pub(super) fn text(subject: &Examinee<'_>, report: &ExamReport) -> String {
    let mut text = String::new();
    // Writing to a string does not fail.
    let _ = write(&mut text, subject, report);
    text
}

fn write(out: &mut String, subject: &Examinee<'_>, report: &ExamReport) -> fmt::Result {
    let verdict = match (report.passes(), subject.verdict.passes(report)) {
        (true, _) => "passes",
        (false, true) => "passes but for what is accepted",
        (false, false) => "fails",
    };
    let open = report.leaves_open().filter(|_| report.passes());
    let open = open.map(|open| format!(", as far as it goes: {open}")).unwrap_or_default();
    writeln!(out, "## adsdv exam: {verdict}{open}\n")?;
    let [pass, fail, not] = ["pass", "fail", "not exercised"].map(|outcome| report.count(outcome));
    writeln!(
        out,
        "{}, edition {}, {}; requirements: {fail} failed, {pass} passed, {not} not exercised.",
        escaped(subject.name),
        subject.edition.edition().version,
        counted(report.scenarios.len() as u64, "scenario"),
    )?;
    for note in &report.notes {
        writeln!(out, "\nNote: {}", escaped(note))?;
    }
    for (_, why) in subject.verdict.unused(report) {
        writeln!(out, "\nWarning: {}", escaped(&why))?;
    }
    failed(out, subject, report)?;
    findings(out, subject, report)?;
    not_exercised(out, report)
}

fn failed(out: &mut String, subject: &Examinee<'_>, report: &ExamReport) -> fmt::Result {
    if report.findings.is_empty() {
        return Ok(());
    }
    writeln!(
        out,
        "\n| failed | section | what it asks for | scenarios | accepted |\n| --- | --- | --- | --- | --- |"
    )?;
    for one in &report.requirements {
        let Outcome::Fail(places) = &one.outcome else { continue };
        let scenarios = report.scenarios_of(places);
        let reason = subject.verdict.reason(one.id).map_or_else(|| "no".to_owned(), escaped);
        writeln!(out, "| {} | {} | {} | {scenarios} | {reason} |", one.id, one.section, escaped(&one.about))?;
    }
    let others = report.others().len();
    if others > 0 {
        writeln!(
            out,
            "| - | - | {} against no single requirement | - | - |",
            counted(others as u64, "finding")
        )?;
    }
    Ok(())
}

fn findings(out: &mut String, subject: &Examinee<'_>, report: &ExamReport) -> fmt::Result {
    let shown = report.shown();
    for place in shown.iter().take(FINDINGS) {
        let Some(finding) = report.findings.get(*place) else { continue };
        one(out, report, finding)?;
        if let Some(shortest) = subject.shorter.get(place) {
            let scenario = &shortest.scenario;
            writeln!(out, "\nThe shortest scenario that shows it, for `--scenario`:\n\n```\n{scenario}```")?;
        }
        writeln!(out, "\n</details>")?;
    }
    if let Some(more) = shown.len().checked_sub(FINDINGS).filter(|more| *more > 0) {
        writeln!(out, "\nAnd {more} more (`--json` has all).")?;
    }
    Ok(())
}

/// What is wrong stands in the line that is seen, all else behind a click.
fn one(out: &mut String, report: &ExamReport, finding: &ExamFinding) -> fmt::Result {
    let pieces = Pieces::of(report, finding);
    let ids = finding.requirements.join(" ");
    writeln!(
        out,
        "\n<details><summary>{}: {}</summary>\n",
        if ids.is_empty() { finding.found_by.id() } else { &ids },
        escaped_html(&finding.words()),
    )?;
    writeln!(
        out,
        "- at {} s, section {}, {}",
        Seconds(finding.t_ns),
        finding.section,
        finding.found_by.id()
    )?;
    writeln!(out, "- scenario {}", escaped(&pieces.scenario))?;
    writeln!(out, "- operator: {}", escaped(&pieces.operator))?;
    writeln!(out, "- car: {}", escaped(pieces.car))?;
    writeln!(out, "\n```\n{}\n```", pieces.frames.join("\n"))
}

fn not_exercised(out: &mut String, report: &ExamReport) -> fmt::Result {
    if report.count("not exercised") == 0 {
        return Ok(());
    }
    writeln!(out, "\n<details><summary>Not exercised</summary>\n")?;
    for one in &report.requirements {
        if let Outcome::NotExercised(why) = &one.outcome {
            writeln!(out, "- {} {}: {}", one.id, escaped(&one.about), escaped(why))?;
        }
    }
    writeln!(out, "\n</details>")
}
