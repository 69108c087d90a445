//! The deviations that may explain an answer.

use adsdv_conform::protocol::{Domain, InputField};
use adsdv_spec::messages::AsState;
use adsdv_spec::mutation::Change;
use adsdv_spec::{Atom, Atoms, Edition, Inputs, Mutation, Row};

use crate::deviation::{Deviation, LATEST, Remembers, Wheels};
use crate::dials::{Dial, dials};
use crate::fixed::{Fixed, observed};
use crate::interface::Interface;
use crate::model::Model;

/// What may explain answers.
#[derive(Clone, Debug, Default)]
pub(crate) struct Candidates {
    /// Each by itself; those that come first are the more likely ones.
    pub(crate) single: Vec<Deviation>,
    /// Several that only explain anything together.
    pub(crate) several: Vec<Vec<Deviation>>,
}

impl Candidates {
    /// Numbers that were measured: each by itself, and together with what is remembered otherwise about the same time. By when
    /// "Go" counts while it is on, a time that is a little longer may explain nothing alone, nor may "Go".
    pub(crate) fn add_measured(&mut self, measured: Vec<Deviation>) {
        for number in measured {
            let together = self.single.iter().filter(|one| one.is_measured_with(&number));
            self.several.extend(together.map(|one| vec![*one, number]));
            self.single.push(number);
        }
    }
}

/// Every deviation that has no number in it which would have to be measured, as far as the inputs of a program can tell it.
///
/// The answers to the document's questions come first: where one explains as much, it is no deviation at all.
pub(crate) fn all(edition: &Edition, interface: &Interface) -> Vec<Deviation> {
    let answers = edition.questions().flat_map(|reading| interface.answers(reading));
    let others = answers.filter(|choice| !edition.readings.is(*choice) && edition.choices.has(*choice));
    let measured = |change: &Change| matches!(change, Change::Time(..) | Change::Threshold(..));
    let changes = Mutation::all(edition).map(|mutation| mutation.change).filter(|change| !measured(change));
    let mut all: Vec<Deviation> =
        others.map(Deviation::Reads).chain(changes.map(Deviation::Changed)).collect();
    all.extend([Deviation::GoLevel, Deviation::GoNeedsHandshake]);
    all.extend(Wheels::EACH.map(Deviation::Wheels));
    all.extend(Remembers::ALL.map(Deviation::Remembers));
    let usual = Model::new(edition, &[]);
    let dials = dials(&usual, interface);
    all.extend(dials.iter().map(|dial| Deviation::Ignores { key: dial.field.key }));
    let named: Vec<&Dial> =
        dials.iter().filter(|dial| !matches!(dial.field.domain, Domain::Number { .. })).collect();
    all.extend(opening(&usual, &named));
    for (place, row) in edition.rules.table.rows().iter().enumerate() {
        all.extend(joined(edition, place, row));
        let (from, to) = (row.from, row.to);
        all.extend((1..=LATEST).map(|steps| Deviation::Late { from, to, steps }));
        for Dial { field, values } in &named {
            let each = values.iter().flat_map(|&raw| [true, false].map(|is| (raw, is)));
            // Of two values one is what the other is not.
            let each = each.filter(|(_, is)| *is || values.len() > 2);
            all.extend(each.map(|(raw, is)| Deviation::Needs { from, to, key: field.key, raw, is }));
        }
    }
    for from in AsState::ALL {
        for to in AsState::ALL.into_iter().filter(|&to| to != from) {
            for Dial { field, values } in &named {
                let usual = (field.get)(&Inputs::default());
                let others = values.iter().filter(|&&raw| raw != usual);
                all.extend(others.map(|&raw| Deviation::Also { from, to, key: field.key, raw }));
            }
        }
    }
    let fixed = Fixed::of(edition, interface);
    all.retain(|one| fixed.can_tell(edition, interface, one));
    all
}

/// What may open the shutdown circuit beside what the document says. What is so after power-on may where the way to AS_READY needs
/// another value: a circuit that is never closed explains nothing.
fn opening(usual: &Model, dials: &[&Dial]) -> Vec<Deviation> {
    let at = |field: &InputField, raw| {
        let mut inputs = Inputs::default();
        (field.set)(&mut inputs, raw);
        observed(usual, &inputs)
    };
    let plain = observed(usual, &Inputs::default());
    let needed =
        usual.terms(AsState::Off).fold(Atoms::NONE, |all, (term, _)| all.union(term.on).union(term.off));
    let is_needed = |dial: &Dial| {
        let changed = |&raw: &i32| {
            let seen = at(dial.field, raw);
            seen.difference(plain).union(plain.difference(seen))
        };
        // What the AI Computer sends is no switch of the vehicle.
        dial.field.part.is_empty()
            && dial.values.iter().map(changed).any(|changed| !changed.intersection(needed).is_empty())
    };
    let of = |dial: &Dial| {
        let (field, needed) = (dial.field, is_needed(dial));
        let may = |raw: &i32| {
            (needed || *raw != (field.get)(&Inputs::default())) && !at(field, *raw).has(Atom::SdcOpen)
        };
        let values: Vec<i32> = dial.values.iter().copied().filter(may).collect();
        values.into_iter().map(|raw| Deviation::Opens { key: field.key, raw })
    };
    dials.iter().flat_map(|dial| of(dial)).collect()
}

/// Deviations that only explain anything together: an arrow that leads elsewhere, and is late.
pub(crate) fn several(edition: &Edition) -> Vec<Vec<Deviation>> {
    let rows = edition.rules.table.rows().iter().enumerate();
    let elsewhere = rows.flat_map(|(place, row)| {
        let (from, usual) = (row.from, row.to);
        let others = AsState::ALL.into_iter().filter(move |to| *to != usual && *to != from);
        others.map(move |to| (Deviation::Changed(Change::RowLeadsTo(place, to)), from, to))
    });
    elsewhere
        .flat_map(|(leads, from, to)| {
            (1..=LATEST).map(move |steps| vec![leads, Deviation::Late { from, to, steps }])
        })
        .collect()
}

/// Each two alternatives of a row that the edition's readings have.
fn joined(edition: &Edition, row: usize, of: &Row) -> Vec<Deviation> {
    let choices = edition.readings.choices();
    let there = |term: &usize| of.terms().get(*term).is_some_and(|term| term.readings.is_subset(choices));
    let terms: Vec<usize> = (0..of.terms().len()).filter(there).collect();
    let pairs = terms
        .iter()
        .flat_map(|&one| terms.iter().filter(move |other| one < **other).map(move |&other| (one, other)));
    pairs.map(|(one, other)| Deviation::Joined { row, one, other }).collect()
}
