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
        let mut case = TestCase::new(format!("{} {}", one.id, one.about), status(report, one));
        case.set_classname(classname(version, Some(one.section)));
        suite.add_test_case(case);
    }
    suite.add_test_case(others(report, version));
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

fn status(report: &ExamReport, requirement: &Examined) -> TestCaseStatus {
    match &requirement.outcome {
        Outcome::Pass => TestCaseStatus::success(),
        Outcome::Fail(places) => failure(report, places),
        Outcome::NotExercised(why) => {
            let mut status = TestCaseStatus::skipped();
            status.set_message(format!("not exercised: {why}"));
            status
        }
    }
}

fn others(report: &ExamReport, version: &str) -> TestCase {
    let found = report.findings.iter().enumerate().filter(|(_, one)| one.requirements.is_empty());
    let places: Vec<usize> = found.map(|(place, _)| place).collect();
    let status = if places.is_empty() { TestCaseStatus::success() } else { failure(report, &places) };
    let mut case = TestCase::new(OTHERS, status);
    case.set_classname(classname(version, None));
    case
}

/// The first of these findings, and how many scenarios have one.
fn failure(report: &ExamReport, places: &[usize]) -> TestCaseStatus {
    let mut status = TestCaseStatus::non_success(NonSuccessKind::Failure);
    let Some(finding) = places.first().and_then(|place| report.findings.get(*place)) else { return status };
    let pieces = Pieces::of(report, finding);
    let many = counted(scenarios(report, places), "scenario");
    let mut text = format!("{}\nscenario  {} ({many} in all)\n", words(finding), pieces.scenario);
    // Writing to a string does not fail.
    let _ = writeln!(text, "time      {} s, section {}", Seconds(finding.t_ns), finding.section);
    let _ = writeln!(text, "operator  {}\ncar       {}", pieces.operator, pieces.car);
    for frames in pieces.frames.chunks(FRAMES) {
        let _ = writeln!(text, "frames    {}", frames.join("   "));
    }
    status.set_type(finding.found_by.id()).set_message(words(finding)).set_description(text);
    status
}
