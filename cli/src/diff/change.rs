//! What all comparisons have in common: things that are new, gone or changed, and the properties that tell.

use serde::Serialize;
use serde_json::{Map, Value};

/// A property by which two things of a kind are compared.
pub(super) struct Property<T: 'static> {
    /// What it is called, in JSON as well.
    pub(super) name: &'static str,
    /// The fields of the thing that it shows; a test finds the fields that no property shows.
    #[cfg_attr(not(test), expect(dead_code, reason = "for the test"))]
    pub(super) fields: &'static [&'static str],
    /// What is compared.
    pub(super) value: fn(&T) -> Value,
    /// The same in words; where there is another thing, what that says in the same words may be left out.
    pub(super) words: fn(&T, Option<&T>) -> String,
}

/// A property that differs.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct Change {
    pub(super) property: &'static str,
    pub(super) from: Value,
    pub(super) to: Value,
    /// What the property is called in words.
    #[serde(skip)]
    pub(super) label: String,
    /// Both in words; empty where there is nothing.
    #[serde(skip)]
    pub(super) words: (String, String),
}

impl Change {
    /// A property, if it differs.
    pub(super) fn of(
        property: &'static str,
        (from, from_words): (Value, String),
        (to, to_words): (Value, String),
    ) -> Option<Self> {
        // The unit stands with the value.
        let label = property.trim_end_matches("_ms").to_owned();
        (from != to).then_some(Self { property, from, to, label, words: (from_words, to_words) })
    }
}

/// The properties that differ.
pub(super) fn changes<T>(properties: &[Property<T>], from: &T, to: &T) -> Vec<Change> {
    let change = |Property { name, value, words, .. }: &Property<T>| {
        Change::of(name, (value(from), words(from, Some(to))), (value(to), words(to, Some(from))))
    };
    properties.iter().filter_map(change).collect()
}

/// All properties of a thing, by name.
pub(super) fn outline<T>(properties: &[Property<T>], thing: &T) -> Map<String, Value> {
    properties.iter().map(|property| (property.name.to_owned(), (property.value)(thing))).collect()
}

/// What only one of the two editions has.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct Sides<T> {
    pub(super) new: Vec<T>,
    pub(super) gone: Vec<T>,
}

impl<T> Sides<T> {
    pub(super) fn is_empty(&self) -> bool {
        self.new.is_empty() && self.gone.is_empty()
    }
}

impl<T: Clone + PartialEq> Sides<T> {
    /// What only one of two lists has, where what is the same is equal.
    pub(super) fn of(from: &[T], to: &[T]) -> Self {
        let without =
            |all: &[T], others: &[T]| all.iter().filter(|one| !others.contains(one)).cloned().collect();
        Self { new: without(to, from), gone: without(from, to) }
    }
}

/// What only one of the two editions has, and what both have and is not alike.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct Parts<T, C> {
    #[serde(flatten)]
    pub(super) sides: Sides<T>,
    pub(super) changed: Vec<C>,
}

impl<T, C> Parts<T, C> {
    pub(super) fn is_empty(&self) -> bool {
        self.sides.is_empty() && self.changed.is_empty()
    }
}

/// Which things of two lists are the same thing.
pub(super) struct Pairs<'a, T> {
    /// Those of both lists, in the order of the first.
    pub(super) both: Vec<(&'a T, &'a T)>,
    /// Those of the second list alone.
    pub(super) new: Vec<&'a T>,
    /// Those of the first list alone.
    pub(super) gone: Vec<&'a T>,
    /// The places in the second list of those of both, in the order of the first.
    places: Vec<usize>,
}

impl<'a, T> Pairs<'a, T> {
    /// Two things are the same by the first of these that tells so of them and no other; each has one partner at most.
    pub(super) fn of(from: &'a [T], to: &'a [T], same: &[fn(&T, &T) -> bool]) -> Self {
        let mut partner = vec![None; from.len()];
        let mut taken = vec![false; to.len()];
        for same in same {
            for (one, partner) in from.iter().zip(&mut partner).filter(|(_, partner)| partner.is_none()) {
                let mut free = to.iter().zip(&mut taken).enumerate().filter(|(_, (_, taken))| !**taken);
                if let Some((place, (_, taken))) = free.find(|(_, (other, _))| same(one, other)) {
                    *taken = true;
                    *partner = Some(place);
                }
            }
        }
        let found = from.iter().zip(&partner);
        Self {
            both: found.clone().filter_map(|(one, &place)| Some((one, to.get(place?)?))).collect(),
            new: to.iter().zip(&taken).filter(|(_, taken)| !**taken).map(|(other, _)| other).collect(),
            gone: found.filter(|(_, place)| place.is_none()).map(|(one, _)| one).collect(),
            places: partner.iter().copied().flatten().collect(),
        }
    }

    /// Those of both lists that stand in another order, in the first and in the second list: as few as possible in a row.
    pub(super) fn order(&self) -> Vec<(Vec<&'a T>, Vec<&'a T>)> {
        let mut sorted: Vec<_> = self.places.iter().copied().zip(&self.both).collect();
        sorted.sort_by_key(|(place, _)| *place);
        let (mut runs, mut from, mut to, mut highest) = (Vec::new(), Vec::new(), Vec::new(), 0);
        for ((&here, (one, _)), &(there, (_, other))) in self.places.iter().zip(&self.both).zip(&sorted) {
            from.push(*one);
            to.push(*other);
            highest = highest.max(here);
            // The same things stand here and there up to this place.
            if highest == there {
                runs.push((std::mem::take(&mut from), std::mem::take(&mut to)));
            }
        }
        runs.retain(|(from, _)| from.len() > 1);
        runs
    }
}
