//! `adsdv demo`: runs, writes and judges; and every way to get no verdict.

use std::fs::{self, File};
use std::io::Write as _;
use std::path::PathBuf;
use std::process::Stdio;

use crate::run::{Outcome, adsdv, file, outcome, run, temporary, workspace};

/// Where a test may write. The name has to be the test's own.
fn place(name: &str) -> PathBuf {
    let path = temporary(name, b"");
    fs::remove_file(&path).expect("it was just made");
    path
}

fn text(path: &std::path::Path) -> &str {
    path.to_str().expect("a path of text")
}

fn refused(outcome: &Outcome, error: &str, hint: &str) {
    assert_eq!((outcome.status, outcome.stdout.as_str()), (Some(2), ""), "{}", outcome.stderr);
    assert!(outcome.stderr.starts_with("adsdv: ") && outcome.stderr.contains(error), "{}", outcome.stderr);
    let last = outcome.stderr.lines().last().unwrap_or_default();
    assert!(last.starts_with("hint: ") && last.contains(hint), "{}", outcome.stderr);
}

/// What is printed, however its lines are broken.
fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[test]
fn a_whole_mission_conforms() {
    let demo = run(&["demo"]);
    assert_eq!((demo.status, demo.stderr.as_str()), (Some(0), ""), "{}", demo.stdout);
    let transitions: Vec<Vec<&str>> = demo
        .stdout
        .lines()
        .filter(|line| line.contains(" -> ") && line.contains(" s  "))
        .map(|line| line.split_whitespace().skip(2).collect())
        .collect();
    assert_eq!(
        transitions,
        [
            ["AS_OFF", "->", "AS_READY", "3.1", "justified"],
            ["AS_READY", "->", "AS_DRIVING", "3.2", "justified"],
            ["AS_DRIVING", "->", "AS_FINISHED", "3.3", "justified"],
            ["AS_FINISHED", "->", "AS_OFF", "3.4", "justified"],
        ],
        "{}",
        demo.stdout
    );
    for part in [
        "on a bus within this program",
        "\nOPERATOR\n     0.000 s  ebs ARMED, ami AUTONOMOUS_DEMO\n",
        "\nTIMELINE\n",
    ] {
        assert!(demo.stdout.contains(part), "{part:?} is missing: {}", demo.stdout);
    }
    let last = demo.stdout.lines().last();
    assert_eq!(last, Some("demo: conforms (0 violations, 0 warnings, 0 notes)"));
    for line in demo.stdout.lines() {
        assert!(line.chars().count() <= 100, "{line}");
    }
}

#[test]
fn check_agrees_about_the_log() {
    for scenario in ["mission", "go-lost", "go-too-early", "remote-estop", "power-cycle"] {
        let log = place(&format!("demo-{scenario}.log"));
        let scenario = format!("can/scenarios/{scenario}.txt");
        let options = ["--scenario", &scenario, "--log", text(&log)];
        let demo = run(&[&["demo"], &options[..]].concat());
        assert_eq!((demo.status, demo.stderr.as_str()), (Some(0), ""), "{}", demo.stdout);
        let check = run(&["check", "--edition", "3.0", text(&log)]);
        // The demo has said the edition before it tells what was done.
        let (edition, report) = check.stdout.split_once('\n').expect("more than one line");
        assert!(
            report.len() > 200 && demo.stdout.starts_with(edition) && demo.stdout.ends_with(report),
            "{}\n{}",
            demo.stdout,
            check.stdout
        );
        let demo = run(&[&["demo", "--json"], &options[..]].concat());
        let check = run(&["check", "--edition", "3.0", "--json", text(&log)]);
        assert_eq!((demo.status, demo.stdout), (check.status, check.stdout));
    }
}

#[test]
fn a_log_that_was_there_is_replaced() {
    let log = temporary("demo-replaced.log", &vec![b'x'; 8_000_000]);
    assert_eq!(run(&["demo", "--log", text(&log)]).status, Some(0));
    let written = fs::read(&log).expect("it was written");
    assert!(written.starts_with(b"(0000000000.000270) demo 500#") && written.ends_with(b"\n"));
    assert!(!written.contains(&b'x') && written.len() > 100_000);
}

#[test]
fn the_same_demo_is_the_same_text() {
    assert_eq!(run(&["demo"]).stdout, run(&["demo"]).stdout);
}

