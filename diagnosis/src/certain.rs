//! What is certain of the deviations that were found: none is needless, others explain less, and no answer speaks against them.

use adsdv_spec::AsState;

use crate::deviation::Deviation;
use crate::fit::{Fit, KINDS, LOOKED_AT};
use crate::model::Model;
use crate::sets::{shown_otherwise, with};
use crate::stays::Stay;

/// So many others in the place of one are looked at.
const ALIKE: usize = 5;
/// Where one of so many stays in a state is not explained, nothing is said of it.
const UNCLEAR: usize = 10;

impl<'a> Fit<'a> {
    /// How much is not explained, where that is no more than so much. That all is explained is found out sooner.
    pub(crate) fn wrong_at_most(&self, set: &[Deviation], most: usize) -> Option<usize> {
        if most > 0 {
            return Some(self.wrong(set)).filter(|wrong| *wrong <= most);
        }
        let model = Model::new(self.edition, set);
        self.records.iter().all(|record| record.is_explained(&model)).then_some(0)
    }

    /// The set without what explains nothing that the others do not.
    pub(crate) fn without_the_needless(&self, mut set: Vec<Deviation>) -> Vec<Deviation> {
        let mut wrong = self.wrong(&set);
        let mut place = set.len();
        while place > 0 {
            place -= 1;
            let mut fewer = set.clone();
            fewer.remove(place);
            if let Some(left) = self.wrong_at_most(&fewer, wrong) {
                (set, wrong) = (fewer, left);
                place = place.min(set.len());
            }
        }
        set
    }

    /// Instead of each deviation others that explain as much, a few of them: the set with the other in its place.
    pub(crate) fn alternatives(&self, set: &[Deviation]) -> Vec<Vec<Deviation>> {
        let all = self.wrong(set);
        let places = (0..set.len()).take_while(|_| !self.is_over());
        places.flat_map(|place| self.alternatives_to(set, place, all)).collect()
    }

