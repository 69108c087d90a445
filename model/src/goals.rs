//! What must be reachable.

use std::sync::LazyLock;

use adsdv_spec::messages::{AsState, ShutdownCause};
use adsdv_spec::{Choice, Control, Edition, Fault};

use crate::document::Document;

/// Something that must be reachable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Goal {
    /// The stable name, such as `arrow-3.2`.
    pub name: &'static str,
    /// What it says, in one sentence.
    pub statement: &'static str,
    /// The requirement or the section of the document that speaks of it.
    pub requirement: &'static str,
    target: Target,
}

/// The step that reaches a goal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Target {
    /// AS_OFF after AS_FINISHED, without an emergency since the power was switched on.
    Mission,
    /// From one state to another.
    Arrow(AsState, AsState),
    /// Into `EMERGENCY_BRAKE`, for this cause.
    Cause(ShutdownCause),
}

impl Goal {
    /// Whether a step between two control states reaches the goal.
    pub fn is_reached(&self, before: &Control, after: &Control) -> bool {
        match self.target {
            Target::Mission => {
                (before.state, after.state) == (AsState::Finished, AsState::Off)
                    && after.shutdown_cause == ShutdownCause::NoShutdown
            }
            Target::Arrow(from, to) => (before.state, after.state) == (from, to),
            Target::Cause(cause) => {
                before.shutdown_cause == ShutdownCause::NoShutdown && after.shutdown_cause == cause
            }
        }
    }
}

/// Everything that must be reachable in an edition: a whole mission, each arrow, each cause.
pub fn goals(edition: &Edition) -> &'static [Goal] {
    static GOALS: LazyLock<Vec<Vec<Goal>>> =
        LazyLock::new(|| Edition::ALL.iter().map(|edition| goals_of(edition)).collect());
    GOALS.get(Document::of(edition).place).map_or(&[], Vec::as_slice)
}

fn goals_of(edition: &Edition) -> Vec<Goal> {
    let mission = Goal {
        name: "whole-mission",
        statement: "A whole mission without an emergency, from AS_OFF to AS_OFF",
        requirement: "SM-1",
        target: Target::Mission,
    };
    let arrows = edition.rules.table.rows().iter().map(|row| Goal {
        name: leak(format!("arrow-{}", row.section)),
        statement: leak(format!("The arrow from {} to {} is taken", row.from, row.to)),
        requirement: row.section,
        target: Target::Arrow(row.from, row.to),
    });
    // An edition may have a flag that its default answers never raise.
    let is_raised =
        |fault: &Fault| *fault != Fault::BrakePlausibilityFault || edition.readings.is(Choice::TorqueAlways);
    let causes = edition.faults.iter().filter(is_raised).map(|fault| Goal {
        name: leak(format!("cause-{}", fault as u8)),
        statement: leak(format!("An emergency is caused by {fault}")),
        requirement: "MSG-64",
        target: Target::Cause(fault.cause()),
    });
    std::iter::once(mission).chain(arrows).chain(causes).collect()
}

/// For names that live as long as the program.
fn leak(text: String) -> &'static str {
    Box::leak(text.into_boxed_str())
}
