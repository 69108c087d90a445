//! The arrows that may be taken, one after the other.

use crate::machine::{Machine, Taken};
use crate::messages::AsState;
use crate::truth::{Knowledge, Truth};

/// What may be taken, and what is known then.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Outcome {
    /// The alternative, and where it leads; `None` if the state stays.
    pub taken: Option<(Taken, AsState)>,
    /// What was known before, with what this tells: that the guard holds, and the ones before it do not.
    pub known: Knowledge,
}

/// What there is to say of one arrow when none before it is taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Look {
    /// That it is taken, if it may be.
    pub outcome: Option<Outcome>,
    /// What is known when it is not, if it may be passed over: it goes on with the next arrow.
    pub rest: Option<Knowledge>,
}

impl Machine {
    /// What may be taken from a state, as far as is known: each arrow that may be the first whose guard holds, and at last that
    /// the state stays, each with what is known then.
    pub const fn outcomes(&self, from: AsState, known: Knowledge) -> Outcomes<'_> {
        Outcomes { machine: self, from, place: 0, rest: Some(known) }
    }

    /// The arrow at a place in the order of evaluation, when this is known and none before it is taken. Behind the last arrow
    /// the state stays.
    pub fn look(&self, from: AsState, place: usize, known: Knowledge) -> Look {
        let Some((masks, taken)) = self.arrow_at(from, place) else {
            return Look { outcome: Some(Outcome { taken: None, known }), rest: None };
        };
        let taken = Some(Outcome { taken: Some(taken), known: masks.given(known) });
        match masks.truth(known) {
            Truth::True => Look { outcome: taken, rest: None },
            Truth::Unknown => Look { outcome: taken, rest: Some(masks.refuted(known)) },
            Truth::False => Look { outcome: None, rest: Some(known) },
        }
    }
}

/// See [`Machine::outcomes`].
#[derive(Clone, Debug)]
pub struct Outcomes<'a> {
    machine: &'a Machine,
    from: AsState,
    place: usize,
    /// What is known when nothing before that place is taken; `None` when something is.
    rest: Option<Knowledge>,
}

impl Iterator for Outcomes<'_> {
    type Item = Outcome;

    fn next(&mut self) -> Option<Outcome> {
        while let Some(known) = self.rest {
            let Look { outcome, rest } = self.machine.look(self.from, self.place, known);
            (self.place, self.rest) = (self.place + 1, rest);
            if outcome.is_some() {
                return outcome;
            }
        }
        None
    }
}
