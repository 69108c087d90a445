//! Of what fails, the fewest choices that fail it, and those that undo it.

use std::collections::{BTreeMap, BTreeSet};

use adsdv_spec::{Choices, Edition};

use super::costs::Cost;
use crate::property::Property;

/// Of all combinations under which something fails, those that fail it with fewest choices.
pub(super) fn minimal(
    edition: &'static Edition,
    failing: BTreeMap<&'static str, BTreeSet<Choices>>,
    explored: &BTreeSet<Choices>,
) -> Vec<Cost> {
    let mut costs = Vec::new();
    for (name, sets) in failing {
        // Of causes that differ in their number alone, one is tried.
        let by_lemma = Property::find(name).is_none() && sets.contains(&Choices::NONE);
        for &choices in sets.iter().filter(|_| !by_lemma) {
            if !sets.iter().any(|fewer| *fewer != choices && fewer.is_subset(choices)) {
                let undone_by = undone_by(choices, &sets, explored);
                costs.push(Cost { edition, name, choices, undone_by, run: None });
            }
        }
    }
    costs
}

/// The choices that, made as well, undo a failure.
pub(super) fn undone_by(
    choices: Choices,
    failing: &BTreeSet<Choices>,
    explored: &BTreeSet<Choices>,
) -> Choices {
    let undoing = Choices::ALL.iter().filter(|&choice| {
        let more = choices.with(choice);
        more != choices && explored.contains(&more) && !failing.contains(&more)
    });
    undoing.fold(Choices::NONE, Choices::with)
}
