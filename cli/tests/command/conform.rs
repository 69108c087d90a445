//! `adsdv conform`: what it tells of programs, for people and for programs, and how it ends with those that misbehave.

use std::time::{Duration, Instant};

use serde_json::{Value, json};

use crate::golden::compare_text;
use crate::run::{Outcome, adsdv, example, outcome, run, temporary};
use crate::schema::validator;

/// Judges an example: options of the command, the name of the example, and arguments of that.
pub(crate) fn conform(options: &[&str], program: &str, args: &[&str]) -> Outcome {
    let program = example(program);
    run(&[&["conform"], options, &["--", program.as_str()], args].concat())
}

/// What is printed for an example, with its name instead of its path.
pub(crate) fn text(options: &[&str], program: &str, args: &[&str]) -> (Option<i32>, String) {
    let outcome = conform(options, program, args);
    assert_eq!(outcome.stderr, "", "{}", outcome.stdout);
    (outcome.status, outcome.stdout.replace(&example(program), program))
}

/// The JSON for an example, which has to keep to its schema and to say what the exit status does.
pub(crate) fn report(options: &[&str], program: &str, args: &[&str]) -> Value {
    let outcome = conform(&[options, &["--json"]].concat(), program, args);
    assert_eq!((outcome.stdout.lines().count(), outcome.stderr.as_str()), (1, ""));
    let report: Value = serde_json::from_str(&outcome.stdout).expect("JSON");
    let errors: Vec<_> = validator("conform").iter_errors(&report).map(|error| error.to_string()).collect();
    assert!(errors.is_empty(), "{errors:#?}");
    assert_eq!(report["conforms"], outcome.status == Some(0), "{:?}", outcome.status);
    report
}

#[test]
fn the_reference_conforms() {
    let (status, text) = text(&[], "adapter", &[]);
    assert_eq!(status, Some(0), "{text}");
    compare_text("conform-adapter.txt", &text);
}

#[test]
fn a_broken_row_is_reported_with_its_guard_and_a_timeline() {
    let (status, text) = text(&["--runs", "50"], "mutant", &["--mutation", "3.7 term 1: dropped"]);
    assert_eq!(status, Some(1), "{text}");
    compare_text("conform-broken-row.txt", &text);
}

#[test]
fn a_diagnosis_names_each_deviation_before_the_requirements() {
    let (status, text) = text(&["--diagnose", "--runs", "0"], "mutant", &["--mutation", "3.6: dropped"]);
    assert_eq!(status, Some(1));
    let (first, _) = text.split_once("\nREQUIREMENTS").expect("it comes first");
    let (_, found) = first.split_once("\nDEVIATIONS\n").expect("there is a diagnosis");
    assert_eq!(found.lines().next(), Some("  AS_READY -> AS_OFF is never taken (SM-10, RTO-1)"));
    let json = report(&["--diagnose", "--runs", "0"], "mutant", &["--mutation", "3.6: dropped"]);
    assert_eq!(json["diagnosis"]["deviations"][0]["id"], "ready-off:missing");
    assert_eq!(json["diagnosis"]["unexplained"], 0);
}

#[test]
fn a_diagnosis_of_a_program_that_conforms_names_nothing_whatever_its_readings() {
    let json = report(&["--diagnose", "--runs", "0"], "adapter", &[]);
    assert_eq!(
        (&json["diagnosis"]["deviations"], &json["diagnosis"]["unexplained"]),
        (&json!([]), &json!(0))
    );
    assert_eq!(report(&["--runs", "0"], "adapter", &[])["diagnosis"], Value::Null);
}

#[test]
fn mixed_readings_are_reported() {
    let mixing = ["--reading", "fault-trigger=edge", "--mutation", "3.7 term 3: in every reading"];
    let (status, text) = text(&["--runs", "50", "--no-diagnosis"], "mutant", &mixing);
    assert_eq!(status, Some(1), "{text}");
    compare_text("conform-mixed-readings.txt", &text);
}

#[test]
fn few_outputs_that_are_late_at_a_fixed_cycle() {
    let options = ["--latency", "2", "--cycle-ms", "50", "--runs", "20"];
    let (status, text) =
        text(&options, "mutant", &["--latency", "1", "--only", "as_state,go_signal", "--no-eof"]);
    assert_eq!(status, Some(0), "{text}");
    compare_text("conform-late.txt", &text);
}

