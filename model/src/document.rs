//! The document that a machine is checked against: the edition of its version, as it was published.
//!
//! Properties and goals never look at the rules of the machine that is checked: a table with a mistake in it must not be able
//! to excuse itself.

use std::sync::LazyLock;

use adsdv_spec::{Atoms, Edition, Machine, Timing};

/// The edition where none is asked for: this crate names it here and nowhere else.
pub(crate) const DEFAULT: &Edition = Edition::DEFAULT;

/// A published edition.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Document {
    /// The edition.
    pub edition: &'static Edition,
    /// The conditions that it has: [`Edition::scope`], worked out once.
    pub scope: Atoms,
    /// Its place in [`Edition::ALL`].
    pub(crate) place: usize,
}

static DOCUMENTS: LazyLock<Vec<Document>> = LazyLock::new(|| {
    let all = Edition::ALL.iter().enumerate();
    all.map(|(place, edition)| Document { edition, scope: edition.scope(), place }).collect()
});

impl Document {
    /// The published edition of this version; the default for a version that nobody has published.
    pub fn of(edition: &Edition) -> &'static Self {
        let named = |version| DOCUMENTS.iter().find(|document| document.edition.version == version);
        let document = named(edition.version).or_else(|| named(DEFAULT.version));
        document.expect("the default is one of all editions")
    }

    /// The times that the AI Computer, the operator and the properties go by.
    pub(crate) const fn timing(&self) -> &'static Timing {
        &self.edition.rules.timing
    }

    /// That of a machine's version.
    pub fn of_machine(machine: &Machine) -> &'static Self {
        Self::of(machine.edition())
    }
}

/// The default edition.
impl Default for &'static Document {
    fn default() -> Self {
        Document::of(DEFAULT)
    }
}

/// Whether an edition is of the default version.
pub(crate) fn is_default(edition: &Edition) -> bool {
    edition.version == DEFAULT.version
}

/// Whether two editions have the same state machine: under the same answers, whichever are the default in each.
pub fn have_the_same_state_machine(one: &Edition, other: &Edition) -> bool {
    let of = |edition: &Edition| (edition.rules, edition.faults, edition.choices);
    of(one) == of(other)
}

/// The editions of which none before has the same state machine: what is explored of these, under an answer to each question,
/// holds of all.
pub fn state_machines() -> impl Iterator<Item = &'static Edition> {
    Edition::ALL.iter().enumerate().filter_map(|(place, edition)| {
        let before = Edition::ALL.iter().take(place);
        let known = before.into_iter().any(|other| have_the_same_state_machine(other, edition));
        (!known).then_some(*edition)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_edition_has_the_state_machine_of_one_that_stands_for_it() {
        let all: Vec<_> = state_machines().collect();
        for edition in Edition::ALL {
            let same = all.iter().filter(|other| have_the_same_state_machine(other, edition)).count();
            assert_eq!(same, 1, "{}", edition.version);
        }
        let [one, other] = ["3.0", "4.0"].map(|version| Edition::find(version).expect("an edition"));
        assert!(!have_the_same_state_machine(one, other) && all.contains(&one) && all.contains(&other));
        let shorter = one.with_timing(other.rules.timing);
        assert!(!have_the_same_state_machine(one, &shorter), "another time is another machine");
    }
}
