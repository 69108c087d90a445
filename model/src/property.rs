//! What a property of the open model is: a claim about every step, with the inputs that it looks at.

use std::sync::LazyLock;

use adsdv_spec::messages::AsState;
use adsdv_spec::{Atom, Atoms, Control, Edition, Machine, Timing};

use crate::document::Document;
use crate::planes::Planes;
use crate::properties::PROPERTIES;
use crate::step::Step;

/// A property that every step keeps.
#[derive(Clone, Copy, Debug)]
pub struct Property {
    /// The stable name, such as `driving-sdc`.
    pub name: &'static str,
    /// What it says, in one sentence. What stands in braces is a time of the edition, which
    /// [`statement_in`](Self::statement_in) puts there.
    pub statement: &'static str,
    /// The requirements that it covers in some edition, as `spec/REQUIREMENTS.md` numbers them;
    /// [`requirements_in`](Self::requirements_in) has those of one.
    pub requirements: &'static [&'static str],
    /// What it can cost when the property does not hold.
    pub harm: Harm,
    /// Whether an edition, with its default readings, has it.
    pub holds_in: fn(&Edition) -> bool,
    /// What is checked at every step.
    pub claim: Claim,
}

/// What it can cost when a property does not hold, the worst first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Harm {
    /// The vehicle drives on when it must stop.
    DrivesOn,
    /// The vehicle can set off when it must not.
    SetsOff,
    /// A standing vehicle is not braked when it must be.
    NotBraked,
    /// The vehicle is made ready to drive when it must not.
    MadeReady,
    /// What the VCU tells is not so.
    Misled,
    /// A run is lost without a reason that the document names.
    RunLost,
}

impl Harm {
    /// In words.
    pub const fn text(self) -> &'static str {
        match self {
            Self::DrivesOn => "the vehicle drives on when it must stop",
            Self::SetsOff => "the vehicle can set off when it must not",
            Self::NotBraked => "a standing vehicle is not braked when it must be",
            Self::MadeReady => "the vehicle is made ready when it must not be",
            Self::Misled => "what the VCU tells is not so",
            Self::RunLost => "a run is lost without a reason in the document",
        }
    }
}

/// What a property claims of every step.
#[derive(Clone, Copy, Debug)]
pub enum Claim {
    /// A step from one of these states in which the condition holds leads to one of those.
    Leads {
        /// The states before the step.
        from: &'static [AsState],
        /// The condition.
        when: When,
        /// The states after it.
        to: &'static [AsState],
    },
    /// A step from the one state to the other is taken only when the condition holds.
    Only {
        /// The state before the step.
        from: AsState,
        /// The state after it.
        to: AsState,
        /// The condition.
        when: When,
    },
    /// Something else.
    Each {
        /// Whether a step keeps it.
        holds: fn(&Machine, &Step) -> bool,
        /// The inputs that it looks at in steps from a control state, with these times of the document.
        reads: fn(&Control, &Timing) -> Atoms,
    },
}

/// A condition on a step.
#[derive(Clone, Copy, Debug)]
pub enum When {
    /// All of these inputs are on, and none of those.
    Inputs {
        /// The atoms that hold.
        on: Atoms,
        /// The atoms that do not.
        off: Atoms,
    },
    /// Something else.
    Step {
        /// Whether it holds.
        holds: fn(&Step) -> bool,
        /// The inputs that it looks at.
        reads: Atoms,
    },
}

impl When {
    pub(crate) const fn on(atoms: &[Atom]) -> Self {
        Self::Inputs { on: Atoms::of(atoms), off: Atoms::NONE }
    }

    pub(crate) const fn off(atoms: &[Atom]) -> Self {
        Self::Inputs { on: Atoms::NONE, off: Atoms::of(atoms) }
    }

    fn holds(self, step: &Step) -> bool {
        match self {
            Self::Inputs { on, off } => step.shows(on, off),
            Self::Step { holds, .. } => holds(step),
        }
    }

    fn reads(self) -> Atoms {
        match self {
            Self::Inputs { on, off } => on.union(off),
            Self::Step { reads, .. } => reads,
        }
    }
}

/// Every property of an edition, in the order of the document.
pub fn properties(edition: &Edition) -> impl Iterator<Item = &'static Property> {
    Property::of_edition(edition).map(|(_, property)| property)
}