#[test]
fn json_keeps_to_its_schema_and_agrees_with_the_text() {
    let good = report(&[], "adapter", &[]);
    assert_eq!(
        (&good["failures"], &good["latency"], &good["cycle_ms"]),
        (&json!([]), &json!(0), &Value::Null)
    );
    assert_eq!(good["readings"]["go-edge"], "seen-low");
    assert!(
        good["follows"]
            .as_array()
            .expect("an array")
            .iter()
            .all(|one| one["possible"].as_array().map(Vec::len) == Some(1))
    );

    let bad = report(&["--seed", "3", "--runs", "10"], "mutant", &["--mutation", "3.6: dropped"]);
    assert_eq!((&bad["seed"], &bad["runs"]), (&json!(3), &json!(10)));
    let failure = &bad["failures"][0];
    assert_eq!(
        failure["row"],
        json!({ "from": "AS_READY", "to": "AS_OFF", "section": "3.6", "guard": ["AS master switch OFF"] })
    );
    assert_eq!(
        failure["differences"][0],
        json!({ "key": "as_state", "found": "AS_READY", "expected": "AS_OFF" })
    );
    let steps = failure["steps"].as_array().expect("an array");
    assert_eq!(
        (steps.len(), &steps[0]["inputs"]["asms"], &steps[1]["inputs"]["asms"]),
        (2, &json!(true), &Value::Null)
    );
    assert_eq!(
        (&steps[1]["expected"]["as_state"], &steps[1]["actual"]["as_state"]),
        (&json!("AS_OFF"), &json!("AS_READY"))
    );
    let failed = |one: &&Value| one["outcome"] == "fail";
    let failed: Vec<_> = bad["requirements"].as_array().expect("an array").iter().filter(failed).collect();
    assert!(failed.iter().any(|one| one["id"] == "RTO-1" && one["failed"][0] == "3.6"), "{failed:?}");

    let mixing = ["--reading", "ai-estop=driving", "--mutation", "3.5 term 2: in every reading"];
    let mixed = report(&["--runs", "0"], "mutant", &mixing);
    let sides =
        mixed["follows"].as_array().expect("an array").iter().find(|one| one["reading"] == "ai-estop");
    let choices: Vec<_> = sides.expect("it is there")["mixes"]
        .as_array()
        .expect("an array")
        .iter()
        .map(|side| &side["choice"])
        .collect();
    assert_eq!(choices, ["every-state", "driving"]);
    assert_eq!(mixed["failures"][0]["explained_by"], json!(["ai-estop=driving"]));

    // Not the things that are listed as well.
    let tests_only = ["--runs", "10", "--strict", "--no-diagnosis"];
    let scrambled = report(&tests_only, "mutant", &["--scramble"]);
    let failures = scrambled["failures"].as_array().map(Vec::len);
    assert!(failures >= Some(20) && scrambled["more_failures"].as_u64() > Some(0), "{failures:?}");
    assert_eq!((&good["more_failures"], &bad["more_failures"]), (&json!(0), &json!(0)));
    let more = format!("\n\n  and {} more\n\nREQUIREMENTS\n", scrambled["more_failures"]);
    let (_, text) = text(&tests_only, "mutant", &["--scramble"]);
    assert!(text.contains(&more), "{more}{text}");

    let unsteady = report(&["--runs", "0"], "mutant", &["--lie-at", "2"]);
    assert_eq!(
        (&unsteady["failures"][0]["why"], &unsteady["failures"][0]["row"]),
        (&Value::Null, &Value::Null)
    );
}

