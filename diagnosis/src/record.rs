//! What was asked, and what was answered.

use adsdv_oracle::conform::ProgramError;
use adsdv_oracle::protocol::{Answer, Difference, Shown};
use adsdv_oracle::suite::Step;

use crate::model::{Memory, Model};
use crate::subject::Subject;

/// Steps from power-on, each with its answer.
#[derive(Clone, Debug, Default)]
pub struct Record {
    /// The steps, in order.
    pub steps: Vec<Step>,
    /// The answers to them.
    pub replies: Vec<Answer>,
}

impl Record {
    /// What a program answers to steps from power-on.
    pub fn of(subject: &mut dyn Subject, steps: &[Step]) -> Result<Self, ProgramError> {
        subject.reset()?;
        let replies: Result<_, _> = steps.iter().map(|step| subject.step(step.dt_ms, &step.inputs)).collect();
        Ok(Self { steps: steps.to_vec(), replies: replies? })
    }

    /// For how many steps a model does the same.
    pub fn agrees(&self, model: &Model) -> usize {
        let mut memory = Memory::INITIAL;
        let agrees = |(step, reply): (&Step, &Answer)| {
            let (after, outputs) = model.step(&memory, &step.inputs, step.dt_ms);
            memory = after;
            reply.agrees(&model.shown(&outputs, &step.inputs))
        };
        self.steps.iter().zip(&self.replies).map(agrees).take_while(|agrees| *agrees).count()
    }

    /// Whether a model explains all answers.
    pub fn is_explained(&self, model: &Model) -> bool {
        self.agrees(model) == self.replies.len()
    }

    /// The first wrong answer by a model: its place, and what is shown there instead.
    pub fn wrong(&self, model: &Model) -> Option<(usize, Memory, Shown)> {
        let mut memory = Memory::INITIAL;
        for (place, (step, reply)) in self.steps.iter().zip(&self.replies).enumerate() {
            let (after, outputs) = model.step(&memory, &step.inputs, step.dt_ms);
            let shown = model.shown(&outputs, &step.inputs);
            if !reply.agrees(&shown) {
                return Some((place, memory, shown));
            }
            memory = after;
        }
        None
    }

    /// In which outputs the answer to a step differs from these.
    pub(crate) fn differences(&self, place: usize, shown: &Shown) -> Vec<Difference> {
        self.replies.get(place).map_or(Vec::new(), |reply| reply.differences(shown).collect())
    }
}
