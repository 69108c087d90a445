//! Some of the records, which stand for all: as many as it takes to tell explanations from each other.

use adsdv_spec::messages::AsState;

use crate::fit::Fit;
use crate::model::{Memory, Model};
use crate::record::Kept;

/// So many records are looked at that show what is not explained in a state, and as many in which all is that was done there.
const IN_THE_STATE: usize = 500;
/// The same of all others.
const ELSEWHERE: usize = 250;

impl<'a> Fit<'a> {
    /// The same search by some of the records: those that tell most about what is not explained in a state.
    pub(crate) fn sampled(&self, state: AsState, known: &Model) -> Self {
        let mut kinds: [Vec<&'a Kept>; 4] = Default::default();
        for record in &self.records {
            let OfAState { wrong, passes } = of_a_state(record, known, state);
            let place = usize::from(passes) * 2 + usize::from(wrong);
            if let Some(kind) = kinds.get_mut(place) {
                kind.push(record);
            }
        }
        let [right_elsewhere, wrong_elsewhere, right, wrong] = kinds;
        let all = [
            (right_elsewhere, ELSEWHERE),
            (wrong_elsewhere, ELSEWHERE),
            (right, IN_THE_STATE),
            (wrong, IN_THE_STATE),
        ];
        let some = all.into_iter().flat_map(|(records, most)| {
            let every = records.len().div_ceil(most).max(1);
            records.into_iter().step_by(every)
        });
        Self::of(self.edition, some.collect(), self.candidates, self.until)
    }
}

/// What a record shows of a state.
struct OfAState {
    /// Whether a model explains it wrongly: there, or anywhere if the program was not there.
    wrong: bool,
    /// Whether the program was there.
    passes: bool,
}

fn of_a_state(record: &Kept, model: &Model, state: AsState) -> OfAState {
    let mut memory = Memory::INITIAL;
    let (mut passes, mut there, mut elsewhere) = (false, false, false);
    for (step, reply) in record.steps.iter().zip(&record.replies) {
        let (outputs, after) = model.follow(&memory, &step.inputs, step.dt_ms, reply);
        let wrong = !reply.agrees(&model.shown(&outputs, &step.inputs));
        let own = memory.control.state == state;
        passes |= own;
        there |= own && wrong;
        elsewhere |= wrong;
        memory = after;
    }
    OfAState { wrong: if passes { there } else { elsewhere }, passes }
}