#[test]
fn the_schema_refuses_what_is_not_an_answer() {
    let good = report(&["--runs", "0"], "mutant", &["--mutation", "3.6: dropped"]);
    let validator = validator("conform");
    for (place, bad) in [
        ("/conforms", Value::Null),
        ("/program", json!([])),
        ("/steps", json!(-1)),
        ("/latency", Value::Null),
        ("/requirements/0/outcome", json!("perhaps")),
        ("/requirements/0/checked", json!("all")),
        ("/more_failures", Value::Null),
        ("/about_the_vcu", json!(-1)),
        ("/failures/0/row/from", json!("AS_PARKED")),
        ("/failures/0/steps/0/expected/as_state", json!([])),
        ("/follows/0/possible", json!("both")),
    ] {
        let mut spoiled = good.clone();
        *spoiled.pointer_mut(place).unwrap_or_else(|| panic!("{place} is there")) = bad;
        assert!(!validator.is_valid(&spoiled), "{place}");
    }
}

/// A suite that was written under a pin expects what that reading shows, and is read under the same pin.
#[test]
fn a_suite_is_read_under_the_pins_it_was_written_under() {
    let pin = ["--reading", "go-signal=raw"];
    let file = temporary("raw.jsonl", run(&["suite", pin[0], pin[1]]).stdout.as_bytes());
    let file = file.to_str().expect("text");
    let pinned = conform(&["--suite", file, "--runs", "0", pin[0], pin[1]], "mutant", &pin);
    assert_eq!(pinned.status, Some(0), "{}", pinned.stderr);
    let unpinned = conform(&["--suite", file, "--runs", "0"], "mutant", &pin);
    assert!(unpinned.status == Some(2) && unpinned.stderr.contains("go_signal"), "{}", unpinned.stderr);
}

#[test]
fn a_suite_is_read_from_a_file() {
    let lines: Vec<String> = run(&["suite"]).stdout.lines().map(str::to_owned).collect();
    let few = lines[..3].join("\n");
    let file = temporary("few.jsonl", few.as_bytes());
    let file = file.to_str().expect("a path of text");
    let report = report(&["--suite", file, "--runs", "0"], "adapter", &[]);
    assert_eq!((&report["tests"], &report["conforms"]), (&json!(3), &json!(true)));

    let bad = temporary("bad.jsonl", format!("{few}\n{{\"name\":3}}\nhello\n").as_bytes());
    let refused = conform(&["--suite", bad.to_str().expect("text")], "adapter", &[]);
    assert_eq!((refused.status, refused.stdout.as_str()), (Some(2), ""));
    for said in ["bad.jsonl: 2 lines that are no tests", "line 4", "line 5", "hint: correct these lines"] {
        assert!(refused.stderr.contains(said), "{said:?} is missing: {}", refused.stderr);
    }
    let empty = temporary("empty.jsonl", b"\n");
    let refused = conform(&["--suite", empty.to_str().expect("text")], "adapter", &[]);
    assert!(refused.status == Some(2) && refused.stderr.contains("the suite is empty"), "{}", refused.stderr);
    let refused = conform(&["--suite", "no-such.jsonl"], "adapter", &[]);
    assert!(
        refused.stderr.starts_with("adsdv: no-such.jsonl: cannot open the suite: "),
        "{}",
        refused.stderr
    );
    let refused = conform(&["--suite", "tests"], "adapter", &[]);
    assert!(
        refused.stderr.starts_with("adsdv: tests: is a directory; expected a suite\n"),
        "{}",
        refused.stderr
    );
}

/// A verdict about nothing is none.
#[test]
fn a_suite_of_which_nothing_can_be_run_is_no_verdict() {
    let lines = run(&["suite"]).stdout;
    let needs = |line: &&str| line.contains("crash_sensor");
    let test = lines.lines().find(needs).expect("a test of it");
    let file = temporary("crash.jsonl", test.as_bytes());
    let file = file.to_str().expect("a path of text");
    let about = r#"{"inputs":["asms","tsms"]}"#;
    for json in [&[][..], &["--json"]] {
        let options = [&["--suite", file, "--runs", "0"], json].concat();
        let refused = conform(&options, "deviating", &["--about", about]);
        assert_eq!((refused.status, refused.stdout.as_str()), (Some(2), ""));
        for part in
            ["no test of the suite was run, for they need an input that it does not have: ", "\nhint: "]
        {
            assert!(refused.stderr.contains(part), "{part:?} is missing: {}", refused.stderr);
        }
    }
}

