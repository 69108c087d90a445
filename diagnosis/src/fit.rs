//! The deviations that explain the most answers.
//!
//! What a program does in a state is explained by itself, stay by stay: what goes wrong in one does not hide what goes wrong in
//! another. In each state several sets of deviations are followed at once, each of them from an answer that it does not explain to
//! those deviations that do: the one that explains the most at first need not be right.

use std::cell::RefCell;
use std::collections::HashMap;
use std::hash::{DefaultHasher, Hash as _, Hasher as _};
use std::time::Instant;

use adsdv_spec::Edition;
use adsdv_spec::messages::AsState;
use adsdv_spec::mutation::Change;

use crate::candidates::Candidates;
use crate::deviation::Deviation;
use crate::model::Model;
use crate::record::Kept;
use crate::sets::{everywhere, same, shown_otherwise, with};
use crate::stays::{Stay, Wrong, cut};

/// The output that tells in which state a program is.
const AS_STATE: &str = "as_state";
/// So many sets of deviations are followed at once.
const FOLLOWED: usize = 8;
/// No more deviations than these are looked for in a state at once.
const DEEPEST: usize = 7;
/// So many kinds of wrong answers are looked at to find what explains them.
pub(crate) const KINDS: usize = 4;
/// So many stays that are wrong are looked at to find what explains the most, and as many that are right.
pub(crate) const LOOKED_AT: usize = 120;
/// So many stays that what is known does not explain are always looked at: few answers may tell one explanation from another.
const HARD: usize = 24;
/// So many of the best are tried on all stays.
const TRIED: usize = 14;
/// So many of those that explain the most of what is not explained yet are tried beside them.
const TELLING: usize = 4;
/// Of the sets that explain the same no more than these are followed.
const ALIKE: usize = 2;
/// So many ways to cut the stays are kept.
const CUTS: usize = 10;
/// The deviations of all states are looked for so many times: what is found in one may help in another.
const PASSES: usize = 3;

/// A search for deviations that explain answers.
pub(crate) struct Fit<'a> {
    pub(crate) edition: &'a Edition,
    pub(crate) records: Vec<&'a Kept>,
    pub(crate) candidates: &'a Candidates,
    /// When the search ends, whatever it has come to.
    pub(crate) until: Instant,
    /// The stays as they were cut of late, and with which deviations.
    stays: RefCell<Vec<Cut<'a>>>,
}

pub(crate) type Stays<'a> = std::rc::Rc<Vec<(AsState, Vec<Stay<'a>>)>>;

struct Cut<'a> {
    by: Vec<Deviation>,
    stays: Stays<'a>,
}

/// Deviations that are followed.
#[derive(Clone, Debug)]
struct Node {
    set: Vec<Deviation>,
    /// How much they do not explain of the state, and of all others as far as that changed.
    wrong: usize,
    /// How much of that is explained without any deviation of the state.
    spoilt: usize,
    /// A number that stands for what it does not explain.
    mark: u64,
}

/// A set that helps, with how much it does not explain of some stays that were wrong, of some of all, and of those that what is known
/// does not explain.
#[derive(Clone, Debug)]
struct Ranked {
    set: Vec<Deviation>,
    wrong: usize,
    spoilt: usize,
    hard: usize,
}

impl Node {
    /// The smaller, the better it is to go on from.
    fn rank(&self) -> (usize, usize) {
        (self.wrong + self.spoilt, self.set.len())
    }

    /// The smaller, the better it explains.
    fn worth(&self) -> (usize, usize) {
        (self.wrong, self.set.len())
    }
}

impl<'a> Fit<'a> {
    pub(crate) fn new(
        edition: &'a Edition,
        records: &'a [Kept],
        candidates: &'a Candidates,
        until: Instant,
    ) -> Self {
        Self::of(edition, records.iter().collect(), candidates, until)
    }

    pub(crate) const fn of(
        edition: &'a Edition,
        records: Vec<&'a Kept>,
        candidates: &'a Candidates,
        until: Instant,
    ) -> Self {
        Self { edition, records, candidates, until, stays: RefCell::new(Vec::new()) }
    }

    pub(crate) fn is_over(&self) -> bool {
        Instant::now() >= self.until
    }

