//! What a property says that it covers is there, and no two have the same name.

use std::collections::HashSet;

use adsdv_model::closed::CLOSED_PROPERTIES;
use adsdv_model::{PROPERTIES, goals, properties};
use adsdv_spec::Edition;

const REQUIREMENTS: &str = include_str!("../../spec/REQUIREMENTS.md");

fn is_requirement(id: &str) -> bool {
    REQUIREMENTS.contains(&format!("\n- **{id}** "))
}

#[test]
fn each_requirement_cited_is_one() {
    let closed = CLOSED_PROPERTIES.iter().map(|property| (property.name, property.requirements));
    let open = PROPERTIES.iter().map(|property| (property.name, property.requirements));
    for (name, requirements) in open.chain(closed) {
        for id in requirements {
            assert!(is_requirement(id), "{name}: {id}");
            let asked_for = Edition::ALL.iter().any(|edition| edition.requirements.has(id));
            assert!(asked_for, "{name}: no edition asks for {id}");
        }
    }
    for edition in Edition::ALL {
        for property in properties(edition) {
            let covered = property.requirements_in(edition);
            assert!(!covered.is_empty(), "{}: {} covers nothing", edition.version, property.name);
        }
        for property in CLOSED_PROPERTIES {
            let covered = property.requirements_in(edition);
            assert_eq!(
                covered.is_empty(),
                property.requirements.is_empty(),
                "{}: {}",
                edition.version,
                property.name
            );
        }
        for goal in goals(edition) {
            let section = edition.rules.table.rows().iter().any(|row| row.section == goal.requirement);
            let asked_for = edition.requirements.has(goal.requirement);
            assert!(section || asked_for, "{}: {}: {}", edition.version, goal.name, goal.requirement);
        }
    }
    assert!(!is_requirement("SM-99"));
}

/// What 4.0 added to the way out of AS_DRIVING, and to the handshake, has a property each.
#[test]
fn what_an_edition_adds_to_figure_2_is_covered() {
    for id in [
        "DTE-7", "DTE-8", "DTE-9", "DTE-10", "DTE-11", "DTE-12", "DTE-13", "HS-17", "HS-18", "IMP-7", "IMP-8",
    ] {
        let covers =
            |property: &&adsdv_model::Property| property.requirements_in(&Edition::V4_0).contains(&id);
        assert!(properties(&Edition::V4_0).any(|property| covers(&property)), "{id}");
    }
}

#[test]
fn names_are_unique_and_can_be_part_of_a_file_name() {
    let names = properties(Edition::DEFAULT).map(|property| property.name);
    let names = names.chain(goals(Edition::DEFAULT).iter().map(|goal| goal.name));
    let names = names.chain(CLOSED_PROPERTIES.iter().map(|property| property.name));
    let mut seen = HashSet::new();
    for name in names {
        assert!(seen.insert(name), "{name} is there twice");
        assert!(
            name.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || "-.".contains(c)),
            "{name}"
        );
    }
}
