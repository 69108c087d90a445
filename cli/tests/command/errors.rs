//! Every way to get no verdict: exit status 2, nothing on standard output, and a text that helps.

use std::fs::{self, File, OpenOptions};

use crate::run::{MISSION, Outcome, adsdv, check_input, outcome, run, temporary, workspace};

/// The error names what was given and why it will not do, and a hint says what to do.
fn refused(outcome: &Outcome, error: &str, hint: &str) {
    assert_eq!((outcome.status, outcome.stdout.as_str()), (Some(2), ""), "{}", outcome.stderr);
    let mut lines = outcome.stderr.lines();
    let first = lines.next().unwrap_or_default();
    assert!(first.starts_with("adsdv: ") && first.contains(error), "{first}");
    let second = lines.next().unwrap_or_default();
    assert!(second.starts_with("hint: ") && second.contains(hint), "{second}");
    assert_eq!(lines.next(), None);
}

/// clap says which argument is wrong and what would be right.
fn wrong_arguments(args: &[&str], error: &str) {
    let outcome = run(args);
    assert_eq!((outcome.status, outcome.stdout.as_str()), (Some(2), ""), "{}", outcome.stderr);
    assert!(outcome.stderr.contains(error), "{}", outcome.stderr);
}

/// clap says which argument is wrong, and a hint what was meant.
fn meant(args: &[&str], error: &str, hint: &str) {
    let outcome = run(args);
    assert_eq!((outcome.status, outcome.stdout.as_str()), (Some(2), ""), "{}", outcome.stderr);
    assert!(outcome.stderr.contains(error) && !outcome.stderr.contains("--version"), "{}", outcome.stderr);
    let last = outcome.stderr.lines().last().unwrap_or_default();
    assert!(last.starts_with("hint: ") && last.contains(hint), "{}", outcome.stderr);
}

#[test]
fn a_recording_without_a_command_is_told_which_one_judges_it() {
    meant(&[MISSION], "unrecognized subcommand", &format!("adsdv check {MISSION}"));
    let nothing = run(&["no-such-command"]);
    assert!(!nothing.stderr.contains("hint:"), "{}", nothing.stderr);
}

#[test]
fn an_option_before_the_command_is_told_where_it_stands() {
    for option in ["--edition", "--edition=4.0", "--json"] {
        meant(&[option, "check", MISSION], "unexpected argument", "behind the command");
    }
}

#[test]
fn a_page_without_a_recording_is_told_how_both_are_named() {
    meant(&["check", "--html", MISSION], "<LOG>...", "adsdv check --html run.html run.log");
}

#[test]
fn a_program_that_is_not_behind_two_hyphens_is_told_where_it_stands() {
    meant(&["conform", "python3", "vcu.py"], "'python3'", "adsdv conform -- python3 vcu.py");
    meant(&["conform"], "<PROGRAM>...", "adsdv conform -- ");
    meant(&["exam", "--stdio", "./my_stack"], "'--stdio'", "adsdv exam --stdio -- ./my_stack");
    meant(&["exam", "--stdio"], "<PROGRAM>...", "behind --");
    meant(&["exam", "--", "./my_stack"], "<INTERFACE>", "--namespace");
}

#[cfg(target_os = "linux")]
#[test]
fn a_recording_in_the_place_of_an_interface_is_told_which_command_judges_it() {
    let watched = run(&["watch", MISSION]);
    refused(&watched, "is a file; expected a CAN interface", &format!("adsdv check {MISSION}"));
}

#[test]
fn a_missing_file() {
    refused(&run(&["check", "no-such.log"]), "no-such.log: cannot open the log: ", "check the path");
}

#[test]
fn a_directory() {
    refused(&run(&["check", "docs"]), "docs: has no log; ", "with recordings in it");
    let folder = File::open(workspace()).expect("the workspace");
    let given = outcome(adsdv(&["check", "-"]).stdin(folder));
    refused(&given, "standard input: is a directory; expected a log", "one of the files");
}

#[test]
fn an_empty_log() {
    let log = temporary("empty.log", b"");
    let log = log.to_str().expect("a path of text");
    refused(&run(&["check", log]), "empty.log: the log is empty; expected", "candump -L");
    refused(&check_input(&[], b""), "standard input: the log is empty; expected", "candump -L");
}

#[test]
fn a_file_that_is_no_log() {
    let mut binary: Vec<u8> = (0..=u8::MAX).cycle().take(100_000).collect();
    binary.push(b'\n');
    let log = temporary("binary.log", &binary);
    let log = log.to_str().expect("a path of text");
    let outcome = run(&["check", log]);
    refused(&outcome, "binary.log: no readable frame in ", "candump -L");
    assert!(outcome.stderr.contains("line 1, column 1: found "), "{}", outcome.stderr);
    assert!(outcome.stderr.chars().all(|c| c == '\n' || !c.is_control()), "{}", outcome.stderr);
}

