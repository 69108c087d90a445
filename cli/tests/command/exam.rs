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
    let told = examined(&[options, &["--json"]].concat(), mistake);
    assert_eq!((told.stdout.lines().count(), told.stderr.as_str()), (1, ""));
    let report: Value = serde_json::from_str(&told.stdout).expect("JSON");
    let errors: Vec<_> = validator("exam").iter_errors(&report).map(|error| error.to_string()).collect();
    assert!(errors.is_empty(), "{errors:#?}");
    assert_eq!(report["passes"], told.status == Some(0), "{:?}", told.status);
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
fn each_mistake_is_told_first() {
    for (edition, mistake, told) in [
        ("4.0", "silent", "MSG-5   sends AI2VCU_Status (510h)"),
        ("4.0", "never-selects", "RDY-7   confirms the mission that is selected"),
        ("4.0", "floods", "MSG-98  sends 510h to 514h every 10 ms"),
        ("3.0", "answers-late", "HS-5    answers the HANDSHAKE bit of 520h"),
        ("4.0", "answers-late", "HS-5    answers the HANDSHAKE bit of 520h"),
        ("4.0", "sends-a-reserved-identifier", "ID-8    does not send 301h"),
        ("4.0", "brakes-and-drives", "IMP-8   does not drive and brake at once"),
    ] {
        let told_all = examined(&["--edition", edition, "--only", "mission-skidpad"], &[mistake]);
        assert_eq!((told_all.status, told_all.stderr.as_str()), (Some(1), ""), "{mistake}");
        let screen: Vec<&str> = told_all.stdout.lines().take(24).collect();
        assert!(screen[0].starts_with(&format!("edition {edition}")), "{}", screen[0]);
        assert!(screen.iter().any(|line| line.contains(told)), "{mistake}: {screen:#?}");
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
    assert_eq!(list.stdout.lines().count(), 43 + 2);
    assert!(
        list.stdout.contains("\nready                       4 s  a mission is selected"),
        "{}",
        list.stdout
    );
    let some = run(&["exam", "--list", "--only", "go-", "--only", "ready"]);
    let mut scenarios = some.stdout.lines().take_while(|line| !line.is_empty());
    assert!(scenarios.all(|line| line.starts_with("go-") || line.starts_with("ready ")));
    let quick = run(&["exam", "--list", "--quick"]);
    assert!(quick.stdout.ends_with("\n5 scenarios: 1 min 7 s in real time\n"), "{}", quick.stdout);
    let none = run(&["exam", "--stdio", "--only", "nothing", "--", "cat"]);
    assert_eq!((none.status, none.stdout.as_str()), (Some(2), ""));
    assert!(none.stderr.contains("--only nothing: no scenario begins so; expected one of no-mission, "));
}

/// What is asked for on a bus cannot all be asked for at once.
#[test]
fn a_bus_and_what_is_on_it_are_asked_for() {
    for (args, told) in [
        (&["exam", "--", "true"][..], "<INTERFACE>"),
        (&["exam", "vcan0"], "<PROGRAM>..."),
        (&["exam", "vcan0", "--stdio", "--", "true"], "cannot be used with"),
        (&["exam", "--attach"], "<INTERFACE>"),
        (&["exam", "vcan0", "--attach", "--", "true"], "cannot be used with"),
        (&["exam", "vcan0", "--jobs", "2", "--", "true"], "--namespace"),
        (&["exam", "--namespace", "--jobs", "0", "--", "true"], "0 is not in 1..=64"),
        (&["exam", "vcan0", "--quick", "--only", "ready", "--", "true"], "cannot be used with"),
    ] {
        let refused = run(args);
        assert_eq!((refused.status, refused.stdout.as_str()), (Some(2), ""), "{args:?}");
        assert!(refused.stderr.contains(told), "{args:?}: {}", refused.stderr);
    }
}

#[test]
fn an_interface_that_is_not_there_is_reported() {
    let refused = run(&["exam", "adsdv-none", "--only", "ready", "--", "true"]);
    assert_eq!((refused.status, refused.stdout.as_str()), (Some(2), ""));
    assert!(refused.stderr.starts_with("adsdv: adsdv-none: "), "{}", refused.stderr);
    assert!(refused.stderr.contains("\nhint: "), "{}", refused.stderr);
}

#[test]
fn what_passed_is_listed_if_somebody_asks() {
    let told = examined(&["--edition", "4.0", "--only", "mission-skidpad", "--all"], &[]);
    assert!(told.stdout.contains("\n  RDY-7   confirms the mission that is selected\n"), "{}", told.stdout);
    assert_eq!(told.status, Some(0));
}

/// The examples that teams begin with.
#[test]
fn the_examples_pass() {
    let python = Command::new("python3").arg("--version").output().is_ok_and(|told| told.status.success());
    if python {
        let told = run(&["exam", "--stdio", "--edition", "4.0", "--", "python3", "exam/examples/stack.py"]);
        assert_eq!(told.status, Some(0), "{}{}", told.stdout, told.stderr);
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
        let told = run(&["exam", "--stdio", "--edition", "2026", "--", program]);
        assert_eq!(told.status, Some(0), "{}{}", told.stdout, told.stderr);
    }
}
