//! Closed models that differ in the readings of their VCU alone, explored together.
//!
//! Under most answers to a question the VCU does most things as under the others, so that an exploration of each answer looks at
//! the same states again and again. Here a state is looked at once for all members of the family that come to it: with it
//! goes which they are, a bit each, and only where the VCU's cycle comes to different things do they part. A state is looked at
//! again for those members alone that had not been there.
//!
//! It finds what [`Closed::explore`] finds of each member, which is the reference.

use std::collections::HashMap;
use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::thread;

use ahash::RandomState;
use stateright::{Expectation, Model as _};

use super::properties::{self, ClosedProperty};
use super::{Closed, ClosedAction, ClosedState};

/// How many members a family has at most: a bit for each.
pub const MEMBERS: usize = u64::BITS as usize;

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
/// let found = explore_family(&[Choice::FaultEdge, Choice::GoLevel].map(with), 2);
/// assert!(found.complete && found.failed.is_empty());
/// ```
pub fn explore_family(members: &[Closed], threads: usize) -> FamilyExploration {
    let members = members.get(..MEMBERS).unwrap_or(members);
    let everyone = u64::MAX.checked_shr((MEMBERS - members.len()) as u32).unwrap_or(0);
    let family = Family {
        members,
        seen: Seen::default(),
        properties: members
            .first()
            .map_or_else(Vec::new, |one| properties::properties_of(one.operator).collect()),
        looked_at: AtomicU64::new(0),
        reached: AtomicU64::new(0),
    };
    let mut level = Vec::new();
    let mut begin = Arrivals::default();
    for state in members.first().map_or_else(Vec::new, Closed::init_states) {
        begin.add(state, everyone);
    }
    family.reached.fetch_add(begin.count(), Ordering::Relaxed);
    family.seen.take_in(&mut begin, &mut level);
    // What was found of each property, a bit for each member.
    let mut found = vec![0; family.properties.len()];
    while !level.is_empty() {
        level = family.next_level(&level, threads.max(1), &mut found);
    }
    let failed = family.properties.iter().zip(found).flat_map(|(&property, found)| {
        let failing = if property.expectation == Expectation::Sometimes { everyone & !found } else { found };
        bits(failing).map(move |member| (property, member))
    });
    let states = family.seen.states();
    FamilyExploration {
        failed: failed.collect(),
        states,
        transitions: family.reached.into_inner(),
        complete: family.looked_at.into_inner() == states,
    }
}

/// A state, and the members that have come to it and had not been there before.
type Visit = (ClosedState, u64);

struct Family<'a> {
    members: &'a [Closed],
    properties: Vec<&'static ClosedProperty>,
    seen: Seen,
    /// In how many states members were looked at.
    looked_at: AtomicU64,
    /// How many times members came to a state.
    reached: AtomicU64,
}