    /// Instead of one of the deviations others that explain as much, where so much is not explained by the set.
    fn alternatives_to(&self, set: &[Deviation], place: usize, all: usize) -> Vec<Vec<Deviation>> {
        let mut alike: Vec<Vec<Deviation>> = Vec::new();
        if let Some(known) = set.get(place) {
            let mut others = set.to_vec();
            others.remove(place);
            let without = Model::new(self.edition, &others);
            let stays = self.stays(&others);
            let mut needed: Vec<(&Stay<'a>, usize)> = Vec::new();
            let model = Model::new(self.edition, set);
            for stay in stays.iter().flat_map(|(_, stays)| stays) {
                if stay.wrong(&without) > stay.wrong(&model) {
                    needed.push((stay, stay.wrong(&model)));
                }
            }
            needed.sort_by_key(|(stay, _)| stay.len());
            needed.truncate(LOOKED_AT);
            let wrongs = needed.iter().take(KINDS).filter_map(|(stay, _)| stay.first_wrong(&without));
            let shown: Vec<Deviation> = wrongs.flat_map(|wrong| shown_otherwise(&wrong)).collect();
            let own = known.state(self.edition);
            let fits = |one: &Deviation| {
                own.is_none() || one.state(self.edition).is_none_or(|state| Some(state) == own)
            };
            let mut found = 0;
            for one in self.candidates.single.iter().copied().chain(shown).filter(fits) {
                if found >= ALIKE || one == *known || others.contains(&one) {
                    continue;
                }
                for other in with(&others, one) {
                    let model = Model::new(self.edition, &other);
                    if needed.iter().all(|(stay, was)| stay.wrong(&model) <= *was)
                        && self.wrong_at_most(&other, all).is_some()
                    {
                        alike.push(other);
                        found += 1;
                    }
                }
            }
        }
        alike
    }

    /// The arrows that a set takes where the program stays, those first for which that is the most often.
    pub(crate) fn untaken(&self, set: &[Deviation]) -> Vec<(AsState, AsState)> {
        let model = Model::new(self.edition, set);
        let mut counted: Vec<(usize, (AsState, AsState))> = Vec::new();
        for stay in self.stays(set).iter().flat_map(|(_, stays)| stays) {
            let Some(wrong) = stay.first_wrong(&model) else { continue };
            let from = wrong.from.control.state;
            if wrong.found != from || wrong.expected == from {
                continue;
            }
            let arrow = (from, wrong.expected);
            match counted.iter_mut().find(|(_, known)| *known == arrow) {
                Some((count, _)) => *count += 1,
                None => counted.push((1, arrow)),
            }
        }
        counted.sort_by_key(|(count, _)| std::cmp::Reverse(*count));
        counted.into_iter().map(|(_, arrow)| arrow).collect()
    }

    /// The set without what no experiment tells from something else, where not all is explained: there it may be otherwise.
    pub(crate) fn told_from_others(
        &self,
        mut set: Vec<Deviation>,
        differ: impl Fn(&[Deviation], &[Deviation]) -> bool,
    ) -> Vec<Deviation> {
        let all = self.wrong(&set);
        if all == 0 {
            return set;
        }
        let doubtful = |place: &usize| {
            let others = self.alternatives_to(&set, *place, all);
            others.iter().any(|other| differ(&set, other))
        };
        let doubtful: Vec<usize> = (0..set.len()).filter(doubtful).collect();
        for place in doubtful.into_iter().rev() {
            set.remove(place);
        }
        let unclear: Vec<AsState> =
            AsState::ALL.into_iter().filter(|state| self.is_unclear(*state, &set)).collect();
        set.retain(|one| one.state(self.edition).is_none_or(|state| !unclear.contains(&state)));
        set
    }

    /// Whether so much of what was done in a state is not explained that nothing can be said of it.
    fn is_unclear(&self, state: AsState, set: &[Deviation]) -> bool {
        let (model, stays) = (Model::new(self.edition, set), self.stays(set));
        let own = || stays.iter().filter(|(own, _)| *own == state).flat_map(|(_, stays)| stays);
        own().filter(|stay| stay.wrong(&model) > 0).count() * UNCLEAR > own().count()
    }

    /// The set without what is said of a state in which not all is explained: where the time was over before, it may be otherwise.
    pub(crate) fn of_explained_states(&self, mut set: Vec<Deviation>) -> Vec<Deviation> {
        let all = set.clone();
        set.retain(|one| one.state(self.edition).is_none_or(|state| self.wrong_in(state, &all) == 0));
        set
    }

    /// The set without what explains something only by chance: what makes any answer wrong that is right without it, and what is
    /// said of an arrow that some answers tell more about than is explained.
    pub(crate) fn certain(&self, mut set: Vec<Deviation>) -> Vec<Deviation> {
        let mut place = 0;
        while place < set.len() && self.wrong(&set) > 0 {
            let mut others = set.clone();
            let one = others.remove(place);
            let (model, without) = (Model::new(self.edition, &set), Model::new(self.edition, &others));
            let (arrow, takes_away) = (one.arrow(self.edition), one.takes_away());
            let stays = self.stays(&set);
            let doubts = |stay: &Stay<'a>| {
                let wrong = stay.wrong(&model);
                wrong > stay.wrong(&without)
                    || wrong > 0
                        && stay.first_wrong(&model).is_some_and(|wrong| {
                            let from = wrong.from.control.state;
                            let leaves = wrong.expected == from && wrong.found != from;
                            arrow.is_some_and(|arrow| {
                                arrow == (from, wrong.found)
                                    || arrow == (from, wrong.expected)
                                    || arrow.0 == from && leaves && takes_away
                            })
                        })
            };
            if stays.iter().flat_map(|(_, stays)| stays).any(doubts) {
                (set, place) = (others, 0);
            } else {
                place += 1;
            }
        }
        set
    }
}
