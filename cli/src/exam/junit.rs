//! What came of it as JUnit XML, which CI shows: a test case for each requirement.

use adsdv_exam::{ExamReport, Examined, Outcome};
use quick_junit::{NonSuccessKind, Report, SerializeError, TestCase, TestCaseStatus, TestSuite};

use super::Examinee;

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
    let is_accepted =
        |place: &usize| report.findings.get(*place).is_some_and(|one| subject.verdict.accepts(one));
    let (known, wrong): (Vec<usize>, Vec<usize>) = report.others().into_iter().partition(is_accepted);
    let status = match (&wrong[..], &known[..]) {
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
    status
        .set_message(format!("accepted: {reason}"))
        .set_description(report.description(places, &subject.shorter));
    status
}

fn failure(subject: &Examinee<'_>, report: &ExamReport, places: &[usize]) -> TestCaseStatus {
    let mut status = TestCaseStatus::non_success(NonSuccessKind::Failure);
    if let Some(finding) = places.first().and_then(|place| report.findings.get(*place)) {
        status.set_type(finding.found_by.id()).set_message(finding.words());
        status.set_description(report.description(places, &subject.shorter));
    }
    status
}
