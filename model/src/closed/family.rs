//! Closed models that differ in the readings of their VCU alone, explored together.
//!
//! Under most answers to a question the VCU does most things as under the others, so that an exploration of each answer looks at
//! the same states again and again. Here a state is looked at once for all members of the family that come to it: with it
//! goes which they are, a bit each ([`search`]), and only where the VCU's cycle comes to different things do they part.
//!
//! It finds what [`Closed::explore`] finds of each member, which is the reference.

use std::sync::atomic::{AtomicU64, Ordering};

use stateright::{Expectation, Model as _};

use super::properties::{self, ClosedProperty};
use super::{Closed, ClosedAction, ClosedState};
use crate::search::{Arrivals, MEMBERS, search};

/// What the exploration of a family found.
#[derive(Clone, Debug)]
pub struct FamilyExploration {
    /// The properties that fail, each with the place of the member in which it does.
    pub failed: Vec<(&'static ClosedProperty, usize)>,
    /// How many different states each member has, all together.
    pub states: u64,
    /// How many times a state was reached from another one in each member, all together.
    pub transitions: u64,
    /// Whether every state of every member was looked at. Without this, nothing is verified.
    pub complete: bool,
}

/// Explores every state of each of these models, of which there are at most [`MEMBERS`] and which differ in the readings of their
/// machine alone, with this many threads, and decides every property of their operator.
///
/// ```
/// use adsdv_model::closed::{Closed, Operator, explore_family};
/// use adsdv_spec::{Choice, Edition};
///
/// let edition = Edition::DEFAULT;
/// let with = |choice| Closed::scaled(*edition, edition.readings.with(choice), Operator::WellBehaved);
/// let found = explore_family(&[Choice::FaultEdge, Choice::GoRaw].map(with), 2);
/// assert!(found.complete && found.failed.is_empty());
/// ```
pub fn explore_family(members: &[Closed], threads: usize) -> FamilyExploration {
    let members = members.get(..MEMBERS).unwrap_or(members);
    let everyone = (0..members.len()).fold(0, |all, member| all | 1 << member);
    let properties: Vec<_> =
        members.first().map_or_else(Vec::new, |one| properties::properties_of(one.operator).collect());
    let family =
        Family { members, found: properties.iter().map(|_| AtomicU64::new(0)).collect(), properties };
    let begin = members.first().map_or_else(Vec::new, Closed::init_states);
    let begin = begin.into_iter().map(|state| (state, everyone));
    let searched = search(begin, threads, |state: &ClosedState, members, arrivals| {
        family.look(state, members, arrivals);
    });
    let failed = family.properties.iter().zip(&family.found).flat_map(|(&property, found)| {
        let found = found.load(Ordering::Relaxed);
        let failing = if property.expectation == Expectation::Sometimes { everyone & !found } else { found };
        bits(failing).map(move |member| (property, member))
    });
    FamilyExploration {
        failed: failed.collect(),
        states: searched.states,
        transitions: searched.reached,
        complete: searched.complete,
    }
}

struct Family<'a> {
    members: &'a [Closed],
    properties: Vec<&'static ClosedProperty>,
    /// For each property, the members that have shown it: that it can fail, or that it can happen.
    found: Vec<AtomicU64>,
}

impl Family<'_> {
    /// Looks at a state for these members.
    fn look(&self, state: &ClosedState, members: u64, arrivals: &mut Arrivals<ClosedState>) {
        // What can happen goes by the state alone, and so does what comes of it but for the VCU's cycle.
        let mut actions = Vec::new();
        let Some(first) = self.any_of(members) else { return };
        first.actions(state, &mut actions);
        let cycle = actions.contains(&ClosedAction::VcuCycle);
        let groups = if cycle { self.groups(state, members) } else { vec![members] };
        for group in groups {
            let Some(model) = self.any_of(group) else { continue };
            if cycle && let Some(after) = model.next_state(state, ClosedAction::VcuCycle) {
                arrivals.add(after, group);
            }
            for (property, found) in self.properties.iter().zip(&self.found) {
                let shown = match property.expectation {
                    Expectation::Always => !property.holds_in(model, state),
                    // The condition is latched: the end of a path says whether it held on it.
                    Expectation::Eventually => actions.is_empty() && !property.holds_in(model, state),
                    Expectation::Sometimes => property.holds_in(model, state),
                };
                if shown && found.load(Ordering::Relaxed) & group != group {
                    found.fetch_or(group, Ordering::Relaxed);
                }
            }
        }
        let others = actions.into_iter().filter(|action| *action != ClosedAction::VcuCycle);
        for after in others.filter_map(|action| first.next_state(state, action)) {
            arrivals.add(after, members);
        }
    }

    /// These members by what comes of the VCU's cycle.
    fn groups(&self, state: &ClosedState, members: u64) -> Vec<u64> {
        let mut groups = Vec::new();
        for member in bits(members) {
            let Some(model) = self.members.get(member) else { continue };
            let (control, outputs, _) = model.step(state);
            match groups.iter_mut().find(|(comes_to, _)| *comes_to == (control, outputs)) {
                Some((_, group)) => *group |= 1 << member,
                None => groups.push(((control, outputs), 1 << member)),
            }
        }
        groups.into_iter().map(|(_, group)| group).collect()
    }

    /// One of these members.
    fn any_of(&self, members: u64) -> Option<&Closed> {
        self.members.get(bits(members).next()?)
    }
}

