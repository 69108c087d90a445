//! `adsdv suite`: every line keeps to its schema, the proof is complete, and what it prints can be read.

use adsdv_oracle::protocol::{Domain, INPUTS, SHOWN};
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
    let read = adsdv_oracle::suite::read(printed.stdout.as_bytes(), &Machine::REFERENCE).expect("bytes");
    assert_eq!(read.bad, []);
    assert_eq!(read.tests, adsdv_oracle::suite::generate(Edition::DEFAULT));
}

/// The schema says of each key what the protocol does.
#[test]
fn the_schema_has_every_key_with_its_values() {
    let schema: Value = serde_json::from_slice(&file("cli/schema/suite.schema.json")).expect("JSON");
    let keys = |of: &str| schema["$defs"][of]["properties"].as_object().map_or(0, serde_json::Map::len);
    assert_eq!((keys("inputs"), keys("outputs")), (INPUTS.len(), SHOWN.len()));
    let inputs = INPUTS.iter().map(|field| ("inputs", field.key, field.domain));
    for (of, key, domain) in inputs.chain(SHOWN.map(|field| ("outputs", field.key, field.domain))) {
        let said = &schema["$defs"][of]["properties"][key];
        match domain {
            Domain::Flag => assert_eq!(said["type"], "boolean", "{key}"),
            Domain::Names(names) => {
                let names: Vec<&str> = names.iter().map(|&(_, name)| name).collect();
                assert_eq!(said["enum"], json!(names), "{key}");
            }
            Domain::Number { min, max } => {
                assert_eq!((&said["minimum"], &said["maximum"]), (&json!(min), &json!(max)), "{key}");
            }
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
