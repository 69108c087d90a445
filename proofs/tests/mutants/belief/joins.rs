//! One or another, and what covers what.

use adsdv_proofs::subject::Subject;
use adsdv_spec::belief::{Belief, Glimpse, Memory};

use crate::Mutant;

pub(crate) fn mutants() -> Vec<Mutant> {
    vec![
        Mutant::new("glimpses_are_joined", "the second counts", Second),
        Mutant::new("glimpses_are_joined", "nothing is known of either", Nothing),
        Mutant::new("memories_are_joined", "the second counts", Second),
        Mutant::new("memories_are_joined", "what covers the cause covers all", CausesAlone),
        Mutant::new("beliefs_are_joined", "the second counts", Second),
        Mutant::new("beliefs_are_joined", "what has as many states covers it", StatesAlone),
    ]
}

#[derive(Clone)]
struct Second;

impl Subject for Second {
    fn join_glimpses(&self, _: &Glimpse, other: &Glimpse) -> Glimpse {
        *other
    }

    fn join_memories(&self, _: Memory, other: Memory) -> Memory {
        other
    }

    fn join_beliefs(&self, _: Belief, other: &Belief) -> Belief {
        *other
    }
}

#[derive(Clone)]
struct Nothing;

impl Subject for Nothing {
    fn join_glimpses(&self, _: &Glimpse, _: &Glimpse) -> Glimpse {
        Glimpse::NOTHING
    }
}

#[derive(Clone)]
struct CausesAlone;

impl Subject for CausesAlone {
    fn memory_covers(&self, one: &Memory, other: &Memory) -> bool {
        one.shutdown_cause.covers(other.shutdown_cause)
    }
}

#[derive(Clone)]
struct StatesAlone;

impl Subject for StatesAlone {
    fn belief_covers(&self, one: &Belief, other: &Belief) -> bool {
        other.states().all(|state| one.memory(state).is_some())
    }
}
