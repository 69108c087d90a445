//! Every requirement is named by a test, or left out for a reason that its sentence bears out.

use std::collections::{BTreeMap, BTreeSet, HashSet};

use adsdv_oracle::suite::{self, Reason};
use adsdv_spec::Edition;

use crate::tests;

const REQUIREMENTS: &str = include_str!("../../../spec/REQUIREMENTS.md");

/// Each requirement with its sentence.
fn requirements() -> BTreeMap<&'static str, &'static str> {
    let items = REQUIREMENTS.lines().filter_map(|line| line.strip_prefix("- **")?.split_once("** "));
    items.collect()
}

/// The requirements that tests name.
fn named() -> BTreeSet<String> {
    tests().into_iter().flat_map(|test| test.requirements).collect()
}

/// The party that a sentence binds.
fn binds(id: &str) -> &'static str {
    let sentence = requirements()[id];
    let parties = ["The VCU ", "The AI Computer ", "The operator ", "The scrutineers ", "The codec "];
    parties
        .into_iter()
        .find(|party| sentence.starts_with(party))
        .unwrap_or_else(|| panic!("{id}: {sentence}"))
}

#[test]
fn every_requirement_is_named_by_a_test_or_left_out_for_a_reason() {
    let left_out: Vec<String> = suite::untested().map(|untested| untested.id).collect();
    let mut all: Vec<String> = named().into_iter().chain(left_out).collect();
    all.sort_unstable();
    let mut expected: Vec<String> = requirements().into_keys().map(str::to_owned).collect();
    expected.sort_unstable();
    assert!(expected.len() > 200);
    // None is missing, none is there twice, and none is something else.
    assert_eq!(all, expected);
}

#[test]
fn the_reason_is_that_of_the_sentence() {
    for untested in suite::untested() {
        let (id, reason) = (untested.id.as_str(), untested.reason);
        let party = binds(id);
        match reason {
            Reason::AnotherParty => assert!(party != "The VCU " && party != "The codec ", "{id}"),
            Reason::Codec => assert_eq!(party, "The codec ", "{id}"),
            Reason::Frames | Reason::NotShown | Reason::Permission => assert_eq!(party, "The VCU ", "{id}"),
        }
        assert_eq!(reason.is_about_the_vcu(), party == "The VCU ", "{id}");
        assert_eq!(reason == Reason::Permission, party == "The VCU " && requirements()[id].contains(" MAY "));
        assert!(!reason.to_string().is_empty());
    }
    for id in named() {
        // What the AI Computer may take its time for is the VCU's to bear.
        assert!(binds(&id) == "The VCU " || id == "HS-13", "{id}");
    }
}

#[test]
fn what_is_about_the_vcu_is_what_its_sentences_are() {
    let readings = |id: &str| {
        id.strip_prefix("D-").is_some_and(|number| number.parse::<u32>().is_ok_and(|number| number <= 11))
    };
    let mut expected: HashSet<String> = requirements()
        .into_keys()
        .filter(|id| binds(id) == "The VCU " && !readings(id))
        .map(str::to_owned)
        .collect();
    expected.insert("HS-13".to_owned());
    assert_eq!(suite::about_the_vcu(Edition::DEFAULT), expected);
}

#[test]
fn names_are_unique_and_every_test_has_something_to_check() {
    let tests = tests();
    let names: HashSet<&str> = tests.iter().map(|test| test.name.as_str()).collect();
    assert_eq!(names.len(), tests.len());
    let scenarios: Vec<_> = tests.iter().map(|test| &test.scenario).collect();
    for (place, one) in scenarios.iter().enumerate() {
        assert!(!scenarios[..place].contains(one), "{} is there twice", tests[place].name);
    }
    for test in &tests {
        assert!(!test.requirements.is_empty() && !test.about.is_empty(), "{}", test.name);
        assert!((1..=8).contains(&test.scenario.steps.len()), "{}", test.name);
    }
}
