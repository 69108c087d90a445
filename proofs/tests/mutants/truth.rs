//! What the theorems of `truth.rs` catch: judges that claim too much, or too little.

use adsdv_proofs::subject::Subject;
use adsdv_spec::{Atom, Atoms, Knowledge, Term, Truth};

use crate::Mutant;

pub(crate) fn mutants() -> Vec<Mutant> {
    vec![
        Mutant::new("a_term_is_called_what_it_is", "what is not known to fail holds", Hopes),
        Mutant::new("unknown_comes_only_where_both_are_possible", "nothing is ever called false", Doubts),
        Mutant::new("claims_are_joined_soundly", "an unknown does not count", Joins),
        Mutant::new("knowledge_is_what_was_learnt", "what is learnt to be off is forgotten", LearnsOn),
        Mutant::new("one_condition_is_set_and_the_others_stay", "what is unknown again is off", SetsOff),
        Mutant::new("a_guard_over_a_window_is_called_what_it_is", "OR is AND", OrIsAnd),
        Mutant::new("a_guard_over_a_window_is_called_what_it_is", "the last moment counts", LastCounts),
        Mutant::new("a_true_step_is_never_blamed", "what is not known to fail holds", Hopes),
    ]
}

/// A term that may hold is said to hold.
#[derive(Clone)]
struct Hopes;

impl Subject for Hopes {
    fn truth(&self, term: &Term, known: Knowledge) -> Truth {
        match term.truth(known) {
            Truth::Unknown => Truth::True,
            called => called,
        }
    }
}

/// A term that cannot hold is said to be unknown.
#[derive(Clone)]
struct Doubts;

impl Subject for Doubts {
    fn truth(&self, term: &Term, known: Knowledge) -> Truth {
        match term.truth(known) {
            Truth::False => Truth::Unknown,
            called => called,
        }
    }
}

/// Of two claims, the one that says something is taken.
#[derive(Clone)]
struct Joins;

impl Subject for Joins {
    fn join(&self, one: Truth, other: Truth) -> (Truth, Truth, Truth) {
        let whichever = if one == Truth::Unknown { other } else { one };
        (one.and(other), one.or(other), whichever)
    }
}

/// Of two moments of a window, only the later one counts.
#[derive(Clone)]
struct LastCounts;

impl Subject for LastCounts {
    fn meet(&self, _: Knowledge, other: Knowledge) -> Knowledge {
        other
    }
}

/// Of what is learnt, only what is on is kept.
#[derive(Clone)]
struct LearnsOn;

impl Subject for LearnsOn {
    fn learn(&self, known: Knowledge, scope: Atoms, values: Atoms) -> Knowledge {
        known.forget(scope).learn(scope.intersection(values), values)
    }
}

/// What is to be unknown again is said to be off.
#[derive(Clone)]
struct SetsOff;

impl Subject for SetsOff {
    fn set(&self, known: Knowledge, atom: Atom, value: Truth) -> Knowledge {
        known.set(atom, if value == Truth::Unknown { Truth::False } else { value })
    }
}

/// Either is said only of what is said of both.
#[derive(Clone)]
struct OrIsAnd;

impl Subject for OrIsAnd {
    fn join(&self, one: Truth, other: Truth) -> (Truth, Truth, Truth) {
        (one.and(other), one.and(other), one.agree(other))
    }
}