#[test]
fn a_scenario_from_standard_input() {
    let mut command = adsdv(&["demo", "--scenario", "-"]);
    let mut child = command.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().expect("the command starts");
    let scenario = b"0 ebs ARMED, ami SKIDPAD, tsms on, asms on\nAS_READY +1 end\n";
    child.stdin.take().expect("a pipe").write_all(scenario).expect("it reads");
    let output = child.wait_with_output().expect("the command ends");
    let text = String::from_utf8(output.stdout).expect("text");
    assert_eq!(output.status.code(), Some(0), "{text}");
    assert!(
        text.contains("-> AS_READY") && one_line(&text).contains("the scenario on standard input, "),
        "{text}"
    );
}

#[test]
fn every_mistake_of_a_scenario_is_reported() {
    let bad = temporary("demo-bad.txt", b"0 asms up\n\n1 horn\nAS_READY +1 end\n");
    let log = place("demo-bad.log");
    let outcome = run(&["demo", "--scenario", text(&bad), "--log", text(&log)]);
    refused(&outcome, "demo-bad.txt: is no scenario\n", "adsdv demo --help");
    let lines: Vec<&str> = outcome.stderr.lines().collect();
    assert_eq!(lines[1], "line 1, column 8: found \"up\", expected asms to be off or on");
    assert!(
        lines[2].starts_with("line 3, column 3: found \"horn\", expected end, power cycle, or one of asms, ")
    );
    assert_eq!(lines.len(), 4, "{lines:?}");
    assert!(!log.exists(), "nothing was done");
}

#[test]
fn a_scenario_that_cannot_be_read() {
    refused(
        &run(&["demo", "--scenario", "no-such.txt"]),
        "no-such.txt: cannot open the scenario: ",
        "these come with adsdv: mission, go-too-early, ",
    );
    refused(
        &run(&["demo", "--scenario", "can"]),
        "can: is a directory; expected a scenario",
        "adsdv demo --help",
    );
    refused(
        &run(&["demo", "--scenario", "/dev/null"]),
        "line 1, column 1: found nothing, expected a line such as",
        "adsdv demo --help",
    );
    let folder = File::open(workspace()).expect("the workspace");
    let given = outcome(adsdv(&["demo", "--scenario", "-"]).stdin(folder));
    refused(&given, "standard input: is a directory; expected a scenario", "adsdv demo --help");
    #[cfg(target_os = "linux")]
    refused(
        &run(&["demo", "--scenario", "/dev/zero"]),
        "/dev/zero: is longer than 4194304 bytes; expected a scenario",
        "adsdv demo --help",
    );
}

#[test]
fn a_scenario_that_waits_for_ever_is_reported_with_its_line() {
    let waits = temporary("demo-waits.txt", b"0 asms on, tsms on, ami SKIDPAD\nAS_READY +1 end\n");
    let log = place("demo-waits.log");
    let outcome = run(&["demo", "--scenario", text(&waits), "--log", text(&log)]);
    let expected = "demo-waits.txt: line 2: expected AS_READY, found AS_OFF after 600 s; AS_READY (section 3.1) still needs: \
                    EBS_state == ARMED\n\nOPERATOR until then\n     0.000 s  asms on, tsms on, ami SKIDPAD\n\n";
    refused(&outcome, expected, "in a line before that one");
    // What happened until then is in the log.
    let written = fs::read(&log).expect("the log");
    assert!(written.len() > 1_000_000 && written.ends_with(b"\n"));
    let frames = written.split(|&byte| byte == b'\n').count() - 1;
    let hint = format!("demo-waits.log has the run until then: 600.000 s, {frames} frames\n");
    assert!(outcome.stderr.contains(&hint), "{hint}{}", outcome.stderr);
    fs::remove_file(&log).expect("it is ours");
    // Nothing was done, and no log was asked for.
    let waits = temporary("demo-waits-idly.txt", b"AS_READY end\n");
    let outcome = run(&["demo", "--scenario", text(&waits)]);
    refused(&outcome, "\nOPERATOR until then\n  nothing\n", "in a line before that one");
    assert!(!outcome.stderr.contains("has the run"), "{}", outcome.stderr);
}

#[test]
fn a_scenario_that_does_nothing_is_reported() {
    let idle = temporary("demo-idle.txt", b"1 end\n");
    let demo = run(&["demo", "--scenario", text(&idle)]);
    assert_eq!(demo.status, Some(0), "{}", demo.stderr);
    assert!(demo.stdout.contains("\nOPERATOR\n  nothing\n\n"), "{}", demo.stdout);
}

