//! The committed JSON Schemas, which `adsdv schema` prints, and `check --json` against its own.

use std::collections::BTreeSet;
use std::fmt::Write as _;

use adsdv_oracle::judge::{Basis, Measure, Rule, Standing};
use adsdv_spec::AsState;
use jsonschema::Validator;
use serde_json::{Value, json};

use crate::run::{FINISHED_WHILE_MOVING, MISSION, check_input, file, run};

/// The schema of what a command prints with `--json`.
fn schema(command: &str) -> Value {
    let printed = run(&["schema", command]);
    assert_eq!((printed.status, printed.stderr.as_str()), (Some(0), ""), "{command}");
    assert_eq!(printed.stdout.as_bytes(), file(&format!("cli/schema/{command}.schema.json")));
    serde_json::from_str(&printed.stdout).expect("JSON")
}

pub(crate) fn validator(command: &str) -> Validator {
    let schema = schema(command);
    jsonschema::draft202012::meta::validate(&schema).expect("a JSON Schema");
    jsonschema::draft202012::new(&schema).expect("a schema that can be used")
}

#[test]
fn the_schema_is_that_of_check_unless_another_is_named() {
    assert_eq!(run(&["schema"]).stdout, run(&["schema", "check"]).stdout);
    assert_eq!(schema("check")["title"], "adsdv check --json");
    assert_eq!(schema("verify")["title"], "adsdv verify");
}

/// The report of a log, which has to keep to the schema.
fn report(log: &[u8]) -> Value {
    let outcome = check_input(&["--json"], log);
    assert!(matches!(outcome.status, Some(0 | 1)), "{}", outcome.stderr);
    let report: Value = serde_json::from_str(&outcome.stdout).expect("JSON");
    assert_eq!(outcome.stdout.lines().count(), 1, "one object on one line");
    let errors: Vec<_> = validator("check").iter_errors(&report).map(|error| error.to_string()).collect();
    assert!(errors.is_empty(), "{errors:#?}");
    report
}

/// The rules that a report names.
fn rules(report: &Value) -> BTreeSet<&str> {
    let findings = report["findings"].as_array().expect("an array");
    findings.iter().filter_map(|finding| finding["rule"].as_str()).collect()
}

#[test]
fn recorded_logs() {
    let mission = report(&file(MISSION));
    assert_eq!((&mission["verdict"], &mission["frames"]), (&json!("conforms"), &json!(33_940)));
    assert!(mission["handshake_response_ms"]["count"].as_u64() > Some(1000), "{mission}");
    assert_eq!(mission["transitions"].as_array().map(Vec::len), Some(4));
    assert_eq!(report(&file(FINISHED_WHILE_MOVING))["verdict"], "violates");
}

#[test]
fn keys_stand_in_the_documented_order() {
    let text = run(&["check", "--json", MISSION]).stdout;
    let keys = [
        "schema",
        "edition",
        "frames",
        "duration_s",
        "transitions",
        "findings",
        "margins",
        "handshake_response_ms",
        "exercised",
        "verdict",
    ];
    let places: Vec<_> = keys.iter().map(|key| text.find(&format!("\"{key}\":"))).collect();
    assert!(places.iter().all(Option::is_some) && places.is_sorted(), "{places:?}");
}

#[test]
fn one_side_only() {
    let mission = String::from_utf8(file(MISSION)).expect("text");
    for (side, answers) in [(" 51", false), (" 52", false)] {
        let log: String =
            mission.lines().filter(|line| line.contains(side)).flat_map(|l| [l, "\n"]).collect();
        let report = report(log.as_bytes());
        assert!(rules(&report).contains("one-sided"), "{report}");
        assert_eq!(report["handshake_response_ms"].is_object(), answers, "{report}");
    }
}

/// Everything that a log can hold and should not.
fn strange_log() -> String {
    let mut log = String::new();
    for line in [
        "(1795209995.000000) can0 520#0000010000000000",
        "(1795209995.010000) can0 520#FFFFFFFFFFFFFFFF",
        "(1795209995.020000) can0 520#00",
        "(1795209995.030000) can0 520#",
        "(1795209995.030000) can0 502#0000000000000000",
        "(1795209995.040000) can0 510#FFFFFFFFFFFFFFFF",
        "(1795209995.040000) can0 511#7F",
        "(1795209995.050000) can0 513#8000",
        "(1795209995.050000) can0 5FF#0011",
        "(1795209995.060000) can0 18FF50E5#0011",
        "(1795209995.060000) can0 520#R8",
        "(1795209995.060000) can0 20000004#000C000000000000",
        "(1795209995.060000) can0 520##1AABB",
        "(1795209995.060000) can0 45123#81:00:12345678#11223344",
        "(1795209995.070000) can1 520#0000040000000000",
        "rubbish \u{1b}[2J \u{2603} \"quoted\" \\ ",
        "",
        "(1795209995.080000) can0 520#000002000000000",
        "(1795209000.000000) can0 520#0000050000000000",
        "(1795209000.000001) can0 520#0000020000000000",
        "(1795209000.010000) can0 520#0000030000000000",
        "(1795209000.020000) can0 520#0000040000000000",
        "(0.000000) can0 520#0000010000000000",
        "(9223372036.000000001) can0 520#0000030000000000",
    ] {
        log.push_str(line);
        log.push('\n');
    }
    for id in 0x500..0x580 {
        writeln!(log, "(9223372036.5) can0 {id:03X}#0102030405060708").expect("a string");
    }
    log.push_str("(9223372036.6) can0 520#00000"); // It was cut while it was written.
    log
}

