//! The answers to the document's questions, ranked by what they can cost.

use std::collections::BTreeMap;

use adsdv_spec::Choices;

use crate::property::{Harm, Property};
use crate::sweep::Sweep;

/// Answers that together fail something, and what that can cost.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Ranked {
    /// The answers; none at all: the default ones fail it.
    pub choices: Choices,
    /// The worst that it can cost.
    pub harm: Harm,
    /// The names of the properties that fail.
    pub fails: Vec<&'static str>,
}

impl Sweep {
    /// What fails, the worst first; of equals the answers that fail most, then in the order of the questions.
    pub fn ranked(&self) -> Vec<Ranked> {
        let mut failed: BTreeMap<Choices, Vec<(&'static str, Harm)>> = BTreeMap::new();
        for cost in &self.costs {
            if let Some(property) = Property::find(cost.name) {
                failed.entry(cost.choices).or_default().push((property.name, cost.harm(property)));
            }
        }
        let ranked = failed.into_iter().filter_map(|(choices, failed)| {
            let harm = failed.iter().map(|(_, harm)| *harm).min()?;
            Some(Ranked { choices, harm, fails: failed.into_iter().map(|(name, _)| name).collect() })
        });
        let mut ranked: Vec<Ranked> = ranked.collect();
        ranked.sort_by_key(|one| (one.harm, std::cmp::Reverse(one.fails.len()), one.choices));
        ranked
    }

    /// The answers that are not the default and fail nothing.
    pub fn free(&self) -> Choices {
        let costly = self.costs.iter().fold(Choices::NONE, |all, cost| all.union(cost.choices));
        self.edition.alternatives().difference(costly)
    }
}
