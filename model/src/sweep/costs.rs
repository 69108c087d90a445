//! What a reading costs: something that fails, and the shortest run that shows it.

use adsdv_spec::{AsState, Choice, Choices, Control, Edition, Machine, Readings};

use crate::action::Action;
use crate::closed::ClosedProperty;
use crate::property::{Harm, Property};
use crate::run::Run;

/// Choices that together fail something, which fewer of them do not.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Cost {
    /// The edition whose readings they are.
    pub edition: &'static Edition,
    /// The property or goal that fails, by name.
    pub name: &'static str,
    /// The choices, none of them the default; none at all: it fails under the defaults.
    pub choices: Choices,
    /// The choices of which each undoes the failure when it is made as well.
    pub undone_by: Choices,
    /// The shortest run that breaks the property, under these choices and the defaults; none for a goal.
    pub run: Option<Vec<Action>>,
}

impl Cost {
    /// The machine that fails.
    pub fn machine(&self) -> Machine {
        machine_with(self.edition, self.choices)
    }

    /// What the shortest run costs: that of the property, but a vehicle that has left AS_DRIVING does not drive on.
    pub fn harm(&self, property: &Property) -> Harm {
        let (machine, run) = (self.machine(), self.run.as_deref().unwrap_or_default());
        let end = run.iter().fold(Control::INITIAL, |control, action| action.apply(&machine, &control));
        if property.harm == Harm::DrivesOn && end.state != AsState::Driving {
            Harm::NotBraked
        } else {
            property.harm
        }
    }
}

/// The machine with these choices, and the default for every other question.
pub(super) fn machine_with(edition: &Edition, choices: Choices) -> Machine {
    Machine::new(*edition, choices.iter().fold(edition.readings, Readings::with))
}

/// A choice that fails something in the closed model, all other readings being the default.
#[derive(Clone, Debug)]
pub struct ClosedCost {
    /// The property that fails.
    pub property: &'static ClosedProperty,
    /// The choice.
    pub choice: Choice,
    /// The shortest run that breaks it, with the real times.
    pub run: Run,
}
