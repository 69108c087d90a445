//! What is written down: findings and transitions, how close the run came to its limits, and what it exercised.

use adsdv_spec::Edition;

use super::exercised::{Tally, of_edition};
use super::finding::{Finding, Rule};
use super::margins::Kept;
use super::output::Output;

/// Where every rule writes.
#[derive(Debug)]
pub(super) struct Book {
    edition: Edition,
    pub(super) out: Output,
    pub(super) margins: Kept,
    pub(super) tally: Tally,
}

impl Book {
    pub(super) fn new(edition: &Edition) -> Self {
        Self { edition: *edition, out: Output::default(), margins: Kept::default(), tally: Tally::default() }
    }

    /// The edition that is judged by.
    pub(super) const fn edition(&self) -> &Edition {
        &self.edition
    }

    /// Adds what was found, if anything was. The requirements are those that the edition has for the ones that are named.
    pub(super) fn found(&mut self, finding: impl Into<Option<Finding>>) {
        let Some(finding) = finding.into() else { return };
        let requirements = of_edition(&self.edition, &finding.requirements);
        // What the VCU has to do about it is not broken by what the AI Computer does.
        if !matches!(finding.rule, Rule::NeutralMoving | Rule::BrakeAndTorque | Rule::MessageMissed) {
            self.tally.found(finding.severity, &finding.requirements);
        }
        self.out.finding(Finding { requirements, ..finding });
    }
}
