//! The model and the proofs claim the same: what one checks of every reachable step, the other proves of any step.

use std::collections::BTreeSet;

use adsdv_model::PROPERTIES;
use adsdv_proofs::theorems;

/// Where the theorems of safety stand.
const SAFETY: &str = "adsdv_proofs::safety";

#[test]
fn every_safety_property_of_the_model_is_a_theorem_and_every_such_theorem_a_property() {
    let properties: BTreeSet<String> =
        PROPERTIES.iter().map(|property| property.name.replace('-', "_")).collect();
    let in_safety = |module: &str| {
        module.strip_prefix(SAFETY).is_some_and(|rest| rest.is_empty() || rest.starts_with("::"))
    };
    let proven: BTreeSet<String> = theorems::all()
        .filter(|theorem| in_safety(theorem.module))
        .map(|theorem| theorem.name.to_owned())
        .collect();
    assert_eq!(proven, properties, "left: the theorems of {SAFETY}; right: the properties of the model");
}
