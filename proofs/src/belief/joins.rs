//! One belief or another, and which of two allows more.

use adsdv_spec::Control;
use adsdv_spec::belief::{Belief, Memory};
use adsdv_spec::messages::AsState;

use super::around;
use crate::prelude::*;

/// Memories that may or may not cover those.
fn any_other(memory: Memory) -> Memory {
    if kani::any() { around::more_memories(memory) } else { around::memory(&around::any_control()) }
}

/// **One memory or another allows what either does, and covers both**; one covers the other exactly where joining them adds
/// nothing to it, and then allows all that it does.
///
/// Requirements: SM-1.
#[cfg_attr(kani, kani::proof, kani::unwind(2))]
pub fn memories_are_joined() {
    let control = around::any_control();
    let one = around::memory(&control);
    let other = any_other(one);
    let either = subject().join_memories(one, other);
    let covered = subject().memory_covers(&other, &one);
    kani::cover!(covered && one != other, "the other covers it");
    kani::cover!(!covered && other.in_state.covers(one.in_state), "the other does not cover it");
    assert!(one.allows(&control), "it is allowed");
    assert!(either.allows(&control), "what one allows");
    assert!(either == subject().join_memories(other, one), "whichever comes first");
    assert!(subject().memory_covers(&either, &one), "the one is covered");
    assert!(subject().memory_covers(&either, &other), "the other is covered");
    assert!(covered == (either == other), "covered is what adds nothing");
    assert!(!covered || other.allows(&control), "what covers it allows what it does");
}

/// A belief that allows this control state, and may allow another AS state. What is so of one AS state has nothing to do with
/// the others, so two are enough: one that is looked at, and one beside it.
fn any_belief_of(control: &Control, memory: Memory) -> Belief {
    let beside: AsState = kani::any();
    let belief = Belief::NONE.with(control.state, memory);
    if kani::any() && beside != control.state {
        belief.with(beside, around::memory(&around::any_control()))
    } else {
        belief
    }
}

/// **One belief or another allows what either does, and covers both; what covers a belief allows all that it does; and what is
/// left when the state is known is what is so of that state.**
///
/// Requirements: SM-1.
#[cfg_attr(kani, kani::proof, kani::unwind(7))]
pub fn beliefs_are_joined() {
    let control = around::any_control();
    let memory = around::memory(&control);
    let one = any_belief_of(&control, memory);
    let other_control = around::any_control();
    let other = if kani::any() {
        any_belief_of(&control, any_other(memory))
    } else {
        any_belief_of(&other_control, around::memory(&other_control))
    };
    let either = subject().join_beliefs(one, &other);
    let covered = subject().belief_covers(&other, &one);
    kani::cover!(covered && one != other, "the other covers it");
    kani::cover!(either.allows(&other_control) && other_control.state != control.state, "two states");
    assert!(one.allows(&control), "it is allowed");
    assert!(either.allows(&control), "what one allows");
    assert!(either == subject().join_beliefs(other, &one), "whichever comes first");
    assert!(subject().belief_covers(&either, &one), "the one is covered");
    assert!(subject().belief_covers(&either, &other), "the other is covered");
    assert!(covered == (either == other), "covered is what adds nothing");
    assert!(!covered || other.allows(&control), "what covers it allows what it does");
    let state: AsState = kani::any();
    let left = either.given(state);
    assert!(left.allows(&control) == (control.state == state), "what is left is of that state");
    assert!(left.memory(state) == either.memory(state), "and all that is so of it");
}

theorems![memories_are_joined, beliefs_are_joined];
