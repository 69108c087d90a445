//! Programs that err: machines in this process with another hand on their outputs.

use adsdv_conform::protocol::{About, Protocol, Shown};
use adsdv_conform::suite::{Scenario, Step};
use adsdv_conform::{InProcess, ProgramError, Reply, Vcu};
use adsdv_spec::{Control, Edition, Inputs, Machine};
use serde_json::{Map, Value, json};

/// The outputs of a step, by their keys.
pub(crate) type Outputs = Map<String, Value>;

/// A program that errs.
pub(crate) struct Erring {
    pub(crate) machine: Machine,
    /// How many steps late its outputs are.
    pub(crate) late: usize,
    /// Whether it shows nothing before the first of them, instead of AS_OFF.
    pub(crate) nothing: bool,
    /// What is done to the outputs of a step, from 0, with these inputs.
    pub(crate) tampers: fn(usize, &Inputs, &mut Outputs),
    /// In so many scenarios; after that it is right.
    pub(crate) for_scenarios: usize,
}

impl Erring {
    /// One that does not err yet.
    pub(crate) fn new(machine: &Machine) -> Self {
        Self { machine: *machine, late: 0, nothing: false, tampers: |_, _, _| {}, for_scenarios: usize::MAX }
    }

    fn replies(&self, scenario: &Scenario) -> Vec<Reply> {
        let answers = scenario.shown(&self.machine).zip(&scenario.steps).enumerate();
        let answers = answers.map(|(place, (shown, step))| self.tampered(place, &step.inputs, &shown));
        std::iter::repeat_n(self.first(), self.late).chain(answers).take(scenario.steps.len()).collect()
    }

    /// The answer to a step in which the machine shows this.
    fn tampered(&self, place: usize, inputs: &Inputs, shown: &Shown) -> Reply {
        let mut outputs: Outputs = serde_json::from_str(&shown.to_string()).expect("an object");
        if self.for_scenarios > 0 {
            (self.tampers)(place, inputs, &mut outputs);
        }
        answer(outputs, &Protocol::of(self.machine.edition()))
    }

    /// What it shows before it has anything to show.
    fn first(&self) -> Reply {
        let off = Outputs::from_iter([("as_state".to_owned(), json!("AS_OFF"))]);
        if self.nothing { Reply::Nothing } else { answer(off, &Protocol::of(self.machine.edition())) }
    }
}

fn answer(outputs: Outputs, protocol: &Protocol) -> Reply {
    Reply::Answer(protocol.answer(&Value::Object(outputs).to_string()).expect("an answer"))
}

impl Vcu for Erring {
    fn hello(&mut self, edition: &Edition) -> Result<About, ProgramError> {
        InProcess(self.machine).hello(edition)
    }

    fn ask(
        &mut self,
        scenarios: &[(&str, &Scenario)],
        answered: &mut dyn FnMut(usize, &[Reply]),
    ) -> Result<(), ProgramError> {
        for (place, (_, scenario)) in scenarios.iter().enumerate() {
            answered(place, &self.replies(scenario));
            self.for_scenarios = self.for_scenarios.saturating_sub(1);
        }
        Ok(())
    }

    fn ask_in_turn(
        &mut self,
        _: &str,
        next: &mut dyn FnMut(usize, Option<&Reply>) -> Option<Step>,
    ) -> Result<Vec<Reply>, ProgramError> {
        let (mut control, mut replies) = (Control::INITIAL, vec![self.first(); self.late]);
        let mut place = 0;
        while let Some(step) = next(place, place.checked_sub(1).and_then(|last| replies.get(last))) {
            let (after, outputs) = self.machine.step(&control, &step.inputs, step.dt_ms);
            control = after;
            let shown = Shown::of(self.machine.edition(), &outputs, &step.inputs);
            replies.push(self.tampered(place, &step.inputs, &shown));
            place += 1;
        }
        self.for_scenarios = self.for_scenarios.saturating_sub(1);
        replies.truncate(place);
        Ok(replies)
    }

    fn end(&mut self) -> Result<Vec<String>, ProgramError> {
        Ok(vec!["it has ended".to_owned()])
    }
}
