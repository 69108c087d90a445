//! The shortest scenarios that show what is wrong: each can be held again with --scenario.

use std::collections::BTreeMap;

use adsdv_exam::{
    ExamOptions, ExamReport, ExamScenario, Shortest, Stack as _, StackError, StdioStack, shortest,
};

use super::finding::{FINDINGS, shown};
use crate::progress::ProgressLine;

/// The shortest scenarios, each beside the place of its finding.
pub(super) type Shorter = BTreeMap<usize, Shortest>;

/// Looks for those of the findings that are shown, with a program that has been started anew.
pub(super) fn search(
    stack: &mut StdioStack,
    scenarios: &[ExamScenario],
    report: &ExamReport,
    options: &ExamOptions,
    runs: u32,
) -> Result<Shorter, StackError> {
    let places: Vec<usize> = shown(report).into_iter().take(FINDINGS).collect();
    let mut line = ProgressLine::new();
    let mut found = Shorter::new();
    stack.hello(options.edition)?;
    for (done, place) in places.iter().enumerate() {
        let Some(finding) = report.findings.get(*place) else { continue };
        let Some(scenario) = scenarios.get(finding.scenario) else { continue };
        line.show_bar(done, places.len(), "of the search for shorter scenarios");
        if let Some(shortest) = shortest(stack, scenario, finding, options, runs)? {
            found.insert(*place, shortest);
        }
    }
    Ok(found)
}
