//! What came of it as a page to look at.

use adsdv_exam::ExamReport;
use adsdv_report::{Mood, Outcome, PageError, Shown};

use super::{Examinee, json};
use crate::layout::{Seconds, counted};

/// The page.
pub(super) fn html(subject: &Examinee<'_>, report: &ExamReport) -> Result<String, PageError> {
    let all_ms: u64 = report.scenarios.iter().map(|scenario| scenario.duration_ms).sum();
    let time_ns = i64::try_from(all_ms.saturating_mul(1_000_000)).unwrap_or(i64::MAX);
    let time = if subject.args.stdio { "simulated" } else { "real" };
    let about = [
        subject.edition.to_string(),
        format!(
            "{}, {} s of {time} time",
            counted(report.scenarios.len() as u64, "scenario"),
            Seconds(time_ns)
        ),
    ];
    let (mood, verdict) = verdict(subject, report);
    Outcome {
        title: &format!("adsdv exam: {}", subject.name),
        about: &about,
        mood,
        verdict: &verdict,
        next: &next(subject, report),
        json: &json(subject, report),
        shown: Shown::Exam(subject.edition.edition()),
    }
    .html()
}

fn verdict(subject: &Examinee<'_>, report: &ExamReport) -> (Mood, String) {
    let [pass, fail, not] = ["pass", "fail", "not exercised"].map(|outcome| report.count(outcome));
    let requirements = format!("of its requirements {pass} passed, {fail} failed, {not} were not exercised");
    if subject.early {
        return (Mood::Unknown, format!("There is no verdict, since the exam ended early; {requirements}."));
    }
    match (report.passes(), subject.verdict.passes(report)) {
        (true, _) => match report.leaves_open() {
            Some(open) => (Mood::Care, format!("It passes, as far as it goes: {open}; {requirements}.")),
            None => (Mood::Good, format!("It passes: {requirements}.")),
        },
        (false, true) => (Mood::Care, format!("It passes but for what is accepted: {requirements}.")),
        (false, false) => (Mood::Bad, format!("It fails: {requirements}.")),
    }
}

/// What is to be done next.
fn next(subject: &Examinee<'_>, report: &ExamReport) -> String {
    let counts = report.findings.iter().find(|finding| !subject.verdict.accepts(finding));
    if let Some(finding) = counts {
        let against = finding.ids().join(", ");
        return format!(
            "Begin with the first finding, against {against}: {}. Its scenario, its frames and what the operator did stand below.",
            finding.words()
        );
    }
    if subject.early {
        return "See the notes for why it ended, and run it again.".to_owned();
    }
    match report.count("not exercised") {
        0 => "Nothing has to be done. Run this in CI, so that it stays so.".to_owned(),
        count => format!(
            "Nothing has to be done. {} not exercised; the table says why.",
            if count == 1 { "1 requirement was".to_owned() } else { format!("{count} requirements were") }
        ),
    }
}
