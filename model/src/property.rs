//! What a property of the open model is: a claim about every step, with the inputs that it looks at.

use adsdv_spec::messages::AsState;
use adsdv_spec::{Atom, Atoms, Control, Edition, Machine, Timing};

use crate::step::Step;
use crate::steps::Steps;

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
        /// The steps that keep it, a bit each.
        holds: fn(&Machine, &Steps) -> u64,
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
        /// The steps of which it holds, a bit each.
        holds: fn(&Steps) -> u64,
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

    fn holds(self, steps: &Steps) -> u64 {
        match self {
            Self::Inputs { on, off } => steps.show(on, off),
            Self::Step { holds, .. } => holds(steps),
        }
    }

    fn reads(self) -> Atoms {
        match self {
            Self::Inputs { on, off } => on.union(off),
            Self::Step { reads, .. } => reads,
        }
    }
}

impl Property {
    /// Whether a step keeps the property.
    pub fn holds(&self, machine: &Machine, step: &Step) -> bool {
        self.broken_in(machine, &step.steps()) == 0
    }

    /// The steps that break the property, a bit each.
    pub fn broken_in(&self, machine: &Machine, steps: &Steps) -> u64 {
        let (before, after) = (steps.before.state, steps.after().state);
        steps.lanes()
            & match self.claim {
                Claim::Leads { from, when, to } if from.contains(&before) && !to.contains(&after) => {
                    when.holds(steps)
                }
                Claim::Only { from, to, when } if (before, after) == (from, to) => !when.holds(steps),
                Claim::Leads { .. } | Claim::Only { .. } => 0,
                Claim::Each { holds, .. } => !holds(machine, steps),
            }
    }

    /// Whether steps from a state can matter to the property.
    pub(crate) fn concerns(&self, state: AsState) -> bool {
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
