//! Every requirement is named by a test, or left out for a reason that its sentence bears out.

use std::collections::{BTreeMap, BTreeSet, HashSet};

use adsdv_conform::suite::{self, Reason, Test};
use adsdv_spec::Edition;

const REQUIREMENTS: &str = include_str!("../../../spec/REQUIREMENTS.md");

/// Each requirement with its sentence, whatever edition it holds in.
fn sentences(text: &str) -> BTreeMap<&str, &str> {
    text.lines().filter_map(|line| line.strip_prefix("- **")?.split_once("** ")).collect()
}

/// Whether a sentence holds in an edition: its parentheses name that one, or none.
fn holds_in(sentence: &str, edition: &Edition) -> bool {
    let (_, places) = sentence.rsplit_once(" (").unwrap_or_else(|| panic!("no places: {sentence}"));
    !places.contains(':') || places.split("; ").any(|part| part.split(": ").next() == Some(edition.version))
}

/// Each requirement of an edition with its sentence.
fn requirements(edition: &Edition) -> BTreeMap<&'static str, &'static str> {
    let mut all = sentences(REQUIREMENTS);
    all.retain(|_, sentence| holds_in(sentence, edition));
    all
}

/// The requirements that tests of an edition name.
fn named(edition: &Edition) -> BTreeSet<String> {
    suite::generate(edition).into_iter().flat_map(|test| test.requirements).collect()
}

/// The party that a sentence binds.
fn binds(id: &str) -> &'static str {
    let sentence = sentences(REQUIREMENTS)[id];
    let parties = ["The VCU ", "The AI Computer ", "The operator ", "The scrutineers ", "The codec "];
    parties
        .into_iter()
        .find(|party| sentence.starts_with(party))
        .unwrap_or_else(|| panic!("{id}: {sentence}"))
}

#[test]
fn every_requirement_is_named_by_a_test_or_left_out_for_a_reason() {
    for edition in Edition::ALL {
        let left_out: Vec<String> = suite::untested(edition).map(|untested| untested.id).collect();
        let mut all: Vec<String> = named(edition).into_iter().chain(left_out).collect();
        all.sort_unstable();
        let mut expected: Vec<String> = requirements(edition).into_keys().map(str::to_owned).collect();
        expected.sort_unstable();
        assert!(expected.len() > 200);
        let missing: Vec<_> = expected.iter().filter(|id| !all.contains(id)).collect();
        let version = edition.version;
        assert!(
            missing.is_empty(),
            "{missing:?} of {version}: in no test, and not in conform/src/suite/untested.rs"
        );
        // None is there twice, and none is something else.
        assert_eq!(all, expected, "{version}");
    }
}

#[test]
fn what_is_left_out_holds_in_its_edition() {
    for edition in Edition::ALL {
        let requirements = requirements(edition);
        for untested in suite::untested(edition) {
            assert!(requirements.contains_key(untested.id.as_str()), "{}: {}", edition.version, untested.id);
        }
    }
}

#[test]
fn the_reason_is_that_of_the_sentence() {
    for edition in Edition::ALL {
        for untested in suite::untested(edition) {
            let (id, reason) = (untested.id.as_str(), untested.reason);
            let party = binds(id);
            match reason {
                Reason::AnotherParty => assert!(party != "The VCU " && party != "The codec ", "{id}"),
                Reason::Codec => assert_eq!(party, "The codec ", "{id}"),
                Reason::Frames | Reason::NotShown | Reason::Permission => {
                    assert_eq!(party, "The VCU ", "{id}");
                }
            }
            assert_eq!(reason.is_about_the_vcu(), party == "The VCU ", "{id}");
            let may = sentences(REQUIREMENTS)[id].contains(" MAY ");
            assert_eq!(reason == Reason::Permission, party == "The VCU " && may, "{id}");
            assert!(!reason.to_string().is_empty());
        }
    }
    for id in Edition::ALL.iter().flat_map(|edition| named(edition)) {
        // What the AI Computer may take its time for is the VCU's to bear.
        assert!(binds(&id) == "The VCU " || id == "HS-13", "{id}");
    }
}

#[test]
fn what_is_about_the_vcu_is_what_its_sentences_are() {
    let (_, readings) = REQUIREMENTS.split_once("\n### Readings\n").expect("a section of them");
    let (readings, _) = readings.split_once("\n### ").expect("a section behind it");
    let readings = sentences(readings);
    assert!(readings.len() > 10);
    for edition in Edition::ALL {
        let named = named(edition);
        let expected: HashSet<String> = requirements(edition)
            .into_keys()
            .filter(|&id| {
                binds(id) == "The VCU " && !readings.contains_key(id) || id == "HS-13" && named.contains(id)
            })
            .map(str::to_owned)
            .collect();
        assert_eq!(suite::about_the_vcu(edition), expected, "{}", edition.version);
    }
}

#[test]
fn names_are_unique_and_every_test_has_something_to_check() {
    for edition in Edition::ALL {
        unique_and_not_empty(&suite::generate(edition));
    }
}

fn unique_and_not_empty(tests: &[Test]) {
    let names: HashSet<&str> = tests.iter().map(|test| test.name.as_str()).collect();
    assert_eq!(names.len(), tests.len());
    let scenarios: Vec<_> = tests.iter().map(|test| &test.scenario).collect();
    for (place, one) in scenarios.iter().enumerate() {
        assert!(!scenarios[..place].contains(one), "{} is there twice", tests[place].name);
    }
    for test in tests {
        assert!(!test.requirements.is_empty() && !test.about.is_empty(), "{}", test.name);
        assert!((1..=9).contains(&test.scenario.steps.len()), "{}", test.name);
    }
}
