//! Programs that err: machines in this process with another hand on their outputs.

use adsdv_oracle::conform::{InProcess, ProgramError, Reply, Vcu};
use adsdv_oracle::protocol::Protocol;
use adsdv_oracle::suite::Scenario;
use adsdv_spec::{Edition, Inputs, Machine};
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
        let protocol = Protocol::of(self.machine.edition());
        let tampered = scenario.shown(&self.machine).zip(&scenario.steps).enumerate();
        let answers = tampered.map(|(place, (shown, step))| {
            let mut outputs: Outputs = serde_json::from_str(&shown.to_string()).expect("an object");
            if self.for_scenarios > 0 {
                (self.tampers)(place, &step.inputs, &mut outputs);
            }
            answer(outputs, &protocol)
        });
        let off = Outputs::from_iter([("as_state".to_owned(), json!("AS_OFF"))]);
        let first = if self.nothing { Reply::Nothing } else { answer(off, &protocol) };
        std::iter::repeat_n(first, self.late).chain(answers).take(scenario.steps.len()).collect()
    }
}

fn answer(outputs: Outputs, protocol: &Protocol) -> Reply {
    Reply::Answer(protocol.answer(&Value::Object(outputs).to_string()).expect("an answer"))
}

impl Vcu for Erring {
    fn hello(&mut self, edition: &Edition) -> Result<(), ProgramError> {
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

    fn end(&mut self) -> Result<Vec<String>, ProgramError> {
        Ok(vec!["it has ended".to_owned()])
    }
}
