//! A search that keeps whole states: slower than stateright's, which keeps fingerprints, and exact.

use std::collections::HashSet;

use adsdv_spec::{Control, Machine, Timing};
use stateright::Model;

use crate::action::Action;
use crate::open::Open;
use crate::vectors::Vectors;

/// Every control state that a machine can reach with these input vectors; `document` has the times that the properties
/// speak of.
pub fn reachable(machine: &Machine, document: Timing, vectors: Vectors) -> HashSet<Control> {
    let model = Open::new(*machine, document, vectors);
    let mut level = model.init_states();
    let mut seen: HashSet<Control> = level.iter().map(|state| *state.control()).collect();
    let mut actions: Vec<Action> = Vec::new();
    while !level.is_empty() {
        let mut next = Vec::new();
        for state in &level {
            model.actions(state, &mut actions);
            let after = actions.drain(..).filter_map(|action| model.next_state(state, action));
            next.extend(after.filter(|after| seen.insert(*after.control())));
        }
        level = next;
    }
    seen
}