/// Ctrl-C, and what else ends the command, ends the program under test as well.
#[cfg(unix)]
#[test]
fn a_command_that_is_stopped_leaves_no_program_behind() {
    use std::os::unix::process::ExitStatusExt as _;
    use std::process::{Command, Stdio};

    let signal = |name: &str, pid: &str| {
        let sent = Command::new("kill").args(["-s", name, pid]).stderr(Stdio::null()).status();
        sent.is_ok_and(|status| status.success())
    };
    for (name, number) in [("INT", 2), ("TERM", 15), ("HUP", 1)] {
        let file = temporary(&format!("stopped-by-{name}.pid"), b"");
        let args = ["--pid", file.to_str().expect("text"), "--hang-at", "1"];
        let program = example("mutant");
        let command = [&["conform", "--timeout", "60", "--", program.as_str()], &args[..]].concat();
        let mut command =
            adsdv(&command).stdout(Stdio::null()).stderr(Stdio::null()).spawn().expect("it starts");
        let start = Instant::now();
        let pid = loop {
            let pid = std::fs::read_to_string(&file).expect("the file is there");
            if !pid.is_empty() {
                break pid;
            }
            assert!(start.elapsed() < Duration::from_secs(30), "the program starts");
            std::thread::sleep(Duration::from_millis(5));
        };
        assert!(signal("0", &pid), "it runs");
        assert!(signal(name, &command.id().to_string()));
        assert_eq!(command.wait().expect("it ends").signal(), Some(number));
        while signal("0", &pid) {
            assert!(start.elapsed() < Duration::from_secs(40), "{name}: the program is left behind");
            std::thread::sleep(Duration::from_millis(5));
        }
    }
}

/// What was not run, or showed nothing, is not counted as if it had been.
#[test]
fn a_requirement_is_printed_with_how_many_of_its_tests_checked_it() {
    let options = ["--cycle-ms", "50", "--runs", "0"];
    let report = report(&options, "adapter", &[]);
    let partly: Vec<_> = report["requirements"]
        .as_array()
        .expect("an array")
        .iter()
        .filter(|one| one["checked"] != one["tests"])
        .collect();
    assert!(!partly.is_empty() && partly.iter().all(|one| one["failed"] == json!([])), "{partly:?}");
    let (_, text) = text(&[&options[..], &["--all"]].concat(), "adapter", &[]);
    for one in partly {
        let count = format!("{} of {}\n", one["checked"], one["tests"]);
        let id = format!("\n  {} ", one["id"].as_str().expect("text"));
        let line = text.split_once(&id).and_then(|(_, rest)| rest.split_inclusive('\n').next());
        assert!(line.is_some_and(|line| line.ends_with(&count)), "{id} {count} {line:?}");
    }
}

/// A program that answers each line in time, and all of them too slowly.
#[test]
fn a_program_that_is_slow_is_no_verdict() {
    let start = Instant::now();
    let outcome = conform(&["--timeout", "20", "--time-limit", "1"], "mutant", &["--slow", "150"]);
    assert_eq!((outcome.status, outcome.stdout.as_str()), (Some(2), ""));
    for said in
        ["not done within the time limit of 1 s: ", "and 0 of 300 random", "\nhint: raise --time-limit"]
    {
        assert!(outcome.stderr.contains(said), "{said:?} is missing: {}", outcome.stderr);
    }
    assert!(start.elapsed() < Duration::from_secs(20), "{:?}", start.elapsed());
}