    /// The deviations that explain the most, from what was found before.
    pub(crate) fn run(&self, known: Vec<Deviation>) -> Vec<Deviation> {
        let mut best = self.run_from(known);
        let mut wrong = self.wrong(&best);
        for start in self.with_states_shown_otherwise(&best) {
            if wrong == 0 || self.is_over() {
                break;
            }
            let set = self.run_from(start);
            let left = self.wrong(&set);
            if (left, set.len()) < (wrong, best.len()) {
                (best, wrong) = (set, left);
            }
        }
        best
    }

    /// The set, or what explains more with something else remembered: where stays begin depends on that, so that it is passed over
    /// where it is ranked by stays of other beginnings.
    pub(crate) fn else_remembered(&self, mut set: Vec<Deviation>) -> Vec<Deviation> {
        let mut wrong = self.wrong(&set);
        let all = self.candidates.single.iter().copied();
        for one in all.filter(|one| matches!(one, Deviation::Remembers(_))) {
            if wrong == 0 || self.is_over() {
                break;
            }
            for other in with(&set, one) {
                if !set.contains(&one) && self.wrong(&other) < wrong {
                    set = self.run_from(other);
                    wrong = self.wrong(&set);
                }
            }
        }
        set
    }

    /// An arrow that leads to another state and a state that is shown as another look alike, until that state is left: each set
    /// with the one in the place of the other.
    fn with_states_shown_otherwise(&self, set: &[Deviation]) -> Vec<Vec<Deviation>> {
        let rows = self.edition.rules.table.rows();
        let without =
            |one: &Deviation| set.iter().copied().filter(|other| other != one).collect::<Vec<Deviation>>();
        let instead = |one: &Deviation| match *one {
            Deviation::Changed(Change::RowLeadsTo(row, to)) if self.wrong_in(to, set) > 0 => {
                let value = rows.get(row)?.to.raw();
                let shown = Deviation::Writes { key: AS_STATE, value, raw: to.raw() };
                // Of several such arrows that lead to the same state all would be shown so.
                let others = without(one).into_iter().filter(|other| match *other {
                    Deviation::Changed(Change::RowLeadsTo(other, leads)) => {
                        leads != to || rows.get(other).is_none_or(|row| row.to.raw() != value)
                    }
                    _ => true,
                });
                Some(others.chain([shown]).collect())
            }
            Deviation::Writes { key: AS_STATE, value, raw } => {
                let to = AsState::from_raw(raw)?;
                AsState::from_raw(value).filter(|state| self.wrong_in(*state, set) > 0)?;
                let leads =
                    (0..rows.len()).filter(|row| rows.get(*row).is_some_and(|row| row.to.raw() == value));
                let leads = leads.map(|row| Deviation::Changed(Change::RowLeadsTo(row, to)));
                Some(without(one).into_iter().chain(leads).collect())
            }
            _ => None,
        };
        set.iter().filter_map(instead).collect()
    }

    /// The same, from one set alone.
    fn run_from(&self, known: Vec<Deviation>) -> Vec<Deviation> {
        let (mut wrong, mut set) = (self.wrong(&known), known);
        let mut by_all = false;
        for _ in 0..2 * PASSES {
            let before = set.clone();
            for state in AsState::ALL {
                if self.is_over() || self.wrong_in(state, &set) == 0 {
                    continue;
                }
                let some = self.sampled(state, &Model::new(self.edition, &set));
                let other = if by_all { self } else { &some }.explained(state, &set);
                // It explains more of these records; what counts is all of them.
                let left = if other == set { wrong } else { self.wrong(&other) };
                if (left, other.len()) < (wrong, set.len()) {
                    (set, wrong) = (other, left);
                }
            }
            // What some of the records do not lead to all of them may.
            if set == before && (by_all || wrong == 0) {
                break;
            }
            by_all |= set == before;
        }
        self.without_the_needless(set)
    }

    /// How much is not explained in all.
    pub(crate) fn wrong(&self, set: &[Deviation]) -> usize {
        let model = Model::new(self.edition, set);
        self.stays(set).iter().flat_map(|(_, stays)| stays).map(|stay| stay.wrong(&model)).sum()
    }

    pub(crate) fn wrong_in(&self, state: AsState, set: &[Deviation]) -> usize {
        let model = Model::new(self.edition, set);
        let stays = self.stays(set);
        of(&stays, state).iter().map(|stay| stay.wrong(&model)).sum()
    }

