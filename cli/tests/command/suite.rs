//! `adsdv suite`: every line keeps to its schema, the proof is complete, and what it prints can be read.

use std::collections::{BTreeMap, HashSet};

use adsdv_conform::protocol::{Domain, INPUTS, Protocol, SHOWN};
use adsdv_spec::{Edition, Machine};
use serde_json::{Value, json};

use crate::run::{file, run};
use crate::schema::validator;

#[test]
fn every_line_is_a_test_and_keeps_to_the_schema() {
    let printed = run(&["suite"]);
    assert_eq!((printed.status, printed.stderr.as_str()), (Some(0), ""));
    let validator = validator("suite");
    for line in printed.stdout.lines() {
        let test: Value = serde_json::from_str(line).expect("JSON");
        let errors: Vec<_> = validator.iter_errors(&test).map(|error| error.to_string()).collect();
        assert!(errors.is_empty(), "{}: {errors:#?}", test["name"]);
    }
    let read = adsdv_conform::suite::read(printed.stdout.as_bytes(), &Machine::REFERENCE).expect("bytes");
    assert_eq!(read.bad, []);
    assert_eq!(read.tests, adsdv_conform::suite::generate(Edition::DEFAULT));
}

/// The schema says of each key what the protocol does in one edition or another.
#[test]
fn the_schema_has_every_key_with_its_values() {
    let schema: Value = serde_json::from_slice(&file("cli/schema/suite.schema.json")).expect("JSON");
    let keys = |of: &str| schema["$defs"][of]["properties"].as_object().map_or(0, serde_json::Map::len);
    assert_eq!((keys("inputs"), keys("outputs")), (INPUTS.len(), SHOWN.len()));
    let mut domains: BTreeMap<(&str, &str), Vec<Domain>> = BTreeMap::new();
    for protocol in Edition::ALL.iter().map(|edition| Protocol::of(edition)) {
        let inputs = protocol.inputs().map(|(field, domain)| (("inputs", field.key), domain));
        let shown = protocol.shown().map(|(field, domain)| (("outputs", field.key), domain));
        for (key, domain) in inputs.chain(shown) {
            domains.entry(key).or_default().push(domain);
        }
    }
    assert_eq!(domains.len(), INPUTS.len() + SHOWN.len());
    for ((of, key), domains) in domains {
        let said = &schema["$defs"][of]["properties"][key];
        let (mut names, mut ranges) = (Vec::new(), Vec::new());
        for domain in domains {
            match domain {
                Domain::Flag => assert_eq!(said["type"], "boolean", "{key}"),
                Domain::Names(all) => names.extend(all.iter().map(|&(_, name)| name)),
                Domain::Number { min, max } => ranges.push((min, max)),
            }
        }
        let mut known = HashSet::new();
        names.retain(|name| known.insert(*name));
        assert!(names.is_empty() || said["enum"] == json!(names), "{key}: {names:?}");
        if let (Some(min), Some(max)) = (ranges.iter().map(|r| r.0).min(), ranges.iter().map(|r| r.1).max()) {
            assert_eq!((&said["minimum"], &said["maximum"]), (&json!(min), &json!(max)), "{key}");
        }
    }
}

#[test]
fn another_reading_expects_something_else() {
    let usual = run(&["suite"]).stdout;
    let other = run(&["suite", "--reading", "fault-trigger=edge"]);
    assert_eq!(other.status, Some(0));
    assert_eq!(usual.lines().count(), other.stdout.lines().count());
    assert_ne!(usual, other.stdout);
}

#[test]
fn the_proof_is_complete() {
    let printed = run(&["suite", "--prove"]);
    assert_eq!((printed.status, printed.stderr.as_str()), (Some(0), ""));
    let proof: Value = serde_json::from_str(&run(&["suite", "--prove", "--json"]).stdout).expect("JSON");
    let errors: Vec<_> = validator("prove").iter_errors(&proof).map(|error| error.to_string()).collect();
    assert!(errors.is_empty(), "{errors:#?}");
    assert_eq!((&proof["killed"], &proof["survivors"]), (&proof["mutants"], &json!([])));
    let killed = format!("killed {} of {}", proof["killed"], proof["mutants"]);
    assert!(
        printed.stdout.contains(&killed) && printed.stdout.contains("\ncomplete\n"),
        "{}",
        printed.stdout
    );
    assert!(printed.stdout.contains(&format!("{} tests, {} steps", proof["tests"], proof["steps"])));
}

#[test]
fn options_that_do_not_go_together_are_refused() {
    for arguments in [&["suite", "--json"][..], &["suite", "--prove", "--reading", "go-edge=edge"]] {
        let refused = run(arguments);
        assert_eq!(refused.status, Some(2), "{arguments:?}");
        assert!(refused.stderr.contains("--prove"), "{}", refused.stderr);
    }
    assert_eq!(run(&["suite", "--reading", "go-edge=never"]).status, Some(2));
}