#[test]
fn a_program_that_misbehaves_is_no_verdict() {
    for (args, error, hint) in [
        (&["--exit-at", "2"][..], "the program ended early (exit status 3)", "until the end of its input"),
        (&["--hang-at", "2"], "no answer within 2 s", "--timeout"),
        (&["--no-read"], "no answer within 2 s", "--timeout"),
        (&["--garbage-at", "2"], "not the answer to a step: \"engine started\"", "conform/PROTOCOL.md"),
        (&["--chatty-at", "2"], "not the answer to a reset: outputs", "answered twice"),
        (&["--long-at", "2"], "a line of more than 65536 bytes", "line break"),
    ] {
        let start = Instant::now();
        let outcome = conform(&["--timeout", "2"], "mutant", args);
        assert_eq!((outcome.status, outcome.stdout.as_str()), (Some(2), ""), "{args:?}");
        let first = outcome.stderr.lines().next().unwrap_or_default();
        assert!(first.starts_with("adsdv: ") && first.contains(error), "{first}");
        assert!(
            ["3.1", "the beginning"]
                .iter()
                .any(|place| outcome.stderr.contains(&format!("\n  in        {place}")))
                && outcome.stderr.contains("\n  sent      {\"op\":"),
            "{}",
            outcome.stderr
        );
        let last = outcome.stderr.lines().last().unwrap_or_default();
        assert!(last.starts_with("hint: ") && last.contains(hint), "{last}");
        assert!(start.elapsed() < Duration::from_secs(20), "{args:?}");
    }
    let missing = run(&["conform", "--", "no/such/vcu"]);
    assert_eq!((missing.status, missing.stdout.as_str()), (Some(2), ""));
    assert!(
        missing.stderr.starts_with("adsdv: no/such/vcu: cannot start the program: "),
        "{}",
        missing.stderr
    );
    assert!(missing.stderr.contains("\nhint: check the path"), "{}", missing.stderr);
}

#[test]
fn arguments_that_are_none() {
    for (args, error) in [
        (&["conform"][..], "-- <PROGRAM>"),
        (&["conform", "--latency", "51", "--", "vcu"], "expected a number of steps from 0 to 50"),
        (&["conform", "--latency", "-1", "--", "vcu"], "expected a number of steps from 0 to 50"),
        (
            &["conform", "--cycle-ms", "0", "--", "vcu"],
            "expected a whole number of milliseconds from 1 to 1000",
        ),
        (&["conform", "--timeout", "0", "--", "vcu"], "expected a number of seconds above 0, at most 3600"),
        (&["conform", "--timeout", "NaN", "--", "vcu"], "expected a number of seconds above 0, at most 3600"),
        (
            &["conform", "--time-limit", "-1", "--", "vcu"],
            "expected a number of seconds above 0, at most 604800",
        ),
        (&["conform", "--seed", "-1", "--", "vcu"], "--seed <N>"),
        (&["conform", "--runs", "many", "--", "vcu"], "--runs <N>"),
        (&["conform", "--reading", "go-edge=no", "--", "vcu"], "expected one of seen-low, edge"),
        (&["conform", "vcu"], "unexpected argument 'vcu'"),
    ] {
        let refused = run(args);
        assert_eq!((refused.status, refused.stdout.as_str()), (Some(2), ""), "{args:?}");
        assert!(refused.stderr.contains(error), "{args:?}: {}", refused.stderr);
    }
    let twice = run(&["conform", "--reading", "go-edge=edge", "--reading", "go-edge=seen-low", "--", "vcu"]);
    assert!(twice.status == Some(2) && twice.stderr.contains("already pinned"), "{}", twice.stderr);
}

#[test]
fn a_pin_decides() {
    let edge = ["--reading", "go-edge=edge"];
    let pinned = |pin: &str| conform(&["--runs", "0", "--no-diagnosis", "--reading", pin], "mutant", &edge);
    let (right, wrong) = (pinned("go-edge=edge"), pinned("go-edge=seen-low"));
    assert_eq!((right.status, wrong.status), (Some(0), Some(1)), "{}", wrong.stdout);
    assert!(right.stdout.contains("\nreading go-edge=edge: a rising edge is enough\n"), "{}", right.stdout);
}

#[test]
fn colors_change_no_word() {
    let program = example("mutant");
    let args = ["conform", "--runs", "20", "--", &program, "--mutation", "3.6: dropped"];
    let plain = run(&args);
    let colored = outcome(
        adsdv(&[
            "conform",
            "--color",
            "always",
            "--runs",
            "20",
            "--",
            &program,
            "--mutation",
            "3.6: dropped",
        ])
        .env("NO_COLOR", "1"),
    );
    assert!(colored.stdout.contains("\x1b[1m\x1b[31mdoes not conform\x1b[0m"), "{}", colored.stdout);
    let mut parts = colored.stdout.split('\x1b');
    let first = parts.next().expect("text").to_owned();
    let words = parts.fold(first, |all, part| all + part.split_once('m').expect("an end").1);
    assert_eq!(words, plain.stdout);
}