    /// How much is not explained in all states but one.
    fn wrong_beside(&self, state: AsState, set: &[Deviation]) -> usize {
        let model = Model::new(self.edition, set);
        let stays = self.stays(set);
        let others = stays.iter().filter(|(own, _)| *own != state);
        others.flat_map(|(_, stays)| stays).map(|stay| stay.wrong(&model)).sum()
    }

    /// The stays, cut with those deviations of a set that may make a difference in any state.
    pub(crate) fn stays(&self, set: &[Deviation]) -> Stays<'a> {
        let everywhere = everywhere(self.edition, set);
        let mut known = self.stays.borrow_mut();
        if let Some(place) = known.iter().position(|cut| cut.by == everywhere) {
            known[place..].rotate_left(1);
        } else {
            let stays = std::rc::Rc::new(cut(&self.records, &Model::new(self.edition, set)));
            known.push(Cut { by: everywhere, stays });
            if known.len() > CUTS {
                known.remove(0);
            }
        }
        known.last().map(|cut| cut.stays.clone()).unwrap_or_default()
    }

    /// A set that explains more of a state, if one is found.
    fn explained(&self, state: AsState, set: &[Deviation]) -> Vec<Deviation> {
        let bare: Vec<Deviation> =
            set.iter().copied().filter(|one| one.state(self.edition) != Some(state)).collect();
        let plain = Model::new(self.edition, &bare);
        let mut beside: HashMap<String, usize> = HashMap::new();
        let mut node = |set: Vec<Deviation>| {
            let model = Model::new(self.edition, &set);
            let (mut wrong, mut spoilt, mut hasher) = (0, 0, DefaultHasher::new());
            let stays = self.stays(&set);
            for stay in of(&stays, state) {
                let own = stay.wrong(&model);
                own.hash(&mut hasher);
                wrong += own;
                spoilt += if own > 0 && stay.is_right(&plain) { own } else { 0 };
            }
            let cut = everywhere(self.edition, &set);
            let counts = |one: &&Deviation| one.state(self.edition).is_none() || cut.contains(one);
            let key = format!("{:?}", set.iter().filter(counts).collect::<Vec<_>>());
            wrong += *beside.entry(key).or_insert_with(|| self.wrong_beside(state, &set));
            wrong.hash(&mut hasher);
            Node { set, wrong, spoilt, mark: hasher.finish() }
        };
        let known = node(set.to_vec());
        let (stays, model) = (self.stays(set), Model::new(self.edition, set));
        let hard = of(&stays, state).iter().filter(|stay| stay.wrong(&model) > 0);
        let hard: Vec<&Stay<'a>> = hard.take(HARD).collect();
        let mut best = known.clone();
        let mut followed = if bare == set { vec![known] } else { vec![known, node(bare)] };
        let mut stuck = 0;
        for _ in 0..DEEPEST {
            let mut next: Vec<Node> = Vec::new();
            for from in &followed {
                let stays = self.stays(&from.set);
                for set in self.next(state, of(&stays, state), &hard, from) {
                    if self.is_over() {
                        return best.set;
                    }
                    if !next.iter().any(|other| same(&other.set, &set)) {
                        next.push(node(set));
                    }
                }
            }
            next.sort_by_key(Node::rank);
            let next = both(diverse(next), FOLLOWED, |node| (node.spoilt, node.wrong, node.set.len()));
            let Some(first) = next.iter().min_by_key(|node| node.worth()) else { break };
            stuck += 1;
            if first.worth() < best.worth() {
                best = first.clone();
                stuck = 0;
            }
            if stuck > 2 || next.iter().any(|node| node.wrong == 0) {
                break;
            }
            followed = next;
        }
        best.set
    }

    /// Sets that explain a wrong answer that this one does not.
    fn next(
        &self,
        state: AsState,
        stays: &[Stay<'a>],
        hard: &[&Stay<'a>],
        from: &Node,
    ) -> Vec<Vec<Deviation>> {
        let model = Model::new(self.edition, &from.set);
        let wrong: Vec<(&Stay<'a>, usize)> =
            stays.iter().map(|stay| (stay, stay.wrong(&model))).filter(|(_, wrong)| *wrong > 0).collect();
        let conflicts = kinds(&wrong, &model);
        if conflicts.is_empty() {
            return Vec::new();
        }
        let mut sets: Vec<Vec<Deviation>> = Vec::new();
        let of_others = |one: &Deviation| one.state(self.edition).is_some_and(|own| own != state);
        for several in &self.candidates.several {
            if !several.iter().any(of_others) && !several.iter().all(|one| from.set.contains(one)) {
                let goes = |one: &Deviation| several.iter().any(|new| new == one || one.is_instead_of(new));
                let kept = from.set.iter().copied().filter(|one| !goes(one));
                sets.push(kept.chain(several.iter().copied()).collect());
            }
        }
        for place in 0..from.set.len() {
            let mut fewer = from.set.clone();
            fewer.remove(place);
            sets.push(fewer);
        }
        let shown = conflicts.iter().flat_map(|(_, _, wrong)| shown_otherwise(wrong));
        let own = |one: &Deviation| one.state(self.edition).is_none_or(|own| own == state);
        for one in self.candidates.single.iter().copied().filter(own).chain(shown) {
            if !from.set.contains(&one) {
                sets.extend(with(&from.set, one));
            }
        }
        let wrong: Vec<&Stay<'a>> = some(&wrong).map(|(stay, _)| *stay).collect();
        let all: Vec<&Stay<'a>> = some(stays).collect();
        let of =
            |stays: &[&Stay<'a>], model: &Model| stays.iter().map(|stay| stay.wrong(model)).sum::<usize>();
        let helping = |set: Vec<Deviation>| {
            let model = Model::new(self.edition, &set);
            let helps = conflicts.iter().any(|(stay, was, _)| stay.is_less_wrong(&model, *was));
            helps.then(|| Ranked {
                wrong: of(&wrong, &model),
                spoilt: of(&all, &model),
                hard: of(hard, &model),
                set,
            })
        };
        let mut ranked: Vec<Ranked> = sets.into_iter().filter_map(helping).collect();
        ranked.sort_by_key(|one| (one.wrong + one.spoilt, one.set.len()));
        // Where many explain the most, few answers may tell one of them from the others.
        let mut telling = ranked.clone();
        telling.sort_by_key(|one| one.hard);
        telling.truncate(TELLING);
        let ranked = both(ranked, TRIED, |one| (one.spoilt, one.wrong, one.set.len()));
        ranked.into_iter().chain(telling).map(|one| one.set).collect()
    }
}

/// The stays in a state.
fn of<'b, 'a>(stays: &'b [(AsState, Vec<Stay<'a>>)], state: AsState) -> &'b [Stay<'a>] {
    stays.iter().find(|(own, _)| *own == state).map_or(&[], |(_, stays)| stays.as_slice())
}

