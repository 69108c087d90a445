//! What was asked, and what was answered.

use std::collections::HashMap;
use std::hash::{DefaultHasher, Hash as _, Hasher as _};
use std::sync::Arc;

use adsdv_conform::ProgramError;
use adsdv_conform::protocol::Answer;
use adsdv_conform::suite::Step;

use crate::deviation::LATEST;
use crate::model::{Memory, Model};
use crate::subject::Subject;

/// Of like steps so many stay one by one at first: an arrow that is late is taken in one of them.
const FIRST: usize = LATEST as usize + 1;
/// Fewer like steps than these are kept one by one.
const FEWEST: usize = FIRST + 4;

/// Steps from power-on, each with its answer.
#[derive(Clone, Debug, Default)]
pub struct Record {
    /// The steps, in order.
    pub steps: Vec<Step>,
    /// The answers to them.
    pub replies: Vec<Answer>,
}

impl Record {
    /// The same with like steps, as those of a fixed cycle are, as one that takes as long, which is as good for an explanation.
    ///
    /// What is answered alternates with the handshake, so that a step is like the one before the last; an odd number of them leaves
    /// the handshake as one does.
    pub(crate) fn joined(&self) -> Self {
        let Self { steps, replies } = self;
        let is_like = |place: usize| {
            let before = place.checked_sub(2);
            before.is_some_and(|before| {
                steps.get(before) == steps.get(place) && replies.get(before) == replies.get(place)
            })
        };
        let mut all = Self::default();
        let mut place = 0;
        while let (Some(step), Some(reply)) = (steps.get(place), replies.get(place)) {
            all.steps.push(*step);
            all.replies.push(*reply);
            let like = 2 + (place + 2..steps.len()).take_while(|next| is_like(*next)).count();
            place += 1;
            if like < FEWEST {
                continue;
            }
            for kept in place..place + FIRST - 1 {
                all.steps.extend(steps.get(kept));
                all.replies.extend(replies.get(kept));
            }
            place += FIRST - 1;
            // The last stays as it is.
            let joined = (like - FIRST - 1) - usize::from((like - FIRST) % 2 == 1);
            if let (Some(first), Some(last)) = (steps.get(place), replies.get(place + joined - 1)) {
                let count = u32::try_from(joined).unwrap_or(u32::MAX);
                all.steps.push(Step { dt_ms: first.dt_ms.saturating_mul(count), ..*first });
                all.replies.push(*last);
                place += joined;
            }
        }
        all
    }

    /// What a program answers to steps from power-on.
    ///
    /// # Errors
    ///
    /// Fails if the program does not answer to a step.
    pub fn of(subject: &mut dyn Subject, steps: &[Step]) -> Result<Self, ProgramError> {
        Ok(Self { steps: steps.to_vec(), replies: subject.steps(steps)? })
    }

    /// For how many steps a model does the same.
    pub fn agrees(&self, model: &Model) -> usize {
        let mut memory = Memory::INITIAL;
        let agrees = |(step, reply): (&Step, &Answer)| {
            let (after, outputs) = model.step(&memory, &step.inputs, step.dt_ms);
            memory = after;
            reply.differing_in(&model.values(&outputs, &step.inputs)) == 0
        };
        self.steps.iter().zip(&self.replies).map(agrees).take_while(|agrees| *agrees).count()
    }

    /// Whether a model explains all answers.
    pub fn is_explained(&self, model: &Model) -> bool {
        self.agrees(model) == self.replies.len()
    }
}

/// A record as it is kept: what is answered again and again is kept once.
#[derive(Clone, Debug)]
pub(crate) struct Kept {
    pub(crate) steps: Vec<Step>,
    pub(crate) replies: Vec<Arc<Answer>>,
    /// For each step a number that stands for it and its answer.
    pub(crate) marks: Vec<u64>,
}

impl Kept {
    /// Whether a model explains all answers.
    pub(crate) fn is_explained(&self, model: &Model) -> bool {
        let mut memory = Memory::INITIAL;
        self.steps.iter().zip(&self.replies).all(|(step, reply)| {
            let (after, outputs) = model.step(&memory, &step.inputs, step.dt_ms);
            memory = after;
            reply.differing_in(&model.values(&outputs, &step.inputs)) == 0
        })
    }

    /// As a record.
    pub(crate) fn record(&self) -> Record {
        let replies = self.replies.iter().map(|reply| **reply).collect();
        Record { steps: self.steps.clone(), replies }
    }
}

fn mark(step: &Step, reply: &Arc<Answer>) -> u64 {
    let mut hasher = DefaultHasher::new();
    (step.dt_ms, &step.inputs, Arc::as_ptr(reply)).hash(&mut hasher);
    hasher.finish()
}

/// All that was asked and answered, as far as it is kept.
#[derive(Clone, Debug, Default)]
pub(crate) struct Records {
    kept: Vec<Kept>,
    answers: HashMap<Answer, Arc<Answer>>,
    /// How many steps are kept.
    steps: usize,
    /// How many records there were.
    pub(crate) count: usize,
}

impl Records {
    /// No more steps than these are kept: of the records before, those go first that are the oldest.
    const MOST: usize = 600_000;

    /// Keeps some more.
    pub(crate) fn extend(&mut self, records: impl IntoIterator<Item = Record>) {
        for Record { steps, replies } in records {
            self.steps += steps.len();
            self.count += 1;
            let answers = &mut self.answers;
            let kept = |reply: Answer| answers.entry(reply).or_insert_with(|| Arc::new(reply)).clone();
            let replies: Vec<Arc<Answer>> = replies.into_iter().map(kept).collect();
            let marks = steps.iter().zip(&replies).map(|(step, reply)| mark(step, reply)).collect();
            self.kept.push(Kept { steps, replies, marks });
        }
        let mut old = 0;
        while self.steps > Self::MOST
            && let Some(record) = self.kept.get(old)
        {
            self.steps -= record.steps.len();
            old += 1;
        }
        self.kept.drain(..old);
    }

    /// Those that a model does not explain.
    pub(crate) fn unexplained(&self, model: &Model) -> Vec<Record> {
        self.kept.iter().filter(|record| !record.is_explained(model)).map(Kept::record).collect()
    }

    /// Those that are kept.
    pub(crate) fn kept(&self) -> &[Kept] {
        &self.kept
    }
}
