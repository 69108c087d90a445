//! What a judge may say who does not see everything: three-valued truth is sound.
//!
//! A judge knows some conditions and not others, and of a window of time only that on which all of its moments agree. What
//! it calls true or false then is so in every case that it allows; so no violation is reported that did not happen.

use adsdv_spec::{Atom, Atoms, Choices, Knowledge, Readings, Row, Term, Truth};

use crate::prelude::*;

/// A term of these conditions. What else a term says does not matter here.
fn term(on: Atoms, off: Atoms) -> Term {
    const ANY: Term = EDITION.rules.table.rows()[0].terms()[0];
    Term { on, off, readings: Choices::NONE, ..ANY }
}

/// Any term, also one that the table does not have.
fn any_term() -> Term {
    term(kani::any(), kani::any())
}

/// Whether a term holds when exactly these atoms do.
fn holds(term: &Term, atoms: Atoms) -> bool {
    term.on.is_subset(atoms) && term.off.intersection(atoms).is_empty()
}

/// Any atoms that may hold, as far as is known.
fn any_allowed(known: Knowledge) -> Atoms {
    let unseen: Atoms = kani::any();
    known.on().union(unseen.difference(known.off()))
}

/// What is said of one claim or another.
fn either(one: Truth, other: Truth) -> Truth {
    subject().join(one, other).1
}

/// Whether a claim allows a fact.
fn fits(claim: Truth, fact: bool) -> bool {
    match claim {
        Truth::True => fact,
        Truth::False => !fact,
        Truth::Unknown => true,
    }
}

/// **A term that is called true is true, and one that is called false is false**, for every term and for whatever the unseen
/// conditions are.
///
/// Requirements: SM-1, SM-18.
#[cfg_attr(kani, kani::proof, kani::unwind(2))]
pub fn a_term_is_called_what_it_is() {
    let (term, known): (Term, Knowledge) = (any_term(), kani::any());
    let atoms = any_allowed(known);
    let called = subject().truth(&term, known);
    kani::cover!(called == Truth::True && !term.on.is_empty() && known != Knowledge::exact(atoms), "true");
    kani::cover!(called == Truth::False && known.on().is_empty(), "false");
    kani::cover!(called == Truth::Unknown, "unknown");
    assert!(known.allows(atoms), "what is tried is allowed");
    assert!(fits(called, holds(&term, atoms)), "what is said of the term is so");
}

/// **Unknown is said only where both are possible**: some allowed conditions make the term hold, and some do not. A judge
/// that said less than it knows would miss violations.
///
/// Requirements: SM-1.
#[cfg_attr(kani, kani::proof, kani::unwind(2))]
pub fn unknown_comes_only_where_both_are_possible() {
    let (term, known): (Term, Knowledge) = (any_term(), kani::any());
    // A term that asks for an atom to be on and off is no alternative of any guard.
    kani::assume(term.on.intersection(term.off).is_empty());
    kani::assume(subject().truth(&term, known) == Truth::Unknown);
    let so = known.on().union(term.on);
    let not_so = known.on().union(term.off.difference(known.off()));
    kani::cover!(!term.on.is_empty() && !term.off.is_empty(), "a term with conditions of both kinds");
    assert!(known.allows(so) && holds(&term, so), "it can hold");
    assert!(known.allows(not_so) && !holds(&term, not_so), "it can fail to hold");
}

/// **AND, OR and agreement of claims are sound**: what is said of both, of either, and of whichever it was, is so for all
/// facts that the two claims allow.
///
/// Requirements: SM-1.
#[cfg_attr(kani, kani::proof, kani::unwind(2))]
pub fn claims_are_joined_soundly() {
    let (one, other): (Truth, Truth) = (kani::any(), kani::any());
    let (a, b): (bool, bool) = (kani::any(), kani::any());
    kani::assume(fits(one, a) && fits(other, b));
    let (both, either, whichever) = subject().join(one, other);
    kani::cover!(both == Truth::False && one == Truth::Unknown, "one failing is enough for AND");
    kani::cover!(either == Truth::True && other == Truth::Unknown, "one holding is enough for OR");
    kani::cover!(whichever == Truth::Unknown, "they may disagree");
    assert!(fits(both, a && b), "AND");
    assert!(fits(either, a || b), "OR");
    assert!(fits(whichever, a) && fits(whichever, b), "agreement");
}

