//! What stateright asks of the open model: where it begins, where each state leads, and what has to hold.
//!
//! Stateright knows properties as functions without data, so there is one function for each place in a list.

use std::sync::atomic::Ordering;

use adsdv_spec::{Control, Edition};
use stateright::Model;

use super::{Open, State};
use crate::action::Action;
use crate::document::Document;
use crate::goals::goals;
use crate::properties::PROPERTIES;
use crate::property::Property;

impl Model for Open {
    type State = State;
    type Action = Action;

    fn init_states(&self) -> Vec<State> {
        vec![State::new(Control::INITIAL)]
    }

    /// One action to each state that comes next: the look has tried all of them.
    fn actions(&self, state: &State, actions: &mut Vec<Action>) {
        actions.extend_from_slice(&self.look(state).ways);
        self.seen.expanded.fetch_add(1, Ordering::Relaxed);
    }

    fn next_state(&self, state: &State, action: Action) -> Option<State> {
        Some(State::new(action.apply(&self.machine, &state.control)))
    }

    fn properties(&self) -> Vec<stateright::Property<Self>> {
        if self.unasked { vec![to_the_end()] } else { questions(Document::of_machine(&self.machine).edition) }
    }
}

type Condition = fn(&Open, &State) -> bool;

fn keeps<const PLACE: usize>(model: &Open, state: &State) -> bool {
    model.look(state).broken >> PLACE & 1 == 0
}

fn reaches<const PLACE: usize>(model: &Open, state: &State) -> bool {
    model.look(state).reached >> PLACE & 1 == 1
}

macro_rules! by_place {
    ($function:ident: $($place:literal)*) => { [$($function::<$place>),*] };
}

/// For each place in [`PROPERTIES`].
const KEEPS: [Condition; 48] = by_place!(keeps:
    0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21 22 23 24 25 26 27 28 29 30 31
    32 33 34 35 36 37 38 39 40 41 42 43 44 45 46 47);
/// For each place in the list of an edition's goals.
const REACHES: [Condition; 24] = by_place!(reaches:
    0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21 22 23);
const _: () = assert!(PROPERTIES.len() <= KEEPS.len());
const _: () = {
    let mut place = 0;
    while place < Edition::ALL.len() {
        let edition = Edition::ALL[place];
        let goals = 1 + edition.rules.table.rows().len() + edition.faults.len();
        assert!(goals <= REACHES.len(), "a function for each goal");
        place += 1;
    }
};

/// The properties and goals of an edition as stateright knows them.
fn questions(edition: &Edition) -> Vec<stateright::Property<Open>> {
    let always = Property::of_edition(edition).filter_map(|(place, property)| {
        Some(stateright::Property::always(property.name, *KEEPS.get(place)?))
    });
    let sometimes = goals(edition).iter().zip(REACHES);
    let sometimes = sometimes.map(|(goal, reaches)| stateright::Property::sometimes(goal.name, reaches));
    always.chain(sometimes).chain([to_the_end()]).collect()
}

/// A property that looks at every state and cannot fail, so that a run in which everything else has failed still goes to its
/// end.
fn to_the_end() -> stateright::Property<Open> {
    stateright::Property::always("to-the-end", |model, state| {
        model.look(state);
        true
    })
}