impl Family<'_> {
    /// All that comes next, and what of the properties is seen on the way.
    fn next_level(&self, level: &[Visit], threads: usize, found: &mut [u64]) -> Vec<Visit> {
        /// Visits that a thread takes at once.
        const AT_ONCE: usize = 1024;
        let taken = AtomicUsize::new(0);
        let work = || {
            let (mut next, mut found) = (Vec::new(), vec![0; self.properties.len()]);
            let mut arrivals = Arrivals::default();
            loop {
                let begin = taken.fetch_add(AT_ONCE, Ordering::Relaxed);
                let Some(rest) = level.get(begin..).filter(|rest| !rest.is_empty()) else { break };
                for (state, members) in rest.iter().take(AT_ONCE) {
                    self.look(state, *members, &mut arrivals, &mut found);
                }
                self.reached.fetch_add(arrivals.count(), Ordering::Relaxed);
                self.seen.take_in(&mut arrivals, &mut next);
            }
            (next, found)
        };
        let threads = threads.min(level.len().div_ceil(AT_ONCE));
        let done: Vec<_> = if threads < 2 {
            vec![work()]
        } else {
            thread::scope(|scope| {
                let running: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
                running.into_iter().filter_map(|one| one.join().ok()).collect()
            })
        };
        let mut all = Vec::new();
        for (next, by_thread) in done {
            all.extend(next);
            for (all, one) in found.iter_mut().zip(by_thread) {
                *all |= one;
            }
        }
        all
    }

    /// Looks at a state for these members.
    fn look(&self, state: &ClosedState, members: u64, arrivals: &mut Arrivals, found: &mut [u64]) {
        self.looked_at.fetch_add(u64::from(members.count_ones()), Ordering::Relaxed);
        // What can happen goes by the state alone, and so does what comes of it but for the VCU's cycle.
        let mut actions = Vec::new();
        let Some((_, first)) = self.any_of(members) else { return };
        first.actions(state, &mut actions);
        let groups = if actions.contains(&ClosedAction::VcuCycle) {
            self.groups(state, members)
        } else {
            vec![members]
        };
        for &group in &groups {
            let Some((_, model)) = self.any_of(group) else { continue };
            if actions.contains(&ClosedAction::VcuCycle)
                && let Some(after) = model.next_state(state, ClosedAction::VcuCycle)
            {
                arrivals.add(after, group);
            }
            for (property, found) in self.properties.iter().zip(&mut *found) {
                let shows = match property.expectation {
                    Expectation::Always => !property.holds_in(model, state),
                    // The condition is latched: the end of a path says whether it held on it.
                    Expectation::Eventually => actions.is_empty() && !property.holds_in(model, state),
                    Expectation::Sometimes => property.holds_in(model, state),
                };
                *found |= if shows { group } else { 0 };
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
    fn any_of(&self, members: u64) -> Option<(usize, &Closed)> {
        let member = bits(members).next()?;
        Some((member, self.members.get(member)?))
    }
}

/// Members that come to states, which nobody has looked up yet.
struct Arrivals {
    visits: Vec<Visit>,
    /// By the shard that knows them, their hashes and their places among the visits.
    by_shard: Vec<Vec<(u64, usize)>>,
    hasher: RandomState,
}

/// So many that threads seldom wait for one another.
const SHARDS: usize = 64;

impl Default for Arrivals {
    fn default() -> Self {
        // The same in every run, and in every thread.
        let hasher = RandomState::with_seeds(1, 2, 3, 4);
        Self { visits: Vec::new(), by_shard: vec![Vec::new(); SHARDS], hasher }
    }
}

impl Arrivals {
    fn add(&mut self, state: ClosedState, members: u64) {
        let hash = self.hasher.hash_one(&state);
        if let Some(shard) = self.by_shard.get_mut(hash as usize % SHARDS) {
            shard.push((hash, self.visits.len()));
            self.visits.push((state, members));
        }
    }

    /// How many members come to a state, all together.
    fn count(&self) -> u64 {
        self.visits.iter().map(|(_, members)| u64::from(members.count_ones())).sum()
    }
}

/// Which members have come to which state. States are told apart by their hashes alone, as stateright does.
struct Seen {
    shards: Vec<Mutex<HashMap<u64, u64, RandomState>>>,
}

impl Default for Seen {
    fn default() -> Self {
        Self { shards: (0..SHARDS).map(|_| Mutex::default()).collect() }
    }
}

impl Seen {
    /// Takes in who has arrived: a state is next for those members that had not come to it.
    fn take_in(&self, arrivals: &mut Arrivals, next: &mut Vec<Visit>) {
        let Arrivals { visits, by_shard, .. } = arrivals;
        for (shard, arrived) in self.shards.iter().zip(by_shard) {
            // What a panic elsewhere left behind is whole: members are only ever added.
            let mut shard = shard.lock().unwrap_or_else(PoisonError::into_inner);
            // One shard after the other, and little else between two questions: the memory answers several at once.
            for (hash, place) in arrived.drain(..) {
                let Some((_, members)) = visits.get_mut(place) else { continue };
                let before = shard.entry(hash).or_insert(0);
                let new = *members & !*before;
                *before |= new;
                *members = new;
            }
        }
        next.extend(visits.drain(..).filter(|(_, new)| *new != 0));
    }

    /// In how many states members have been.
    fn states(&self) -> u64 {
        let of_shard = |shard: &Mutex<HashMap<u64, u64, RandomState>>| {
            let shard = shard.lock().unwrap_or_else(PoisonError::into_inner);
            shard.values().map(|members| u64::from(members.count_ones())).sum::<u64>()
        };
        self.shards.iter().map(of_shard).sum()
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
