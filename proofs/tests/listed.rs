//! The list of theorems and the harnesses in the sources are the same.

mod sources;

use std::collections::BTreeSet;

use adsdv_proofs::{readings, theorems};
use adsdv_spec::{Choice, Edition};
use sources::sources;

/// The names of the functions that Kani proves: written down, or made by a macro, that of `readings.rs` or `harnesses!`.
fn harnesses() -> Vec<String> {
    let mut names = Vec::new();
    for (_, text) in sources() {
        for lines in text.split("\nharnesses! {").skip(1).filter_map(|rest| rest.split("\n}").next()) {
            let made = lines.lines().filter(|line| !line.trim_start().starts_with("//"));
            names.extend(made.filter_map(|line| Some(line.split_once(" = ")?.0.trim().to_owned())));
        }
        let mut lines = text.lines();
        while let Some(line) = lines.next() {
            if line.trim_start().starts_with("#[cfg_attr(kani, kani::proof") {
                let function = lines.find(|line| line.contains("pub fn ")).unwrap();
                let name = function.trim().trim_start_matches("pub fn ").split('(').next().unwrap();
                if !name.starts_with('$') {
                    names.push(name.to_owned());
                }
            }
        }
    }
    names.extend(readings::CHOICES.iter().map(|&(name, ..)| name.to_owned()));
    names
}

#[test]
fn every_harness_is_listed_once_and_nothing_else_is() {
    let mut listed: Vec<String> = theorems::all().map(|theorem| theorem.name.to_owned()).collect();
    let mut found = harnesses();
    listed.sort();
    found.sort();
    assert_eq!(listed, found);
    let names: BTreeSet<&String> = listed.iter().collect();
    assert_eq!(names.len(), listed.len(), "a name is there twice");
}

#[test]
fn every_choice_but_the_defaults_has_its_theorem() {
    // Those of 3.0 under 3.0; and under 4.0 those that 3.0 does not have, or has as defaults. 2026 has those of 4.0, and its
    // state machine: a theorem says so.
    let (old, new) = (Edition::V3_0.alternatives(), Edition::V4_0.alternatives());
    let of_old = old.iter().map(|choice| ("3.0", choice));
    let of_new = new.difference(old).iter().map(|choice| ("4.0", choice));
    let expected: Vec<(&str, Choice)> = of_old.chain(of_new).collect();
    let choices: Vec<(&str, Choice)> =
        readings::CHOICES.iter().map(|&(_, edition, choice)| (edition.version, choice)).collect();
    assert_eq!(choices, expected);
}