/// Of the stays that are wrong in the same way the shortest, those first that are the most.
fn kinds<'b, 'a>(wrong: &[(&'b Stay<'a>, usize)], model: &Model) -> Vec<(&'b Stay<'a>, usize, Wrong)> {
    let mut kinds: Vec<(usize, &'b Stay<'a>, usize, Wrong)> = Vec::new();
    for (stay, points) in some(wrong) {
        let Some(first) = stay.first_wrong(model) else { continue };
        if let Some(known) = kinds.iter_mut().find(|(.., known)| known.is_like(&first)) {
            known.0 += 1;
            if stay.len() < known.1.len() {
                (known.1, known.2, known.3) = (stay, *points, first);
            }
        } else {
            kinds.push((1, stay, *points, first));
        }
    }
    kinds.sort_by_key(|(count, ..)| std::cmp::Reverse(*count));
    kinds.truncate(KINDS);
    kinds.into_iter().map(|(_, stay, points, wrong)| (stay, points, wrong)).collect()
}

/// No more than a few of those that explain the same, so that others are followed beside them.
fn diverse(all: Vec<Node>) -> Vec<Node> {
    let mut counts: HashMap<u64, usize> = HashMap::new();
    let few = |node: &Node| {
        let count = counts.entry(node.mark).or_default();
        *count += 1;
        *count <= ALIKE
    };
    let mut all = all;
    all.retain(few);
    all
}

/// The first half of so many as they are, and the other half of the rest by another order.
fn both<T, K: Ord>(mut all: Vec<T>, many: usize, key: impl Fn(&T) -> K) -> Vec<T> {
    let half = (many / 2).min(all.len());
    let mut rest = all.split_off(half);
    rest.sort_by_key(key);
    all.extend(rest.into_iter().take(many - many / 2));
    all
}

/// Some of them, evenly spread.
fn some<T>(all: &[T]) -> impl Iterator<Item = &T> {
    all.iter().step_by(all.len().div_ceil(LOOKED_AT).max(1))
}
