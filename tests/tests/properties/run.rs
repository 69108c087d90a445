//! A run takes place: the VCU steps, and properties see each step.

use adsdv_spec::{Control, Inputs, Machine, Outputs};

use crate::operations::{Operation, Run};

/// What there is to see of a step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Seen<'a> {
    /// When, in milliseconds since the run began.
    pub(crate) t_ms: u64,
    /// The time since the step before.
    pub(crate) dt_ms: u32,
    /// What the VCU saw.
    pub(crate) inputs: &'a Inputs,
    /// What it showed.
    pub(crate) outputs: &'a Outputs,
    /// The power was switched off and on since the step before.
    pub(crate) power_cycled: bool,
}

/// Something that has to hold at every step of a run. It remembers what it needs to.
pub(crate) trait Property {
    /// What is wrong at this step, if something is.
    fn see(&mut self, seen: &Seen<'_>) -> Result<(), String>;
}

/// Holds always: for a run that is written to its end.
pub(crate) struct Silent;

impl Property for Silent {
    fn see(&mut self, _: &Seen<'_>) -> Result<(), String> {
        Ok(())
    }
}

/// A run in the middle.
#[derive(Clone, Debug)]
pub(crate) struct Bench {
    machine: Machine,
    cycle_ms: u32,
    pub(crate) control: Control,
    pub(crate) inputs: Inputs,
    /// The AI Computer answers the handshake.
    answers: bool,
    power_cycled: bool,
    pub(crate) t_ms: u64,
}

/// What happens during a run, in order.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Event<'a> {
    /// Somebody does something at this time.
    Done(u64, Operation),
    /// A step.
    Step(Seen<'a>),
}

impl Bench {
    /// At the beginning: everything off, the AI Computer running.
    pub(crate) fn new(machine: &Machine, cycle_ms: u32) -> Self {
        Self {
            machine: *machine,
            cycle_ms,
            control: Control::INITIAL,
            inputs: Inputs::default(),
            answers: true,
            power_cycled: false,
            t_ms: 0,
        }
    }

    /// An operation takes place. `event` says when it has seen enough.
    pub(crate) fn perform<E>(
        &mut self,
        operation: Operation,
        event: &mut impl FnMut(Event<'_>) -> Result<(), E>,
    ) -> Result<(), E> {
        operation.act(&mut self.inputs);
        if operation.actor().is_some() {
            event(Event::Done(self.t_ms, operation))?;
        }
        match operation {
            Operation::Answers(answers) => self.answers = answers,
            Operation::PowerCycle => {
                self.control = Control::INITIAL;
                self.power_cycled = true;
            }
            Operation::Wait(ms) => {
                let mut left = ms;
                while left > 0 {
                    let dt_ms = left.min(self.cycle_ms);
                    left -= dt_ms;
                    self.step(dt_ms, event)?;
                }
            }
            Operation::Set(..) | Operation::Wheels(_) => {}
        }
        Ok(())
    }

    /// A step, this long after the one before.
    fn step<E>(&mut self, dt_ms: u32, event: &mut impl FnMut(Event<'_>) -> Result<(), E>) -> Result<(), E> {
        if self.answers {
            self.inputs.ai.status.handshake = self.control.handshake.bit;
        }
        let (control, outputs) = self.machine.step(&self.control, &self.inputs, dt_ms);
        self.control = control;
        self.t_ms += u64::from(dt_ms);
        let power_cycled = std::mem::take(&mut self.power_cycled);
        let (inputs, outputs) = (&self.inputs, &outputs);
        event(Event::Step(Seen { t_ms: self.t_ms, dt_ms, inputs, outputs, power_cycled }))
    }
}

/// A run of this machine from beginning to end.
pub(crate) fn play<E>(
    machine: &Machine,
    run: &Run,
    event: &mut impl FnMut(Event<'_>) -> Result<(), E>,
) -> Result<Bench, E> {
    let mut bench = Bench::new(machine, run.cycle_ms);
    for &operation in &run.operations {
        bench.perform(operation, event)?;
    }
    Ok(bench)
}

/// Whether a property holds during a run of this machine, and what is wrong if it does not.
pub(crate) fn keeps(machine: &Machine, run: &Run, property: &mut impl Property) -> Result<(), String> {
    let mut see = |event: Event<'_>| match event {
        Event::Done(..) => Ok(()),
        Event::Step(seen) => property.see(&seen),
    };
    play(machine, run, &mut see).map(drop)
}
