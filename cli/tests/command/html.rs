//! `adsdv check --html`: a page is written beside the report, whole or not at all.

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::run::{FINISHED_WHILE_MOVING, MISSION, check_input, example, file, run};

/// An empty folder for one test.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    // It may be there from an earlier run.
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).expect("the folder for tests can be written");
    folder
}

fn text(path: &Path) -> &str {
    path.to_str().expect("text")
}

/// The object of data in a page.
fn data(page: &str) -> Value {
    let (_, rest) = page.split_once("id=\"data\">").expect("a page with data");
    let (data, _) = rest.split_once("</script>").expect("its end");
    serde_json::from_str(data).expect("JSON")
}

#[test]
fn the_page_has_what_json_has_and_the_report_is_printed_as_always() {
    let page = folder("html-page").join("run.html");
    for (log, status) in [(MISSION, 0), (FINISHED_WHILE_MOVING, 1)] {
        let plain = run(&["check", log]);
        let outcome = run(&["check", "--html", text(&page), log]);
        assert_eq!((outcome.status, outcome.stderr), (Some(status), plain.stderr), "{log}");
        assert_eq!(outcome.stdout, plain.stdout, "{log}");
        let data = data(&fs::read_to_string(&page).expect("a page"));
        let json: Value = serde_json::from_str(&run(&["check", "--json", log]).stdout).expect("JSON");
        assert_eq!((&data["check"], &data["name"]), (&json, &Value::from(log)));
        let frames: u64 = data["chunks"]
            .as_array()
            .into_iter()
            .flatten()
            .filter_map(|chunk| chunk["frames"].as_u64())
            .sum();
        assert_eq!(Some(frames), json["frames"].as_u64());
    }
    assert_eq!(
        fs::read_dir(page.parent().expect("a folder")).expect("it is there").count(),
        1,
        "nothing else is left"
    );
}

#[test]
fn the_page_of_a_recording_is_small() {
    let outcome = run(&["check", "--html", "-", MISSION]);
    assert_eq!((outcome.status, outcome.stderr.as_str()), (Some(0), ""));
    assert!(outcome.stdout.starts_with("<!doctype html>") && outcome.stdout.ends_with("</html>\n"));
    assert!(outcome.stdout.len() < 600_000, "{} bytes", outcome.stdout.len());
}

/// How it was judged stands on it, and a log may come from anywhere.
#[test]
fn a_page_of_what_comes_through_a_pipe_with_options() {
    let args = [
        "--html",
        "-",
        "--edition",
        "3.0",
        "--window",
        "40",
        "--reading",
        "fault-trigger=edge",
        "--require",
        "AS_OFF",
        "--interface",
        "vcan0",
    ];
    let outcome = check_input(&args, &file(MISSION));
    let data = data(&outcome.stdout);
    let settings = data["settings"].as_array().expect("lines");
    assert_eq!(settings[0], "interface vcan0");
    assert_eq!(settings[1], "window 40 ms, deadline 50 ms");
    assert!(
        settings[2].as_str().is_some_and(|line| line.starts_with("reading fault-trigger=edge: ")),
        "{settings:?}"
    );
    assert_eq!(
        (&data["name"], &data["check"]["edition"]),
        (&Value::from("standard input"), &Value::from("3.0"))
    );
    assert_eq!(data["interface"], "vcan0");
}

#[test]
fn what_does_not_go_with_a_page_is_refused_before_the_log_is_read() {
    let refused = |args: &[&str], why: &str| {
        let outcome = run(args);
        assert_eq!((outcome.status, outcome.stdout.as_str()), (Some(2), ""), "{args:?}");
        assert!(
            outcome.stderr.contains(why) && outcome.stderr.contains("\nhint: "),
            "{args:?}: {}",
            outcome.stderr
        );
    };
    refused(
        &["check", "--html", "run.html", MISSION, MISSION],
        "--html: writes the page of one log; expected one log",
    );
    refused(
        &["check", "--html", "run.html", "tests/logs"],
        "--html: writes the page of one log; expected one log",
    );
    refused(&["check", "--html", "-", "--json", MISSION], "expected one of them on standard output");
    refused(&["check", "--html", "tests", "no-such-log"], "tests: cannot write the page: ");
}

/// What each of these prints for a program is on its page, and what is printed is as always.
#[test]
fn the_pages_of_programs_have_what_json_has() {
    let page = folder("html-programs").join("page.html");
    let (vcu, stack) = (example("mutant"), example("ai_mutant"));
    // Where the page goes is the same with a diagnosis and without.
    for (command, short, program) in [
        (
            &["conform", "--runs", "5"][..],
            &["--no-diagnosis"][..],
            &[vcu.as_str(), "--mutation", "3.6: dropped"][..],
        ),
        (&["exam", "--stdio", "--only", "ready"], &[], &[&stack, "never-selects"]),
    ] {
        let with = |options: &[&str]| run(&[command, options, &["--"], program].concat());
        let outcome = with(&["--json", "--html", text(&page)]);
        assert_eq!(outcome.status, Some(1), "{command:?}: {}", outcome.stderr);
        let html = fs::read_to_string(&page).expect("a page");
        let json: Value = serde_json::from_str(&outcome.stdout).expect("JSON");
        assert_eq!(data(&html)["json"], json, "{command:?}");
        assert_eq!(data(&html)["kind"], command[0]);
        let printed = with(&[short, &["--html", "-"]].concat());
        assert_eq!((printed.status, &data(&printed.stdout)["kind"]), (Some(1), &Value::from(command[0])));
        let beside = with(&[short, &["--html", text(&page)]].concat());
        assert!(beside.status == Some(1) && beside.stdout.starts_with("edition 3.0"), "{}", beside.stdout);
        fs::remove_file(&page).expect("it is there");
    }
}

#[test]
fn a_page_of_a_program_that_cannot_be_written_is_told_before_the_program_is_started() {
    let missing = folder("html-nowhere").join("missing/page.html");
    for command in [&["conform"][..], &["exam", "--stdio"], &["verify", "--readings"]] {
        let program: &[&str] = if command[0] == "verify" { &[] } else { &["--", "no-such-program"] };
        let refused = |options: &[&str], why: &str| {
            let outcome = run(&[command, options, program].concat());
            assert_eq!((outcome.status, outcome.stdout.as_str()), (Some(2), ""), "{command:?}");
            assert!(
                outcome.stderr.contains(why) && outcome.stderr.contains("\nhint: "),
                "{command:?}: {}",
                outcome.stderr
            );
        };
        refused(&["--html", "tests"], "tests: cannot write the page: ");
        refused(&["--html", "-", "--json"], "expected one of them on standard output");
        refused(&["--html", text(&missing)], "missing/page.html: cannot write the page: ");
    }
    let outcome = run(&["verify", "--html", "page.html"]);
    assert!(outcome.status == Some(2) && outcome.stderr.contains("--readings"), "{}", outcome.stderr);
}
