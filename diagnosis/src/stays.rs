//! What a program did while it was in a state, each time by itself: what it does there does not depend on how it got there, but
//! for what it remembers.

use std::collections::HashSet;
use std::hash::{DefaultHasher, Hash as _, Hasher as _};
use std::ops::Range;
use std::sync::Arc;

use adsdv_conform::protocol::Answer;
use adsdv_conform::suite::Step;
use adsdv_spec::messages::AsState;

use crate::model::{Memory, Model};
use crate::record::Kept;

/// A wrong state counts as much as so many wrong outputs.
const WRONG_STATE: usize = 4;

/// Steps for as long as a state lasts, and the one that ends it.
#[derive(Clone, Debug)]
pub(crate) struct Stay<'a> {
    /// What the program remembers before the first, by the model that it was cut with.
    begins: Memory,
    steps: &'a [Step],
    replies: &'a [Arc<Answer>],
}

impl Stay<'_> {
    /// How many steps it has.
    pub(crate) const fn len(&self) -> usize {
        self.steps.len()
    }

    /// How much of it a model does not explain.
    pub(crate) fn wrong(&self, model: &Model) -> usize {
        self.points(model).sum()
    }

    /// Whether a model explains all of it.
    pub(crate) fn is_right(&self, model: &Model) -> bool {
        self.points(model).all(|points| points == 0)
    }

    /// Whether less of it is not explained by a model than this.
    pub(crate) fn is_less_wrong(&self, model: &Model, than: usize) -> bool {
        let mut wrong = 0;
        self.points(model).all(|points| {
            wrong += points;
            wrong < than
        })
    }

    /// How much a model does not explain of each step, one after the other.
    fn points(&self, model: &Model) -> impl Iterator<Item = usize> {
        let mut memory = self.begins;
        self.steps.iter().zip(self.replies).map(move |(step, reply)| {
            let (outputs, after) = model.follow(&memory, &step.inputs, step.dt_ms, reply);
            memory = after;
            match reply.differing_in(&model.values(&outputs, &step.inputs)) {
                0 => 0,
                differing if outputs.state == after.control.state => differing.min(WRONG_STATE - 1),
                _ => WRONG_STATE,
            }
        })
    }

    /// The first wrong answer by a model: what it shows there, and the answer.
    pub(crate) fn first_wrong(&self, model: &Model) -> Option<Wrong> {
        let mut memory = self.begins;
        for (step, reply) in self.steps.iter().zip(self.replies) {
            let (outputs, after) = model.follow(&memory, &step.inputs, step.dt_ms, reply);
            let shown = model.shown(&outputs, &step.inputs);
            if !reply.agrees(&shown) {
                let differences: Vec<_> = reply.differences(&shown).collect();
                let values =
                    differences.iter().map(|one| (one.key, one.expected.raw, one.found.raw)).collect();
                let right = model.right(&outputs, &step.inputs);
                let rights = differences.iter().map(|one| right.get(one.key).and_then(|value| value.raw));
                let rights = rights.collect();
                let (expected, found) = (outputs.state, after.control.state);
                return Some(Wrong { from: memory, expected, found, values, rights });
            }
            memory = after;
        }
        None
    }
}

/// A wrong answer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Wrong {
    /// What is remembered before it.
    pub(crate) from: Memory,
    /// The state that the model goes to.
    pub(crate) expected: AsState,
    /// The state that the program goes to.
    pub(crate) found: AsState,
    /// The outputs that differ: the key, what the model shows, and what the answer says.
    pub(crate) values: Vec<(&'static str, Option<i32>, Option<i32>)>,
    /// What each of them would be if nothing was shown wrongly.
    pub(crate) rights: Vec<Option<i32>>,
}

impl Wrong {
    /// Whether both are wrong in the same way.
    pub(crate) fn is_like(&self, other: &Self) -> bool {
        let of = |wrong: &Self| (wrong.from.control.state, wrong.expected, wrong.found);
        of(self) == of(other) && self.values == other.values
    }
}

/// The stays in each state, each only once, cut with a model: it tells what is remembered when a state begins.
pub(crate) fn cut<'a>(records: &[&'a Kept], model: &Model) -> Vec<(AsState, Vec<Stay<'a>>)> {
    let mut stays: Vec<(AsState, Vec<Stay<'a>>)> = AsState::ALL.map(|state| (state, Vec::new())).to_vec();
    let mut known: HashSet<u64> = HashSet::new();
    for record in records {
        let mut add = |begins: Memory, range: Range<usize>| {
            let state = begins.control.state;
            let of =
                (record.steps.get(range.clone()), record.replies.get(range.clone()), record.marks.get(range));
            let (Some(steps), Some(replies), Some(marks)) = of else { return };
            let mut hasher = DefaultHasher::new();
            begins.hash(&mut hasher);
            // Marks are as good as random.
            let mix =
                |hash: u64, mark: &u64| (hash.rotate_left(5) ^ mark).wrapping_mul(0x9e37_79b9_7f4a_7c15);
            if !steps.is_empty()
                && known.insert(marks.iter().fold(hasher.finish(), mix))
                && let Some((_, own)) = stays.iter_mut().find(|(own, _)| *own == state)
            {
                own.push(Stay { begins, steps, replies });
            }
        };
        let (mut memory, mut begins, mut start) = (Memory::INITIAL, Memory::INITIAL, 0);
        for (place, (step, reply)) in record.steps.iter().zip(&record.replies).enumerate() {
            let after = model.follow(&memory, &step.inputs, step.dt_ms, reply).1;
            if after.control.state != memory.control.state {
                add(begins, start..place + 1);
                (begins, start) = (after, place + 1);
            }
            memory = after;
        }
        add(begins, start..record.steps.len());
    }
    stays
}

#[cfg(test)]
mod tests {
    use adsdv_spec::Edition;

    use super::*;
    use crate::deviation::Deviation;
    use crate::diagnose::records;
    use crate::interface::Interface;
    use crate::record::Records;
    use crate::sets::everywhere;

    #[test]
    fn where_stays_begin_depends_on_a_cause_that_is_shown_as_another_and_not_on_which() {
        let edition = &Edition::V3_0;
        let cause = |value, raw| [Deviation::Writes { key: "shutdown_cause", value, raw }];
        let program = Model::new(edition, &cause(3, 11));
        let mut kept = Records::default();
        kept.extend(
            records(&mut program.clone().running(), &program, &Interface::default())
                .expect("a model answers everything"),
        );
        let kept: Vec<&Kept> = kept.kept().iter().collect();
        let cut = |set: &[Deviation]| {
            let stays = cut(&kept, &Model::new(edition, set));
            let begin = |stay: &Stay<'_>| (stay.begins, stay.len());
            stays.iter().map(|(_, own)| own.iter().map(begin).collect::<Vec<_>>()).collect::<Vec<_>>()
        };
        let (one, other) = (cause(3, 11), cause(1, 5));
        assert_eq!(everywhere(edition, &one), everywhere(edition, &other));
        assert_eq!(cut(&one), cut(&other));
        let both = [one, other].concat();
        assert_eq!((everywhere(edition, &both), cut(&both)), (everywhere(edition, &one), cut(&one)));
        assert_ne!(everywhere(edition, &[]), everywhere(edition, &one));
        assert_ne!(cut(&[]), cut(&one));
    }
}
