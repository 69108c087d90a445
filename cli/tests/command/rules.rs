//! `adsdv check --rules`: a team's own rules in the report, and the examples of `RULES.md`.

use std::path::PathBuf;

use serde_json::Value;

use crate::golden::compare_text;
use crate::run::{FINISHED_WHILE_MOVING, MISSION, Outcome, file, run, temporary};
use crate::schema::validator;

/// The blocks of rules that `RULES.md` shows.
fn shown() -> Vec<String> {
    let text = String::from_utf8(file("RULES.md")).expect("text");
    let blocks = text.split("```rules\n").skip(1).filter_map(|block| block.split_once("```"));
    blocks.map(|(block, _)| block.to_owned()).collect()
}

fn written(name: &str, rules: &str) -> PathBuf {
    temporary(name, rules.as_bytes())
}

/// What comes of a file of rules: the outcome, and its JSON.
fn judged(rules: &str, name: &str, args: &[&str]) -> (Outcome, Value) {
    let rules = written(name, rules);
    let rules = rules.to_str().expect("a path of text");
    let outcome = run(&[&["check", "--json", "--rules", rules], args].concat());
    let json = serde_json::from_str(&outcome.stdout).unwrap_or_else(|_| panic!("{}", outcome.stderr));
    (outcome, json)
}

fn values<'a>(report: &'a Value, key: &str) -> Vec<&'a Value> {
    report["rules"].as_array().expect("an array").iter().map(|rule| &rule[key]).collect()
}

#[test]
fn the_reports_have_a_section_for_the_rules() {
    let rules = written("rules-golden.rules", &shown()[0]);
    let rules = rules.to_str().expect("a path of text");
    for (golden, log, status) in
        [("rules-mission.txt", MISSION, 1), ("rules-finished-while-moving.txt", FINISHED_WHILE_MOVING, 1)]
    {
        let Outcome { status: ended, stdout, stderr } = run(&["check", "--rules", rules, log]);
        assert_eq!((ended, stderr.as_str()), (Some(status), ""));
        compare_text(golden, &stdout);
    }
}

#[test]
fn every_example_can_be_judged_and_the_json_has_each_rule() {
    let examples = shown();
    assert!(examples.len() > 5, "{examples:?}");
    for (number, example) in examples.iter().enumerate() {
        let name = format!("rules-example-{number}.rules");
        for log in [MISSION, FINISHED_WHILE_MOVING] {
            let (_, report) = judged(example, &name, &[log]);
            if let Err(error) = validator("check").validate(&report) {
                panic!("{error}");
            }
            let names: Vec<&str> = values(&report, "name").iter().filter_map(|name| name.as_str()).collect();
            let lines = example.lines().filter(|line| !line.trim().is_empty() && !line.starts_with('#'));
            let expected: Vec<&str> = lines.filter_map(|line| Some(line.split_once(':')?.0)).collect();
            assert_eq!(names, expected);
        }
    }
}

#[test]
fn a_rule_that_is_broken_is_a_violation_and_others_are_none() {
    let (outcome, report) =
        judged("fine: never AS_STATE is EMERGENCY_BRAKE\n", "rules-fine.rules", &[MISSION]);
    assert_eq!((outcome.status, &report["verdict"]), (Some(0), &"conforms".into()));
    assert_eq!(values(&report, "verdict"), ["holds"]);
    let bad = "\nbad: never AS_STATE is AS_DRIVING \"we push it\"";
    let (outcome, report) = judged(bad, "rules-bad.rules", &["--edition", "3.0", MISSION]);
    assert_eq!((outcome.status, &report["verdict"]), (Some(1), &"violates".into()));
    let findings = report["findings"].as_array().expect("an array");
    let [finding] = &findings.iter().filter(|one| one["rule"] == "custom-rule").collect::<Vec<_>>()[..]
    else {
        panic!("{findings:?}");
    };
    assert_eq!(
        (&finding["party"], &finding["section"], &finding["t"]),
        (&"OWN".into(), &"line 2".into(), &9.000_119.into())
    );
    assert_eq!(values(&report, "note"), ["we push it"]);
}

/// Without the option there is no sign of it.
#[test]
fn without_rules_there_is_no_section() {
    let plain = run(&["check", MISSION]).stdout;
    assert!(
        !plain.contains("CUSTOM RULES") && !run(&["check", "--json", MISSION]).stdout.contains("\"rules\"")
    );
}

#[test]
fn with_every_frame_vouched_for_more_is_decided() {
    let rules = "idle: 511h.FRONT_AXLE_TRQ_REQUEST == 0 until GO_SIGNAL is GO";
    let (_, report) = judged(rules, "rules-idle.rules", &[MISSION]);
    assert_eq!(values(&report, "verdict"), ["never decided"]);
    let (_, report) = judged(rules, "rules-idle-complete.rules", &["--complete", MISSION]);
    assert_eq!(values(&report, "verdict"), ["holds"]);
}

#[test]
fn excerpts_of_rules_are_refused_and_the_help_says_why() {
    let outcome = run(&["check", "--rules", "a", "--excerpt", "b", MISSION]);
    assert_eq!((outcome.status, outcome.stdout.as_str()), (Some(2), ""));
    assert!(outcome.stderr.contains("cannot be used with"), "{}", outcome.stderr);
    let help = run(&["check", "--help"]).stdout.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(help.contains("Not with --excerpt: what breaks a rule may lie far before the finding"));
}
