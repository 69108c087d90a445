//! Steps made 64 at a time.
//!
//! A control state has few that come next. Steps that lead to the same one come in groups: its control state is made once, by
//! one step, and what a property says of it without a look at the inputs is asked once.

use adsdv_network::{Key, Network};
use adsdv_spec::{Control, Faults, Reaction};

use super::{Looker, Shown};
use crate::action::Action;
use crate::cycle::cycle_ms;
use crate::planes::Words;
use crate::property::Property;
use crate::steps::Steps;

/// Steps that come to the same.
struct Group {
    key: Key,
    /// What one of them does, but for the faults that it shows.
    reaction: Reaction,
    /// The properties that look at the inputs of such steps, a bit for each place in the list of properties.
    open: Vec<(usize, &'static Property)>,
}

impl Looker {
    pub(super) fn in_words(&self, network: &Network, control: &Control, vectors: &Words) -> Shown {
        let wired = network.at(control, cycle_ms(&self.machine));
        let properties = self.properties(control);
        let mut groups: Vec<Group> = Vec::new();
        let (mut broken, mut next) = (0, Vec::new());
        for (word, planes) in vectors.words() {
            let mut new: Vec<(u32, usize)> = Vec::new();
            wired.groups(planes, |key, lanes| {
                let (place, lane) =
                    (groups.iter().position(|group| group.key == key), lanes.trailing_zeros());
                let steps_of =
                    |reaction| Steps::of_word(self.document, &self.timing, control, planes, lanes, reaction);
                if let Some((place, group)) = place.and_then(|place| Some((place, groups.get(place)?))) {
                    // Two rows of a table may lead to the same state.
                    if let Some((first, _)) = new.iter_mut().find(|(_, new)| *new == place) {
                        *first = lane.min(*first);
                    }
                    let steps = steps_of(&group.reaction);
                    for (place, property) in &group.open {
                        broken |= u64::from(property.broken_in(&self.machine, &steps) != 0) << place;
                    }
                    return;
                }
                let seen = word.get(lane as usize).copied().unwrap_or_default();
                let reaction = Reaction {
                    faults: Faults::NONE,
                    ..self.machine.react(control, seen, cycle_ms(&self.machine))
                };
                let steps = steps_of(&reaction);
                let open = properties.iter().copied().filter(|(place, property)| {
                    broken |= u64::from(property.broken_in(&self.machine, &steps) != 0) << place;
                    steps.were_looked_at()
                });
                let open = open.collect();
                new.push((lane, groups.len()));
                groups.push(Group { key, reaction, open });
            });
            // In the order of the vectors, as if they had been tried one by one.
            new.sort_unstable();
            for (lane, place) in new {
                let (Some(group), Some(&seen)) = (groups.get(place), word.get(lane as usize)) else {
                    continue;
                };
                let after = group.reaction.control;
                if !next.iter().any(|(other, _)| *other == after) {
                    next.push((after, Action::Step(seen)));
                }
            }
        }
        (broken, next)
    }
}