#[cfg(unix)]
#[test]
fn a_file_that_may_not_be_read() {
    use std::os::unix::fs::PermissionsExt as _;

    let log = temporary("forbidden.log", b"");
    fs::set_permissions(&log, fs::Permissions::from_mode(0o000)).expect("it is ours");
    if File::open(&log).is_ok() {
        return; // The superuser may read everything.
    }
    let log = log.to_str().expect("a path of text");
    refused(&run(&["check", log]), "forbidden.log: cannot open the log: ", "permissions");
}

#[test]
fn an_interface_that_the_log_does_not_have() {
    let outcome = run(&["check", "--interface", "can7", MISSION]);
    refused(&outcome, "on interface can7; the log has vcan0", "--interface");
    wrong_arguments(&["check", "--interface", "", MISSION], "--interface <NAME>");
}

#[cfg(target_os = "linux")]
#[test]
fn an_output_that_cannot_be_written() {
    for args in [
        &["check", MISSION][..],
        &["check", "--json", MISSION],
        &["dbc"],
        &["export", "--format", "promela"],
        &["schema"],
        &["--help"],
    ] {
        let full = OpenOptions::new().write(true).open("/dev/full").expect("Linux has it");
        let mut command = adsdv(args);
        refused(
            &outcome(command.stdout(full)),
            "standard output: cannot write the answer: ",
            "free some space",
        );
    }
}

#[cfg(target_os = "linux")]
#[test]
fn an_error_that_cannot_be_written_keeps_its_status() {
    for args in [&["check", "no-such.log"][..], &["--no-such-option"]] {
        let full = OpenOptions::new().write(true).open("/dev/full").expect("Linux has it");
        assert_eq!(outcome(adsdv(args).stderr(full)).status, Some(2), "{args:?}");
    }
}

#[test]
fn times_that_are_none() {
    for option in ["--window", "--deadline"] {
        for value in ["-3", "ten", "", "1.5", "60001", "99999999999"] {
            let expected = "expected a whole number of milliseconds from 0 to 60000";
            wrong_arguments(&["check", option, value, MISSION], expected);
        }
    }
}

#[test]
fn other_arguments() {
    wrong_arguments(&["check"], "<LOG>");
    wrong_arguments(&["compare", MISSION, MISSION, MISSION], "unexpected argument");
    wrong_arguments(&["chekc", MISSION], "'check'");
    wrong_arguments(&["check", "--jsno", MISSION], "--json");
    wrong_arguments(&["check", "--color", "sometimes", MISSION], "auto, always, never");
    wrong_arguments(&["diagram", "--format", "svg"], "mermaid, dot, markdown");
    wrong_arguments(&["verify", "--vectors", "few"], "every, read");
    wrong_arguments(&["export"], "--format <FORMAT>");
    wrong_arguments(&["export", "--format", "tla"], "promela");
    wrong_arguments(&["schema", "dbc"], "check, logs, watch, conform, exam, suite, prove, ");
    wrong_arguments(&["schema", "check", "verify"], "unexpected argument 'verify'");
}

#[test]
fn readings_of_a_machine_that_are_none() {
    for command in [&["verify"][..], &["explore"], &["export", "--format", "promela"]] {
        let with = |pins: &[&'static str]| {
            let pins = pins.iter().flat_map(|pin| ["--reading", pin]);
            command.iter().copied().chain(pins).collect::<Vec<_>>()
        };
        wrong_arguments(&with(&["no-such=edge"]), "expected one of mission-selected, fault-trigger, ");
        wrong_arguments(&with(&["go-edge=no-such"]), "expected one of seen-low, edge");
        let contradiction = run(&with(&["go-edge=edge", "go-edge=seen-low"]));
        refused(&contradiction, "--reading go-edge=seen-low: go-edge is already pinned to edge", "once");
    }
}

#[test]
fn threads_and_ports_that_are_none() {
    for value in ["0", "257", "two", "", "1.5"] {
        wrong_arguments(&["verify", "--threads", value], "expected a number of threads from 1 to 256");
    }
    for value in ["65536", "any", "", "1.5"] {
        for command in ["explore", "web"] {
            wrong_arguments(&[command, "--port", value], "--port <N>");
        }
    }
}

#[test]
fn all_readings_at_once_leave_no_choice() {
    for option in [&["--reading", "go-edge=edge"][..], &["--vectors", "read"], &["--logs", "."]] {
        let args = [&["verify", "--readings"], option].concat();
        wrong_arguments(&args, &format!("'--readings' cannot be used with '{}", option[0]));
    }
}