#[test]
fn the_scenarios_that_come_with_it_have_names() {
    for name in ["mission", "go-lost", "go-too-early", "remote-estop", "power-cycle"] {
        let file = run(&["demo", "--json", "--scenario", &format!("can/scenarios/{name}.txt")]);
        let named = run(&["demo", "--json", "--scenario", name]);
        assert_eq!((named.status, named.stderr.as_str()), (Some(0), ""));
        assert_eq!(named.stdout, file.stdout, "{name}");
    }
    let demo = run(&["demo", "--scenario", "go-lost"]);
    assert!(
        one_line(&demo.stdout).contains("within this program: the built-in scenario go-lost, "),
        "{}",
        demo.stdout
    );
    refused(&run(&["demo", "--scenario", "./go-lost"]), "./go-lost: cannot open the scenario", "go-lost");
}

/// The help is all that somebody has who installed the program: every file that it names is one that it has made before.
#[test]
fn the_help_is_enough_to_write_a_scenario() {
    let help = run(&["demo", "--help"]).stdout;
    assert!(!help.contains("can/"), "there is no such folder: {help}");
    for part in
        ["asms off|on", "TRACK_DRIVE", "AS_READY +5.5 ", "after 600 s", "stops 1 s after the last line"]
    {
        assert!(one_line(&help).contains(part.trim()), "{part:?}: {help}");
    }
    let (_, example) = help.split_once("printf '").expect("an example");
    let (scenario, _) = example.split_once('\'').expect("its end");
    let own = temporary("demo-help.txt", scenario.replace("\\n", "\n").as_bytes());
    let demo = run(&["demo", "--scenario", text(&own)]);
    assert_eq!((demo.status, demo.stderr.as_str()), (Some(0), ""));
    let timeline = demo.stdout.split("\nMARGINS\n").next().unwrap_or_default();
    assert!(
        one_line(timeline).contains(" 3.1 justified ") && !timeline.contains("not certain"),
        "{}",
        demo.stdout
    );
    for option in ["--scenario remote-estop", "--log demo.log"] {
        assert!(help.contains(&format!("adsdv demo {option}\n")), "{option}: {help}");
    }
}

#[test]
fn a_screen_writes_no_log() {
    let log = place("demo-screen.log");
    for option in [&["--log", text(&log)][..], &["--json"]] {
        let outcome = run(&[&["demo", "--screen"], option].concat());
        assert_eq!((outcome.status, outcome.stdout.as_str()), (Some(2), ""), "{}", outcome.stderr);
        assert!(outcome.stderr.contains("cannot be used with"), "{}", outcome.stderr);
    }
    assert!(!log.exists());
    // Here is no terminal.
    refused(&run(&["demo", "--screen"]), "the screen needs a terminal", "run it in a terminal");
}

#[test]
fn a_log_that_cannot_be_written() {
    refused(&run(&["demo", "--log", "tests"]), "tests: cannot write the log: ", "name a file in it");
    refused(
        &run(&["demo", "--log", "no-such/demo.log"]),
        "no-such/demo.log: cannot write the log: ",
        "make the directory",
    );
    refused(&run(&["demo", "--log", "-"]), "--log -: the report goes to standard output", "./-");
    #[cfg(target_os = "linux")]
    refused(&run(&["demo", "--log", "/dev/full"]), "/dev/full: cannot write the log: ", "free some space");
}

#[test]
fn the_scenario_is_not_replaced_by_the_log() {
    let scenario = temporary("demo-same.txt", &file("can/scenarios/mission.txt"));
    let log = scenario.parent().expect("a folder").join(".").join("demo-same.txt");
    let outcome = run(&["demo", "--scenario", text(&scenario), "--log", text(&log)]);
    refused(&outcome, "is the scenario, which the log would replace", "name another file");
    assert_eq!(fs::read(&scenario).expect("it is there"), file("can/scenarios/mission.txt"));
}

#[cfg(target_os = "linux")]
#[test]
fn a_report_that_cannot_be_written() {
    for option in ["--color=auto", "--json"] {
        let full = fs::OpenOptions::new().write(true).open("/dev/full").expect("Linux has it");
        let outcome = outcome(adsdv(&["demo", option]).stdout(full));
        refused(&outcome, "standard output: cannot write the answer: ", "free some space");
    }
}