/// **What is learnt and forgotten is what is known.** After it, exactly the conditions are allowed that agree with what
/// was learnt, and with what was known of the others.
///
/// Requirements: SM-1.
#[cfg_attr(kani, kani::proof, kani::unwind(2))]
pub fn knowledge_is_what_was_learnt() {
    let (known, scope, values): (Knowledge, Atoms, Atoms) = (kani::any(), kani::any(), kani::any());
    let atoms: Atoms = kani::any();
    let others = known.forget(scope);
    let learnt = subject().learn(known, scope, values);
    let agrees = atoms.intersection(scope) == values.intersection(scope);
    kani::cover!(
        learnt.allows(atoms) && !known.allows(atoms),
        "what was known before does not count any more"
    );
    assert!(
        learnt.allows(atoms) == (agrees && others.allows(atoms)),
        "what is learnt is known, the rest as before"
    );
    assert!(!known.allows(atoms) || others.allows(atoms), "to forget excludes nothing");
    assert!(learnt.on().intersection(learnt.off()).is_empty(), "nothing is both");
    assert!(
        Knowledge::exact(values).allows(atoms) == (atoms == values),
        "to know everything allows one case"
    );
    assert!(
        Knowledge::new(scope, values).is_some() == scope.intersection(values).is_empty(),
        "nothing is said to be on and off"
    );
}

/// **One condition is set to what is said of it, and the others stay**: true, false, or unknown again.
///
/// Requirements: SM-1.
#[cfg_attr(kani, kani::proof, kani::unwind(2))]
pub fn one_condition_is_set_and_the_others_stay() {
    let (known, value): (Knowledge, Truth) = (kani::any(), kani::any());
    let (atom, other): (Atom, Atom) = (kani::any(), kani::any());
    let set = subject().set(known, atom, value);
    kani::cover!(value == Truth::Unknown && known.of(atom) != Truth::Unknown, "it is forgotten");
    kani::cover!(atom != other && known.of(other) == Truth::False, "another one is known");
    assert!(set.of(atom) == value, "what is said of it");
    assert!(atom == other || set.of(other) == known.of(other), "the others stay");
}

/// **A guard that is called true over a window holds at every moment of it, and one that is called false at none**: for any
/// guard of three terms and any three moments, whatever was not seen at each of them.
///
/// Requirements: SM-1, SM-18.
#[cfg_attr(kani, kani::proof, kani::unwind(5))]
pub fn a_guard_over_a_window_is_called_what_it_is() {
    let guard = [any_term(), any_term(), any_term()];
    let seen: [Knowledge; 3] = [kani::any(), kani::any(), kani::any()];
    let window = subject().meet(subject().meet(seen[0], seen[1]), seen[2]);
    let mut called = Truth::False;
    for term in &guard {
        called = either(called, subject().truth(term, window));
    }
    kani::cover!(called == Truth::True && seen[0] != seen[1], "true, over different moments");
    kani::cover!(called == Truth::False && seen[0] != seen[1], "false, over different moments");
    for known in &seen {
        let atoms = any_allowed(*known);
        assert!(window.allows(atoms), "the window allows what each of its moments allows");
        let fact = holds(&guard[0], atoms) || holds(&guard[1], atoms) || holds(&guard[2], atoms);
        assert!(fits(called, fact), "what is said of the guard is so at this moment");
    }
}

/// What is said of a row of Figure 2, under the default readings.
fn row_truth(row: &Row, known: Knowledge) -> Truth {
    let mut called = Truth::False;
    for term in row.terms() {
        if term.readings.is_subset(Readings::DEFAULT.choices()) {
            called = either(called, subject().truth(term, known));
        }
    }
    called
}

/// **The VCU of the specification is never blamed.** Whatever a judge saw of the conditions of a step, it does not call the
/// guard of the arrow that was taken false, nor an earlier one true; and where the state stayed, it calls no guard true.
///
/// Requirements: SM-1, SM-18.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn a_true_step_is_never_blamed() {
    let Step { before, outputs, .. } = any_step();
    // All that the judge has seen is so; the rest it does not know.
    let seen: Atoms = kani::any();
    let known = Knowledge::exact(outputs.atoms).forget(Atoms::ALL.difference(seen));
    let mut over = false;
    for (place, row) in (0u8..).zip(EDITION.rules.table.rows()) {
        if row.from != before.state || over {
            continue;
        }
        let called = row_truth(row, known);
        if outputs.taken.is_some_and(|taken| taken.row == place) {
            kani::cover!(called == Truth::True, "the arrow is justified");
            kani::cover!(called == Truth::Unknown, "nobody knows");
            assert!(called != Truth::False, "what was taken was not forbidden");
            // What comes later was overtaken.
            over = true;
        } else {
            kani::cover!(called == Truth::False, "another arrow was forbidden");
            assert!(called != Truth::True, "what was not taken was not due");
        }
    }
}

theorems![
    a_term_is_called_what_it_is,
    unknown_comes_only_where_both_are_possible,
    knowledge_is_what_was_learnt,
    one_condition_is_set_and_the_others_stay,
    a_guard_over_a_window_is_called_what_it_is,
    a_true_step_is_never_blamed;
    every claims_are_joined_soundly,
];
