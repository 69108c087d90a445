//! What came of it as JUnit XML, which CI shows: a test case for each requirement.

use std::fmt::Write as _;

use adsdv_exam::{ExamReport, Examined, Outcome};
use quick_junit::{NonSuccessKind, Report, SerializeError, TestCase, TestCaseStatus, TestSuite};

use super::Examinee;
use super::finding::{FRAMES, Pieces, scenarios, words};
use crate::layout::{Seconds, counted};

/// The test case of the findings that are against no single requirement.
const OTHERS: &str = "nothing else is wrong";

/// The XML.
pub(super) fn text(subject: &Examinee<'_>, report: &ExamReport) -> Result<String, SerializeError> {
    let version = subject.edition.edition().version;
    let mut suite = TestSuite::new(subject.name);
    suite.add_property(("edition", version));
    for one in &report.requirements {
        let mut case = TestCase::new(format!("{} {}", one.id, one.about), status(subject, report, one));
        case.set_classname(classname(version, Some(one.section)));
        suite.add_test_case(case);
    }
    suite.add_test_case(others(subject, report));
    let mut xml = Report::new("adsdv exam");
    xml.add_test_suite(suite);
    xml.to_string()
}

/// Tools split the name at dots into packages, and show spaces badly.
fn classname(version: &str, section: Option<&str>) -> String {
    let name = |text: &str| text.replace(['.', ' '], "_");
    let section = section.map_or_else(|| "no_section".to_owned(), |one| format!("section_{}", name(one)));
    format!("adsdv.edition_{}.{section}", name(version))
}

fn status(subject: &Examinee<'_>, report: &ExamReport, requirement: &Examined) -> TestCaseStatus {
    match &requirement.outcome {
        Outcome::Pass => TestCaseStatus::success(),
        Outcome::Fail(places) => match subject.verdict.reason(requirement.id) {
            Some(reason) => accepted(subject, report, places, reason),
            None => failure(subject, report, places),
        },
        Outcome::NotExercised(why) => {
            let mut status = TestCaseStatus::skipped();
            status.set_message(format!("not exercised: {why}"));
            status
        }
    }
}

fn others(subject: &Examinee<'_>, report: &ExamReport) -> TestCase {
    let found = report.findings.iter().enumerate().filter(|(_, one)| one.requirements.is_empty());
    let places = |accepted| {
        let of_these = found.clone().filter(move |(_, one)| subject.verdict.accepts(one) == accepted);
        of_these.map(|(place, _)| place).collect::<Vec<usize>>()
    };
    let status = match (&places(false)[..], &places(true)[..]) {
        ([], []) => TestCaseStatus::success(),
        ([], known) => accepted(subject, report, known, "their rules are in the file"),
        (wrong, _) => failure(subject, report, wrong),
    };
    let mut case = TestCase::new(OTHERS, status);
    case.set_classname(classname(subject.edition.edition().version, None));
    case
}

/// What is known does not turn a run red, and stays to be seen.
fn accepted(subject: &Examinee<'_>, report: &ExamReport, places: &[usize], reason: &str) -> TestCaseStatus {
    let mut status = TestCaseStatus::skipped();
    status.set_message(format!("accepted: {reason}")).set_description(description(subject, report, places));
    status
}

fn failure(subject: &Examinee<'_>, report: &ExamReport, places: &[usize]) -> TestCaseStatus {
    let mut status = TestCaseStatus::non_success(NonSuccessKind::Failure);
    if let Some(finding) = places.first().and_then(|place| report.findings.get(*place)) {
        status.set_type(finding.found_by.id()).set_message(words(finding));
        status.set_description(description(subject, report, places));
    }
    status
}

/// The first of these findings, and how many scenarios have one.
fn description(subject: &Examinee<'_>, report: &ExamReport, places: &[usize]) -> String {
    let Some(place) = places.first() else { return String::new() };
    let Some(finding) = report.findings.get(*place) else { return String::new() };
    let pieces = Pieces::of(report, finding);
    let many = counted(scenarios(report, places), "scenario");
    let mut text = format!("{}\nscenario  {} ({many} in all)\n", words(finding), pieces.scenario);
    // Writing to a string does not fail.
    let _ = writeln!(text, "time      {} s, section {}", Seconds(finding.t_ns), finding.section);
    let _ = writeln!(text, "operator  {}\ncar       {}", pieces.operator, pieces.car);
    for frames in pieces.frames.chunks(FRAMES) {
        let _ = writeln!(text, "frames    {}", frames.join("   "));
    }
    if let Some(shortest) = subject.shorter.get(place) {
        let _ = write!(text, "shortest scenario, for adsdv exam --scenario:\n{}", shortest.scenario);
    }
    text
}
