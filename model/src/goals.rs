//! What must be reachable, and what stateright is asked.
//!
//! Stateright knows properties as functions without data, so there is one function for each place in a list.

use std::sync::LazyLock;

use adsdv_spec::messages::{AsState, ShutdownCause};
use adsdv_spec::{Choice, Control, Edition, Fault};

use crate::document::Document;
use crate::open::{Open, State};
use crate::properties::PROPERTIES;
use crate::property::Property;

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

type Condition = fn(&Open, &State) -> bool;

fn keeps<const PLACE: usize>(model: &Open, state: &State) -> bool {
    model.look(state).broken >> PLACE & 1 == 0
}

fn reaches<const PLACE: usize>(model: &Open, state: &State) -> bool {
    model.look(state).reached >> PLACE & 1 == 1
}

macro_rules! by_place {
    ($function:ident: $($place:literal)*) => { [$($function::<$place>),*] };
}

/// For each place in [`PROPERTIES`].
const KEEPS: [Condition; 48] = by_place!(keeps:
    0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21 22 23 24 25 26 27 28 29 30 31
    32 33 34 35 36 37 38 39 40 41 42 43 44 45 46 47);
/// For each place in the list of an edition's goals.
const REACHES: [Condition; 24] = by_place!(reaches:
    0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21 22 23);
const _: () = assert!(PROPERTIES.len() <= KEEPS.len());
const _: () = {
    let mut place = 0;
    while place < Edition::ALL.len() {
        let edition = Edition::ALL[place];
        let goals = 1 + edition.rules.table.rows().len() + edition.faults.bits().count_ones() as usize;
        assert!(goals <= REACHES.len(), "a function for each goal");
        place += 1;
    }
};

/// The properties and goals of an edition as stateright knows them.
pub(crate) fn questions(edition: &Edition) -> Vec<stateright::Property<Open>> {
    let always = Property::of_edition(edition).filter_map(|(place, property)| {
        Some(stateright::Property::always(property.name, *KEEPS.get(place)?))
    });
    let sometimes = goals(edition).iter().zip(REACHES);
    let sometimes = sometimes.map(|(goal, reaches)| stateright::Property::sometimes(goal.name, reaches));
    always.chain(sometimes).chain([to_the_end()]).collect()
}

/// A property that looks at every state and cannot fail, so that a run in which everything else has failed still goes to its
/// end.
pub(crate) fn to_the_end() -> stateright::Property<Open> {
    stateright::Property::always("to-the-end", |model, state| {
        model.look(state);
        true
    })
}
