//! What came of logs as JUnit XML, which CI shows: a suite for each log, a case for each rule of the judge.

use adsdv_oracle::judge::Rule;
use quick_junit::{NonSuccessKind, Report, SerializeError, TestCase, TestCaseStatus, TestSuite};

use super::row::{OfRule, Row};
use crate::status::Status;

/// The case of whether the log could be read, to its end.
const READ: &str = "the log can be read";
/// The case of what `--require` asks for.
const REQUIRED: &str = "the log shows what is required";

/// The XML.
pub(super) fn text(rows: &[Row]) -> Result<String, SerializeError> {
    let mut xml = Report::new("adsdv check");
    for row in rows {
        xml.add_test_suite(suite(row));
    }
    xml.to_string()
}

fn suite(row: &Row) -> TestSuite {
    let mut suite = TestSuite::new(row.name.as_str());
    if !row.edition.is_empty() {
        suite.add_property(("edition", row.edition));
    }
    let unread = row.first.as_deref().filter(|_| row.status == Status::NoAnswer);
    suite.add_test_case(case(READ, unread.map_or_else(TestCaseStatus::success, |why| failure(why, why))));
    if row.frames == 0 {
        return suite;
    }
    for rule in Rule::ALL {
        let status = row.rules.get(rule.id()).map_or_else(TestCaseStatus::success, of_rule);
        suite.add_test_case(case(rule.id(), status));
    }
    let missing = row.missing.join("\n");
    let status = if missing.is_empty() { TestCaseStatus::success() } else { failure("missing", &missing) };
    suite.add_test_case(case(REQUIRED, status));
    suite
}

fn case(name: &str, status: TestCaseStatus) -> TestCase {
    let mut case = TestCase::new(name, status);
    case.set_classname("adsdv.check");
    case
}

/// A warning does not turn a run red, and stays to be seen.
fn of_rule(of: &OfRule) -> TestCaseStatus {
    let words = of.words.join("\n");
    if of.violations > 0 {
        return failure(&format!("{} violations, {} warnings", of.violations, of.warnings), &words);
    }
    let mut status = TestCaseStatus::skipped();
    status.set_message(format!("{} warnings", of.warnings)).set_description(words);
    status
}

fn failure(message: &str, words: &str) -> TestCaseStatus {
    let mut status = TestCaseStatus::non_success(NonSuccessKind::Failure);
    status.set_message(message).set_description(words);
    status
}