impl Property {
    /// The property of this name.
    pub fn find(name: &str) -> Option<&'static Self> {
        PROPERTIES.iter().find(|property| property.name == name)
    }

    /// Whether a step keeps the property.
    pub fn holds(&self, machine: &Machine, step: &Step) -> bool {
        let (before, after) = (step.before.state, step.after().state);
        match self.claim {
            Claim::Leads { from, when, to } => {
                !from.contains(&before) || to.contains(&after) || !when.holds(step)
            }
            Claim::Only { from, to, when } => before != from || after != to || when.holds(step),
            Claim::Each { holds, .. } => holds(machine, step),
        }
    }

    /// Whether none but a look at each step tells whether it is kept, and no [word](Self::is_broken_in) of them.
    pub(crate) const fn needs_each_step(&self) -> bool {
        let (Claim::Leads { when, .. } | Claim::Only { when, .. }) = self.claim else { return true };
        !matches!(when, When::Inputs { .. })
    }

    /// Whether any step of a word breaks it, all of them out of a state that it concerns: of what is seen in them there are the
    /// planes, and `lead` has those that lead to a state.
    pub(crate) fn is_broken_in(&self, planes: &Planes, lead: &Led) -> bool {
        match self.claim {
            Claim::Leads { when: When::Inputs { on, off }, to, .. } => {
                planes.show(on, off) & !to.iter().fold(0, |there, &to| there | lead.to(to)) & lead.all() != 0
            }
            Claim::Only { when: When::Inputs { on, off }, to, .. } => {
                lead.to(to) & !planes.show(on, off) != 0
            }
            _ => false,
        }
    }

    /// The properties that an edition has, with their places in [`PROPERTIES`].
    pub(crate) fn of_edition(edition: &Edition) -> impl Iterator<Item = (usize, &'static Self)> {
        PROPERTIES.iter().enumerate().filter(move |(_, property)| (property.holds_in)(edition))
    }

    /// The properties of an edition to which steps from a state can matter, with their places in [`PROPERTIES`].
    pub(crate) fn of(edition: &Edition, state: AsState) -> &'static [(usize, &'static Self)] {
        type ByState = Vec<Vec<(usize, &'static Property)>>;

        static BY_STATE: LazyLock<Vec<ByState>> = LazyLock::new(|| {
            let of = |edition: &&Edition, state| {
                Property::of_edition(edition).filter(move |(_, property)| property.concerns(state)).collect()
            };
            let by_state = |edition| AsState::ALL.iter().map(|&state| of(edition, state)).collect();
            Edition::ALL.iter().map(by_state).collect()
        });
        let of_edition = BY_STATE.get(Document::of(edition).place);
        let place = AsState::ALL.iter().position(|&other| other == state);
        of_edition.and_then(|states| states.get(place?)).map_or(&[], Vec::as_slice)
    }

    /// Whether steps from a state can matter to the property.
    fn concerns(&self, state: AsState) -> bool {
        match self.claim {
            Claim::Leads { from, .. } => from.contains(&state),
            Claim::Only { from, .. } => from == state,
            Claim::Each { .. } => true,
        }
    }

    /// The inputs that the property looks at, in steps from a control state that it concerns and that may lead to these states.
    pub(crate) fn reads(&self, from: &Control, document: &Timing, to: impl Fn(AsState) -> bool) -> Atoms {
        match self.claim {
            Claim::Leads { when, .. } => when.reads(),
            Claim::Only { to: other, when, .. } if to(other) => when.reads(),
            Claim::Only { .. } => Atoms::NONE,
            Claim::Each { reads, .. } => reads(from, document),
        }
    }
}

/// Which steps of a word lead where: a bit each.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Led([u64; 8]);

impl Led {
    /// The step at this place of the word leads to a state.
    pub(crate) fn leads(&mut self, place: usize, to: AsState) {
        if let Some(there) = self.0.get_mut(to as usize) {
            *there |= 1 << place;
        }
    }

    /// Those that lead to a state.
    fn to(&self, to: AsState) -> u64 {
        self.0.get(to as usize).copied().unwrap_or_default()
    }

    /// All that there are.
    fn all(&self) -> u64 {
        self.0.iter().fold(0, |all, there| all | there)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_property_concerns_the_states_that_it_speaks_of() {
        for (name, states) in [
            ("figure-2-arrows", &AsState::ALL[..]),
            ("ready-switches", &[AsState::Off]),
            ("ready-sdc", &[AsState::Ready]),
        ] {
            let concerns = |state: AsState| {
                Property::of(Edition::DEFAULT, state).iter().any(|(_, one)| one.name == name)
            };
            let concerned: Vec<AsState> = AsState::ALL.into_iter().filter(|&state| concerns(state)).collect();
            assert_eq!(concerned, states, "{name}");
        }
    }
}
