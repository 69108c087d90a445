//! Steps of a VCU from power-on.

use adsdv_spec::{Control, Inputs, Machine, Outputs};

use crate::protocol::{Request, Shown};

/// One step of a scenario.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Step {
    /// The time since the last step, or since power-on, in milliseconds.
    pub dt_ms: u32,
    /// What the VCU sees.
    pub inputs: Inputs,
}

/// Steps of a VCU, the first of them after its power-on.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Scenario {
    /// The steps, in order.
    pub steps: Vec<Step>,
}

impl Scenario {
    /// What a machine does at each step.
    pub fn run<'a>(&'a self, machine: &'a Machine) -> impl Iterator<Item = (Control, Outputs)> + 'a {
        self.steps.iter().scan(Control::INITIAL, move |control, step| {
            let (after, outputs) = machine.step(control, &step.inputs, step.dt_ms);
            *control = after;
            Some((after, outputs))
        })
    }

    /// What a machine shows at each step.
    pub fn shown<'a>(&'a self, machine: &'a Machine) -> impl Iterator<Item = Shown> + 'a {
        self.run(machine)
            .zip(&self.steps)
            .map(|((_, outputs), step)| Shown::of(machine.edition(), &outputs, &step.inputs))
    }

    /// The lines with which a program under test is asked for it, a reset first.
    pub fn requests(&self) -> impl Iterator<Item = Request> + '_ {
        let steps = self.steps.iter().map(|&Step { dt_ms, inputs }| Request::Step { dt_ms, inputs });
        std::iter::once(Request::Reset).chain(steps)
    }
}
