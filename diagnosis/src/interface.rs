//! What a program has of the protocol: no other input is given to it, and no other output of it is compared.

use adsdv_conform::ProgramError;
use adsdv_conform::protocol::{About, Answer, INPUTS, InputField, SHOWN, Shown};
use adsdv_conform::suite::Step;
use adsdv_spec::{Choice, Choices, Inputs, Reading};

use crate::subject::Subject;

/// The output that every program shows.
const AS_STATE: &str = "as_state";

/// At a fixed cycle one experiment of so many by chance is done.
const SPARING: usize = 12;

/// The inputs and the outputs that a program has; by default all.
#[derive(Clone, Debug, Default)]
pub struct Interface {
    /// The inputs that it does not have: they stay at their defaults.
    lacking: Vec<&'static InputField>,
    /// The outputs that are compared; `None`: all that it shows.
    outputs: Option<Vec<&'static str>>,
    /// The answers to the document's questions that are allowed for; `None`: all.
    possible: Option<Choices>,
    /// The one time that a step of it takes, in milliseconds; `None`: any.
    cycle_ms: Option<u32>,
}

impl Interface {
    /// Those that a program announces, without the outputs that it never shows.
    pub fn new(about: &About, not_shown: &[&str]) -> Self {
        let announced =
            |keys: &Option<Vec<&str>>, key: &str| keys.as_ref().is_none_or(|keys| keys.contains(&key));
        let lacking = INPUTS.iter().filter(|field| !announced(&about.inputs, field.key)).collect();
        let is_compared =
            |key: &&str| *key == AS_STATE || announced(&about.outputs, key) && !not_shown.contains(key);
        let outputs: Vec<&str> = SHOWN.iter().map(|field| field.key).filter(is_compared).collect();
        let outputs = Some(outputs).filter(|outputs| outputs.len() < SHOWN.len());
        Self { lacking, outputs, possible: None, cycle_ms: None }
    }

    /// The same of a program that steps at a fixed cycle, in milliseconds. It is asked for fewer experiments, each of which takes
    /// many steps, and a time of it is known no better than to the cycle.
    /// What takes less than a cycle it cannot be asked for.
    #[must_use]
    pub fn at_cycle(self, cycle_ms: Option<u32>) -> Self {
        Self { cycle_ms: cycle_ms.filter(|cycle| *cycle > 0), ..self }
    }

    /// The fixed cycle of the program, if it has one.
    pub(crate) const fn cycle_ms(&self) -> Option<u32> {
        self.cycle_ms
    }

    /// How many steps of the program take so long.
    pub(crate) fn cycles(&self, dt_ms: u32) -> usize {
        let cycles = self.cycle_ms.map_or(1, |cycle_ms| dt_ms.div_ceil(cycle_ms).max(1));
        usize::try_from(cycles).unwrap_or(usize::MAX)
    }

    /// So many experiments of those that a program that steps at any time is asked for.
    pub(crate) const fn fewer(&self, many: usize) -> usize {
        if self.cycle_ms.is_some() { many.div_ceil(SPARING) } else { many }
    }

    /// The same of a program that may follow these answers to the document's questions alone.
    #[must_use]
    pub fn allowing(self, possible: Choices) -> Self {
        Self { possible: Some(possible), ..self }
    }

    /// The answers to a question that a program may follow.
    pub(crate) fn answers(&self, reading: Reading) -> impl Iterator<Item = Choice> + '_ {
        let possible = |choice: &Choice| self.possible.is_none_or(|possible| possible.has(*choice));
        reading.choices().iter().copied().filter(possible)
    }

    /// The same without some of the outputs.
    #[must_use]
    pub fn without(&self, outputs: &[&str]) -> Self {
        let all = || SHOWN.iter().map(|field| field.key).collect();
        let mut left = self.outputs.clone().unwrap_or_else(all);
        left.retain(|key| !outputs.contains(key));
        Self { outputs: Some(left), ..self.clone() }
    }

    /// Whether the program has the input with this key.
    pub(crate) fn has(&self, key: &str) -> bool {
        !self.lacking.iter().any(|field| field.key == key)
    }

    /// The inputs as the program can be given them: what it does not have is at its default.
    pub(crate) fn held(&self, mut inputs: Inputs) -> Inputs {
        for field in &self.lacking {
            (field.set)(&mut inputs, (field.get)(&Inputs::default()));
        }
        inputs
    }

    /// An answer without the outputs that are not compared.
    pub(crate) fn compared(&self, answer: &Answer) -> Answer {
        match &self.outputs {
            Some(outputs) => answer.among(outputs),
            None => *answer,
        }
    }

    /// Whether two machines show the same, as far as it is compared.
    pub(crate) fn are_alike(&self, one: &Shown, other: &Shown) -> bool {
        one == other || self.outputs.is_some() && self.compared(&Answer::from(*one)).agrees(other)
    }
}

/// A program of which only the outputs are seen that are compared.
pub(crate) struct Seen<'a> {
    pub(crate) subject: &'a mut dyn Subject,
    pub(crate) interface: &'a Interface,
}

impl Subject for Seen<'_> {
    fn reset(&mut self) -> Result<(), ProgramError> {
        self.subject.reset()
    }

    fn step(&mut self, dt_ms: u32, inputs: &Inputs) -> Result<Answer, ProgramError> {
        self.subject.step(dt_ms, inputs).map(|answer| self.interface.compared(&answer))
    }

    fn steps(&mut self, steps: &[Step]) -> Result<Vec<Answer>, ProgramError> {
        let answers = self.subject.steps(steps)?;
        Ok(answers.iter().map(|answer| self.interface.compared(answer)).collect())
    }

    fn is_waited_for(&self) -> bool {
        self.subject.is_waited_for()
    }
}
