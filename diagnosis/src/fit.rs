//! The deviations that explain the most answers.

use std::cmp::Reverse;

use adsdv_spec::Edition;

use crate::candidates;
use crate::deviation::Deviation;
use crate::model::Model;
use crate::record::Record;

/// So many answers that are wrong are looked at to find what may explain them, and as many that are right, which it must not spoil.
const LOOKED_AT: usize = 64;
/// So many of the best are tried on all answers.
const TRIED: usize = 16;
/// No more deviations than these are looked for.
const MOST: usize = 24;
/// So many others in the place of one are looked at.
const ALIKE: usize = 6;

/// A search for deviations that explain answers.
pub(crate) struct Fit<'a> {
    edition: &'a Edition,
    records: &'a [Record],
    candidates: Vec<Deviation>,
    chosen: Vec<Deviation>,
    /// How many answers the chosen ones explain.
    explained: usize,
}

/// The deviations that were found, as far as they explain anything; `known` is what was found before.
pub(crate) fn fit(
    edition: &Edition,
    records: &[Record],
    known: Vec<Deviation>,
    measured: &[Deviation],
) -> Vec<Deviation> {
    let mut fit = Fit::new(edition, records, known, measured);
    loop {
        while fit.chosen.len() < MOST && fit.explain_more() {}
        if !fit.exchange() {
            return fit.chosen;
        }
    }
}

/// Instead of each deviation others that explain as much, a few of them: the deviations with the other in its place.
pub(crate) fn alternatives(
    edition: &Edition,
    records: &[Record],
    found: &[Deviation],
    measured: &[Deviation],
) -> Vec<Vec<Deviation>> {
    let fit = Fit::new(edition, records, found.to_vec(), measured);
    let places = 0..found.len();
    places.flat_map(|place| fit.instead_of(place)).collect()
}

impl<'a> Fit<'a> {
    fn new(
        edition: &'a Edition,
        records: &'a [Record],
        chosen: Vec<Deviation>,
        measured: &[Deviation],
    ) -> Self {
        let mut candidates = measured.to_vec();
        candidates.extend(candidates::all(edition));
        let mut fit = Self { edition, records, candidates, chosen, explained: 0 };
        fit.explained = fit.agreement(&fit.chosen);
        fit
    }

    /// The same with another deviation in this place, where that explains as much.
    fn instead_of(&self, place: usize) -> Vec<Vec<Deviation>> {
        let mut others = self.chosen.clone();
        let known = others.remove(place);
        let without = Model::new(self.edition, &others);
        let needed: Vec<&Record> =
            self.records.iter().filter(|record| !record.is_explained(&without)).take(LOOKED_AT).collect();
        let with = |candidate: &Deviation| [others.as_slice(), &[*candidate]].concat();
        let explains = |candidate: &&Deviation| {
            let model = Model::new(self.edition, &with(candidate));
            **candidate != known && needed.iter().all(|record| record.is_explained(&model))
        };
        let alike = self.candidates.iter().filter(explains).map(with);
        alike.filter(|deviations| self.agreement(deviations) >= self.explained).take(ALIKE).collect()
    }
    /// Adds the deviation that explains the most; false if none explains any more.
    fn explain_more(&mut self) -> bool {
        let Some((explained, best)) = self.best(&self.chosen) else { return false };
        if explained <= self.explained {
            return false;
        }
        self.chosen.push(best);
        self.explained = explained;
        self.drop_the_needless();
        true
    }

    /// Puts another deviation in the place of one that explains less; false if there is none.
    fn exchange(&mut self) -> bool {
        if self.is_all_explained() {
            return false;
        }
        for place in 0..self.chosen.len() {
            let mut others = self.chosen.clone();
            others.remove(place);
            if let Some((explained, best)) =
                self.best(&others).filter(|(explained, _)| *explained > self.explained)
            {
                others.push(best);
                (self.chosen, self.explained) = (others, explained);
                self.drop_the_needless();
                return true;
            }
        }
        false
    }

    fn is_all_explained(&self) -> bool {
        let model = Model::new(self.edition, &self.chosen);
        self.records.iter().all(|record| record.is_explained(&model))
    }

    /// What explains the most beside others, and how much that is. Of those that explain as much, the first: changes of the table
    /// come before what is added to it.
    fn best(&self, beside: &[Deviation]) -> Option<(usize, Deviation)> {
        let model = Model::new(self.edition, beside);
        let (right, mut wrong): (Vec<&Record>, Vec<&Record>) =
            self.records.iter().partition(|record| record.is_explained(&model));
        wrong.sort_by_key(|record| record.steps.len());
        // What the deviations so far leave unexplained tells most.
        let so_far = Model::new(self.edition, &self.chosen);
        let left: Vec<&Record> =
            self.records.iter().filter(|record| !record.is_explained(&so_far)).take(LOOKED_AT).collect();
        let looked_at: Vec<&Record> = some(&wrong).chain(some(&right)).chain(left).collect();
        let agree = |model: &Model| looked_at.iter().map(|record| record.agrees(model)).sum::<usize>();
        let before = agree(&model);
        let shown = some(&wrong).filter_map(|record| candidates::shown(record, &model));
        let mut gains: Vec<(usize, Deviation)> = Vec::new();
        for candidate in self.candidates.iter().copied().chain(shown) {
            if beside.contains(&candidate) || gains.iter().any(|(_, known)| *known == candidate) {
                continue;
            }
            let after = agree(&Model::new(self.edition, &[beside, &[candidate]].concat()));
            if after > before {
                gains.push((after, candidate));
            }
        }
        gains.sort_by_key(|(gain, _)| Reverse(*gain));
        let tried = gains.into_iter().take(TRIED);
        let on_all = tried.map(|(_, one)| (self.agreement(&[beside, &[one]].concat()), one));
        on_all.reduce(|best, other| if other.0 > best.0 { other } else { best })
    }

    /// Takes away what explains nothing that the others do not.
    fn drop_the_needless(&mut self) {
        let mut place = 0;
        while place < self.chosen.len() && self.chosen.len() > 1 {
            let mut fewer = self.chosen.clone();
            fewer.remove(place);
            let explained = self.agreement(&fewer);
            if explained >= self.explained {
                (self.chosen, self.explained) = (fewer, explained);
            } else {
                place += 1;
            }
        }
    }

    /// How many answers are explained in all, each record up to its first that is not.
    fn agreement(&self, deviations: &[Deviation]) -> usize {
        let model = Model::new(self.edition, deviations);
        self.records.iter().map(|record| record.agrees(&model)).sum()
    }
}

/// Some of them, evenly spread.
fn some<'a>(records: &[&'a Record]) -> impl Iterator<Item = &'a Record> {
    records.iter().copied().step_by(records.len().div_ceil(LOOKED_AT).max(1))
}
