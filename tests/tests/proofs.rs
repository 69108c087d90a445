//! The model and the proofs claim the same: what one checks of every reachable step, the other proves of any step.

use std::collections::BTreeSet;

use adsdv_model::properties;
use adsdv_proofs::theorems;
use adsdv_spec::Edition;

/// Where the theorems of safety stand.
const SAFETY: &str = "adsdv_proofs::safety";

#[test]
fn every_safety_property_of_the_model_is_a_theorem_and_every_such_theorem_a_property() {
    let properties: BTreeSet<String> =
        properties(Edition::DEFAULT).map(|property| property.name.replace('-', "_")).collect();
    // What version 4.0 adds stands in a module of its own, and its theorems are about the causes as well.
    let in_safety = |module: &str| {
        let rest = module.strip_prefix(SAFETY);
        rest.is_some_and(|rest| rest.is_empty() || rest.starts_with("::") && rest != "::v4_0")
    };
    let proven: BTreeSet<String> = theorems::all()
        .filter(|theorem| in_safety(theorem.module))
        .map(|theorem| theorem.name.to_owned())
        .collect();
    assert_eq!(proven, properties, "left: the theorems of {SAFETY}; right: the properties of the model");
}
