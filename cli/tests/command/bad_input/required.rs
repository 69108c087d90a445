//! `check --require`: what a log has to show, and what none can.

use serde_json::{Value, json};

use super::{refused, run};
use crate::run::MISSION;

#[test]
pub(super) fn a_log_that_does_not_show_what_is_required() {
    for (required, why) in [("EMERGENCY_BRAKE", "520h never showed it"), ("SM-15", "never exercised")] {
        let outcome = run(&["check", "--require", "AS_DRIVING", "--require", required, MISSION]);
        assert_eq!((outcome.status, outcome.stderr.as_str()), (Some(1), ""));
        let last: Vec<&str> = outcome.stdout.lines().rev().take(2).collect();
        assert_eq!(last[0], format!("{MISSION}: required and missing: {required} ({why})"));
        assert!(last[1].starts_with(&format!("{MISSION}: conforms (0 violations")), "{}", last[1]);
    }
    let of_3_0 = run(&["check", "--edition", "3.0", "--require", "DTE-4", MISSION]);
    assert_eq!(of_3_0.status, Some(1), "{}", of_3_0.stderr);
    let shown = run(&["check", "--require", "AS_FINISHED", "--require", "ai", "--require", "DRV-3", MISSION]);
    assert_eq!((shown.status, shown.stdout.contains("required")), (Some(0), false), "{}", shown.stderr);
}

#[test]
pub(super) fn what_is_required_stands_in_the_json() {
    let outcome = run(&["check", "--json", "--require", "vcu", "--require", "EMERGENCY_BRAKE", MISSION]);
    assert_eq!(outcome.status, Some(1));
    let report: Value = serde_json::from_str(&outcome.stdout).expect("JSON");
    let expected = json!([{ "what": "vcu", "met": true }, { "what": "EMERGENCY_BRAKE", "met": false }]);
    assert_eq!((&report["required"], &report["verdict"]), (&expected, &json!("conforms")));
    assert!(crate::schema::validator("check").is_valid(&report));
    let not_asked = run(&["check", "--json", MISSION]).stdout;
    assert!(!not_asked.contains("\"required\""));
}

#[test]
pub(super) fn what_no_log_can_show() {
    for (required, expected) in [
        ("DRV-99", "the nearest are DRV-15, "),
        ("AS_PARKED", "expected ai, vcu, AS_OFF, AS_READY, AS_DRIVING, EMERGENCY_BRAKE, AS_FINISHED or "),
        ("DRV-1", "no log can show that requirement"),
    ] {
        let outcome = run(&["check", "--require", required, MISSION]);
        assert_eq!((outcome.status, outcome.stdout.as_str()), (Some(2), ""));
        assert!(outcome.stderr.contains(required) && outcome.stderr.contains(expected), "{}", outcome.stderr);
    }
    // A requirement of another edition: of the one that is named, and of the one that the log speaks.
    let expected = "--require DTE-4: edition 4.0 has no such requirement; ";
    for edition in [&["--edition", "4.0"][..], &[]] {
        let outcome = run(&[&["check", "--require", "DTE-4"], edition, &[MISSION]].concat());
        refused(&outcome, expected, "--edition names another");
    }
}
