//! `adsdv exam`: what it tells of AI Computers, for people and for programs.

use std::path::PathBuf;
use std::process::Command;
use std::sync::OnceLock;

use serde_json::Value;

use crate::run::{Outcome, run, workspace};
use crate::schema::validator;

/// The file of the example with the mistakes, which is built if it is not.
fn mutant() -> &'static str {
    static FILE: OnceLock<String> = OnceLock::new();
    FILE.get_or_init(|| {
        // This test is DIR/debug/deps/command-...
        let test = std::env::current_exe().expect("a path");
        let profile: PathBuf =
            test.parent().and_then(|deps| deps.parent()).expect("a folder of cargo").to_owned();
        let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
        let built = Command::new(cargo)
            .args(["build", "--quiet", "-p", "adsdv-exam", "--example", "ai_mutant", "--target-dir"])
            .arg(profile.parent().expect("a folder of cargo"))
            .current_dir(workspace())
            .status();
        assert!(built.is_ok_and(|status| status.success()), "the example can be built");
        let folder = profile.with_file_name("debug").join("examples");
        let file = folder.join(format!("ai_mutant{}", std::env::consts::EXE_SUFFIX));
        file.to_str().expect("a path of text").to_owned()
    })
}

/// Examines an AI Computer with this mistake, or without one.
fn examined(options: &[&str], mistake: &[&str]) -> Outcome {
    run(&[&["exam", "--stdio"], options, &["--", mutant()], mistake].concat())
}

/// The JSON, which has to keep to its schema and to say what the exit status does.
fn report(options: &[&str], mistake: &[&str]) -> Value {
    let outcome = examined(&[options, &["--json"]].concat(), mistake);
    assert_eq!((outcome.stdout.lines().count(), outcome.stderr.as_str()), (1, ""));
    let report: Value = serde_json::from_str(&outcome.stdout).expect("JSON");
    let errors: Vec<_> = validator("exam").iter_errors(&report).map(|error| error.to_string()).collect();
    assert!(errors.is_empty(), "{errors:#?}");
    assert_eq!(report["passes"], outcome.status == Some(0), "{:?}", outcome.status);
    report
}

#[test]
fn the_reference_passes_through_standard_input_as_well() {
    for edition in ["3.0", "4.0", "2026"] {
        let report = report(&["--edition", edition], &[]);
        assert_eq!((&report["passes"], &report["edition"]), (&Value::from(true), &Value::from(edition)));
        assert_eq!(report["scenarios"].as_array().map(Vec::len), Some(43));
    }
}

/// What is wrong stands in the first screen.
#[test]
fn each_mistake_is_printed_first() {
    for (edition, mistake, expected) in [
        ("4.0", "silent", "MSG-5   sends AI2VCU_Status (510h)"),
        ("4.0", "never-selects", "RDY-7   confirms the mission that is selected"),
        ("4.0", "floods", "MSG-98  sends 510h to 514h every 10 ms"),
        ("3.0", "answers-late", "HS-5    answers the HANDSHAKE bit of 520h"),
        ("4.0", "answers-late", "HS-5    answers the HANDSHAKE bit of 520h"),
        ("4.0", "sends-a-reserved-identifier", "ID-8    does not send 301h"),
        ("4.0", "brakes-and-drives", "IMP-8   does not drive and brake at once"),
    ] {
        let outcome = examined(&["--edition", edition, "--only", "mission-skidpad"], &[mistake]);
        assert_eq!((outcome.status, outcome.stderr.as_str()), (Some(1), ""), "{mistake}");
        let screen: Vec<&str> = outcome.stdout.lines().take(24).collect();
        assert!(screen[0].starts_with(&format!("edition {edition}")), "{}", screen[0]);
        assert!(screen.iter().any(|line| line.contains(expected)), "{mistake}: {screen:#?}");
    }
}

/// A finding of the judge has the words and the rule that `adsdv check` has for the log.
#[test]
fn the_log_of_a_scenario_is_judged_with_the_same_words() {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("exam-logs");
    // It may be there from an earlier run.
    let _ = std::fs::remove_dir_all(&folder);
    let folder = folder.to_str().expect("text");
    for (mistake, rule) in [
        ("finishes-at-speed", "finished-while-moving"),
        ("sends-a-reserved-identifier", "reserved-identifier"),
        ("brakes-too-much-behind", "value-out-of-range"),
    ] {
        let options = ["--edition", "4.0", "--only", "mission-skidpad", "--logs", folder];
        let exam = report(&options, &[mistake]);
        let checked = run(&["check", "--edition", "4.0", "--json", &format!("{folder}/mission-skidpad.log")]);
        let check: Value = serde_json::from_str(&checked.stdout).expect("JSON");
        let words = |report: &Value, rule: &str| -> Vec<String> {
            let all = report["findings"].as_array().expect("a list").iter();
            let of_rule = all.filter(|one| one["rule"] == rule);
            of_rule.map(|one| format!("{}; expected {}", one["seen"], one["expected"])).collect()
        };
        let found = words(&exam, rule);
        assert!(!found.is_empty() && words(&check, rule).contains(&found[0]), "{mistake}: {found:?}");
    }
}

#[test]
fn the_scenarios_are_listed_and_chosen() {
    let list = run(&["exam", "--list"]);
    assert_eq!((list.status, list.stderr.as_str()), (Some(0), ""));
    assert_eq!(list.stdout.lines().count(), 43);
    let some = run(&["exam", "--list", "--only", "go-", "--only", "ready"]);
    assert!(some.stdout.lines().all(|line| line.starts_with("go-") || line.starts_with("ready ")));
    let none = run(&["exam", "--stdio", "--only", "nothing", "--", "cat"]);
    assert_eq!((none.status, none.stdout.as_str()), (Some(2), ""));
    assert!(none.stderr.contains("--only nothing: no scenario begins so; expected one of no-mission, "));
}

#[test]
fn what_passed_is_listed_if_somebody_asks() {
    let outcome = examined(&["--edition", "4.0", "--only", "mission-skidpad", "--all"], &[]);
    assert!(
        outcome.stdout.contains("\n  RDY-7   confirms the mission that is selected\n"),
        "{}",
        outcome.stdout
    );
    assert_eq!(outcome.status, Some(0));
}

/// The examples that teams begin with.
#[test]
fn the_examples_pass() {
    let python =
        Command::new("python3").arg("--version").output().is_ok_and(|output| output.status.success());
    if python {
        let outcome =
            run(&["exam", "--stdio", "--edition", "4.0", "--", "python3", "exam/examples/stack.py"]);
        assert_eq!(outcome.status, Some(0), "{}{}", outcome.stdout, outcome.stderr);
    }
    let program = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("exam-minimal");
    let built = Command::new("cc")
        .args(["-O1", "-Wall", "-Wextra", "-Werror", "-std=c99", "-o"])
        .arg(&program)
        .arg("exam/examples/minimal.c")
        .current_dir(workspace())
        .status();
    if built.is_ok_and(|status| status.success()) {
        let program = program.to_str().expect("text");
        let outcome = run(&["exam", "--stdio", "--edition", "2026", "--", program]);
        assert_eq!(outcome.status, Some(0), "{}{}", outcome.stdout, outcome.stderr);
    }
}