/// The places of the bits that are set.
fn bits(mut word: u64) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let place = (word != 0).then(|| word.trailing_zeros() as usize)?;
        word &= word - 1;
        Some(place)
    })
}

#[cfg(test)]
mod tests {
    use adsdv_spec::{Edition, Readings};

    use super::*;
    use crate::closed::{Conduct, Operator};
    use crate::document::state_machines;

    /// A model for each answer that is not the default, and one for all of them together.
    fn members(edition: &Edition, operator: Operator, conduct: Conduct) -> Vec<Closed> {
        let others = edition.alternatives();
        let together = others.iter().fold(edition.readings, Readings::with);
        let alone = others.iter().map(|choice| edition.readings.with(choice));
        let models = alone.chain([together]).map(|readings| Closed::scaled(*edition, readings, operator));
        models.map(|model| model.with_conduct(conduct)).collect()
    }

    /// What fails, by name and member, how many states there are, and how many ways.
    type Gist = (Vec<(&'static str, usize)>, u64, u64);

    fn together(members: &[Closed]) -> Gist {
        let found = explore_family(members, 2);
        assert!(found.complete);
        let failed = found.failed.iter().map(|(property, member)| (property.name, *member));
        (failed.collect(), found.states, found.transitions)
    }

    /// As stateright finds it, one after the other.
    fn apart(members: &[Closed]) -> Gist {
        let found: Vec<_> = members.iter().map(|model| model.clone().explore(2)).collect();
        let all = found.iter().enumerate().flat_map(|(member, found)| {
            found.results.iter().enumerate().map(move |(place, found)| (place, member, found))
        });
        let mut failed: Vec<_> = all.filter(|(_, _, found)| !found.holds).collect();
        failed.sort_by_key(|(place, member, _)| (*place, *member));
        let failed = failed.into_iter().map(|(_, member, found)| (found.property.name, member)).collect();
        let sum = |of: &dyn Fn(&crate::closed::ClosedExploration) -> usize| {
            found.iter().map(of).sum::<usize>() as u64
        };
        (failed, sum(&|found| found.states), sum(&|found| found.transitions))
    }

    #[test]
    fn a_family_shows_what_each_of_its_members_shows_alone() {
        let check = |members: &[Closed]| {
            let found = together(members);
            assert_eq!(found, apart(members), "{:?}", members.first().map(|model| model.conduct));
            found.0.len()
        };
        for edition in state_machines() {
            assert_eq!(check(&members(edition, Operator::WellBehaved, Conduct::Reference)), 0);
        }
        for conduct in [Conduct::Mute, Conduct::Hasty, Conduct::Coasting] {
            let members = members(Edition::DEFAULT, Operator::WellBehaved, conduct);
            assert!(check(&members.into_iter().step_by(4).collect::<Vec<_>>()) > 0, "{conduct:?}");
        }
    }

    #[test]
    fn those_beyond_the_most_are_left_out_and_none_at_all_is_no_harm() {
        let nobody = together(&[]);
        assert_eq!(nobody, (Vec::new(), 0, 0));
        let one = Closed::scaled(*Edition::DEFAULT, Readings::DEFAULT, Operator::WellBehaved);
        let most = vec![one; MEMBERS];
        let more: Vec<Closed> = most.iter().chain(&most).cloned().collect();
        assert_eq!(together(&more), together(&most));
    }
}
