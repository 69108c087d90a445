//! What a property says that it covers is there, and no two have the same name.

use std::collections::HashSet;

use adsdv_model::closed::CLOSED_PROPERTIES;
use adsdv_model::{goals, properties};
use adsdv_spec::Edition;

const REQUIREMENTS: &str = include_str!("../../spec/REQUIREMENTS.md");

fn is_requirement(id: &str) -> bool {
    REQUIREMENTS.contains(&format!("\n- **{id}** "))
}

#[test]
fn each_requirement_cited_is_one() {
    for property in properties(Edition::DEFAULT) {
        assert!(!property.requirements.is_empty(), "{} covers nothing", property.name);
    }
    let open = properties(Edition::DEFAULT).map(|property| (property.name, property.requirements));
    let closed = CLOSED_PROPERTIES.iter().map(|property| (property.name, property.requirements));
    for (name, requirements) in open.chain(closed) {
        for id in requirements {
            assert!(is_requirement(id), "{name}: {id}");
        }
    }
    for goal in goals(Edition::DEFAULT) {
        let section = Edition::DEFAULT.rules.table.rows().iter().any(|row| row.section == goal.requirement);
        assert!(section || is_requirement(goal.requirement), "{}: {}", goal.name, goal.requirement);
    }
    assert!(!is_requirement("SM-99"));
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
