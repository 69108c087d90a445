//! What can happen to the VCU within a cycle.

use adsdv_spec::{Control, Machine, Observation};

use crate::cycle::cycle_ms;

/// One action of the open model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Action {
    /// The VCU steps, and sees this.
    Step(Observation),
    /// The vehicle's power is cycled: the VCU begins anew.
    PowerCycle,
}

impl Action {
    /// The control state of a machine after the action.
    pub fn apply(self, machine: &Machine, control: &Control) -> Control {
        match self {
            Self::Step(seen) => machine.react(control, seen, cycle_ms(machine)).control,
            Self::PowerCycle => Control::INITIAL,
        }
    }
}