#[test]
fn a_log_with_everything_strange() {
    let report = report(strange_log().as_bytes());
    let found = rules(&report);
    for rule in [
        Rule::BrokenLine,
        Rule::NotJudged,
        Rule::TimeBackwards,
        Rule::TooShort,
        Rule::Value,
        Rule::NoArrow,
        Rule::Reserved,
    ] {
        assert!(found.contains(rule.id()), "{} is missing: {found:?}", rule.id());
    }
}

#[test]
fn times_are_in_order_and_rounded_to_microseconds() {
    let report = report(&file(MISSION));
    for list in ["transitions", "findings"] {
        let times: Vec<f64> =
            report[list].as_array().expect("an array").iter().filter_map(|one| one["t"].as_f64()).collect();
        assert!(times.len() > 3 && times.is_sorted(), "{times:?}");
        assert!(times.iter().all(|t| (t * 1e6 - (t * 1e6).round()).abs() < 1e-6), "{times:?}");
    }
}

#[test]
fn the_schemas_name_every_rule_and_state() {
    let rules: Vec<_> = Rule::ALL.iter().map(|rule| rule.id()).collect();
    let states: Vec<_> = AsState::ALL.iter().map(|state| state.name()).collect();
    for name in ["check", "watch"] {
        let all = &schema(name)["$defs"];
        let named = &all["finding"]["properties"]["rule"]["enum"];
        assert_eq!(
            *named,
            json!(rules),
            "left: the rules in cli/schema/{name}.schema.json; right: Rule::ALL"
        );
        let named = &all["state"]["enum"];
        assert_eq!(
            *named,
            json!(states),
            "left: the states in cli/schema/{name}.schema.json; right: AsState::ALL"
        );
    }
}

#[test]
fn the_schemas_name_every_measure_and_every_standing() {
    let measures: Vec<_> = Measure::ALL.iter().map(|measure| measure.id()).collect();
    let bases = [Basis::Document, Basis::Deadline, Basis::Cycle].map(Basis::name);
    let standings = Standing::ALL.map(Standing::name);
    for schema in ["check", "watch"].map(schema) {
        let margin = &schema["$defs"]["margin"]["properties"];
        assert_eq!((&margin["what"]["enum"], &margin["basis"]["enum"]), (&json!(measures), &json!(bases)));
        let requirement = &schema["$defs"]["exercised"]["properties"]["requirements"]["items"];
        assert_eq!(requirement["properties"]["told"]["enum"], json!(standings));
    }
}

/// What is wrong with a document, and how it comes to be wrong.
pub(crate) type Spoil = (&'static str, fn(&mut Value));

#[test]
fn the_schema_refuses_what_is_not_a_report() {
    let good = report(&file(FINISHED_WHILE_MOVING));
    let validator = validator("check");
    let spoil: [Spoil; 14] = [
        ("another key", |r| r["extra"] = json!(1)),
        ("a missing key", |r| _ = r.as_object_mut().map(|o| o.remove("handshake_response_ms"))),
        ("another verdict", |r| r["verdict"] = json!("perhaps")),
        ("another rule", |r| r["findings"][0]["rule"] = json!("no-such-rule")),
        ("another party", |r| r["findings"][0]["party"] = json!("ai")),
        ("another key of a finding", |r| r["findings"][0]["extra"] = json!(1)),
        ("a truth that is no text", |r| r["transitions"][0]["justified"] = json!(true)),
        ("a state that is none", |r| r["transitions"][0]["from"] = json!("AS_PARKED")),
        ("no margins", |r| _ = r.as_object_mut().map(|o| o.remove("margins"))),
        ("another measure", |r| r["margins"][0]["what"] = json!("luck")),
        ("a message that is none", |r| r["margins"][0]["message"] = json!("510")),
        ("another standing", |r| r["exercised"]["requirements"][0]["told"] = json!("yes")),
        ("required, and nothing is", |r| r["required"] = json!([])),
        ("an answer without count", |r| {
            _ = r["handshake_response_ms"].as_object_mut().map(|o| o.remove("count"));
        }),
    ];
    for (what, spoil) in spoil {
        let mut report = good.clone();
        spoil(&mut report);
        assert_ne!(report, good, "{what}");
        assert!(!validator.is_valid(&report), "{what} is accepted");
    }
}
