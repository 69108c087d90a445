//! The arrows of each state, and how far each is from being taken.

use adsdv_spec::{AsState, Atoms, Choices, Edition, Knowledge, Reading, Term};

/// An arrow: its row of the table, and the alternatives that the most likely readings have.
#[derive(Clone, Debug)]
pub(super) struct Arrow {
    pub(super) to: AsState,
    pub(super) section: &'static str,
    pub(super) requirements: &'static [&'static str],
    terms: Vec<Term>,
}

/// The arrows of every state.
#[derive(Debug)]
pub(super) struct Arrows {
    of: [Vec<Arrow>; AsState::ALL.len()],
}

impl Arrows {
    /// The arrows under the default answers, as far as these readings allow them. What would hold under another answer, too,
    /// explains less.
    pub(super) fn new(edition: &Edition, possible: Choices) -> Self {
        let likely = |&reading: &Reading| {
            let of = Choices::of(reading.choices()).intersection(possible);
            let default = of.intersection(edition.readings.choices());
            default.iter().next().or(of.iter().next())
        };
        let readings = Reading::ALL.iter().filter_map(likely).fold(Choices::NONE, Choices::with);
        let arrows = |from: AsState| {
            let rows = edition.rules.table.rows().iter().filter(|row| row.from == from);
            let arrow = |row: &adsdv_spec::Row| {
                let terms = row.terms().iter().filter(|term| term.readings.is_subset(readings));
                let terms: Vec<Term> = terms.copied().collect();
                let requirements = row.cites.requirements;
                (!terms.is_empty()).then_some(Arrow { to: row.to, section: row.section, requirements, terms })
            };
            rows.filter_map(arrow).collect()
        };
        Self { of: AsState::ALL.map(arrows) }
    }

    pub(super) fn of(&self, state: AsState) -> &[Arrow] {
        self.of.get(state as usize - 1).map_or(&[], Vec::as_slice)
    }
}

/// How far an arrow is from being taken: what is missing of the alternative that misses least.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Miss {
    /// The conditions of the alternative, and those of them that must be on.
    pub(super) all: Atoms,
    pub(super) on: Atoms,
    /// The conditions that fail.
    pub(super) failed: Atoms,
    /// The conditions of which it is not known.
    pub(super) unknown: Atoms,
}

impl Arrow {
    /// What is missing; `None` where a guard holds.
    pub(super) fn miss(&self, known: Knowledge) -> Option<Miss> {
        let misses = self.terms.iter().map(|term| miss(term, known));
        let nearest = misses.min_by_key(|miss| (miss.failed.len(), miss.unknown.len()))?;
        (!nearest.failed.union(nearest.unknown).is_empty()).then_some(nearest)
    }
}

fn miss(term: &Term, known: Knowledge) -> Miss {
    let all = term.on.union(term.off);
    let failed = term.on.intersection(known.off()).union(term.off.intersection(known.on()));
    let unknown = all.difference(known.on()).difference(known.off());
    Miss { all, on: term.on, failed, unknown }
}
