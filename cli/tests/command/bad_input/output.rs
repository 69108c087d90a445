//! Readers that leave, and disks that are full: every command, and every file that one writes.

use std::fs::{self, OpenOptions};
use std::io::{BufRead as _, BufReader, Read as _};
use std::os::unix::fs::symlink;
use std::process::{Child, Command, Stdio};
use std::sync::mpsc;
use std::thread;
use std::time::{Duration, Instant};

use super::table::may_end_with;
use super::{Outcome, adsdv, calm, explained, folder_with, lines, refused, reported, run, text};
use crate::run::{FINISHED_WHILE_MOVING, MISSION, check_input, outcome};
use crate::screen::{self, SCREEN, Terminal};

/// Every command that ends by itself and needs no CAN, with what it is asked and the status of its answer.
const COMMANDS: &[(&[&str], i32)] = &[
    (&["check", MISSION], 0),
    (&["check", FINISHED_WHILE_MOVING], 1),
    (&["check", "--json", FINISHED_WHILE_MOVING], 1),
    (&["compare", MISSION, MISSION], 0),
    (&["compare", MISSION, FINISHED_WHILE_MOVING], 1),
    (&["compare", "--json", MISSION, FINISHED_WHILE_MOVING], 1),
    (&["conform", "--runs", "0", "--no-diagnosis", "--", "sh", "-c", DUMB], 1),
    (&["conform", "--runs", "0", "--no-diagnosis", "--json", "--", "sh", "-c", DUMB], 1),
    (&["dbc"], 0),
    (&["decode", "--edition", "4.0", MISSION], 0),
    (&["decode", "--edition", "4.0", "--format", "vcd", MISSION], 0),
    (&["decode", "--edition", "4.0", "--format", "parquet", MISSION], 0),
    (&["exam", "--list"], 0),
    (&["exam", "--stdio", "--only", "mission-acceleration", "--", "sh", "-c", SILENT], 1),
    (&["demo"], 0),
    (&["demo", "--json"], 0),
    (&["diagram", "--format", "dot"], 0),
    (&["export", "--format", "promela"], 0),
    (&["help"], 0),
    (&["completions", "bash"], 0),
    (&["man", "check"], 0),
    (&["readings"], 0),
    (&["diff", "3.0", "4.0"], 0),
    (&["schema", "verify"], 0),
    (&["suite"], 0),
    (&["suite", "--prove"], 0),
    (&["verify", "--model", "open", "--vectors", "read"], 0),
];

/// A VCU that stays in `AS_OFF`: it does not conform.
const DUMB: &str = r#"while read -r line; do case $line in
*reset*) echo '{}' ;; *) echo '{"as_state":"AS_OFF"}' ;; esac; done"#;

/// An AI Computer that sends nothing.
const SILENT: &str = r#"while read -r line; do case $line in
*hello*) echo '{"edition":"3.0"}' ;; *reset*) echo '{}' ;; *) echo '{"frames":[]}' ;; esac; done"#;

/// Those that go on until they are stopped: `explore` and `web` are below, and the others need CAN, so that `can/tests/socket` has them.
const ENDLESS: [&str; 5] = ["ai", "explore", "vcu", "watch", "web"];

/// A new command has to be in a list.
#[test]
pub(super) fn no_command_is_left_out() {
    let help = run(&["--help"]).stdout;
    let (_, commands) = help.split_once("Commands:\n").expect("a list of commands");
    let (commands, _) = commands.split_once("\n\n").expect("its end");
    let named = commands.lines().filter(|line| line.starts_with("  ") && !line.starts_with("   "));
    let named: Vec<_> = named.filter_map(|line| line.split_whitespace().next()).collect();
    assert!(named.len() > 10, "{help}");
    for command in named {
        let listed = ENDLESS.contains(&command) || COMMANDS.iter().any(|(args, _)| args[0] == command);
        assert!(listed, "adsdv {command} is not tried");
    }
}

/// Gone before the first byte: that is no error, and changes no verdict.
#[test]
pub(super) fn a_closed_pipe() {
    for &(args, status) in COMMANDS {
        let mut child =
            adsdv(args).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("the command starts");
        drop(child.stdout.take());
        let output = child.wait_with_output().expect("the command ends");
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert_eq!((output.status.code(), &*stderr), (Some(status), ""), "{args:?}");
    }
}

/// Gone after the first line, as `head -1` is.
#[test]
pub(super) fn a_pipe_that_is_closed_after_a_line() {
    for &(args, status) in COMMANDS {
        let mut child =
            adsdv(args).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("the command starts");
        // Of what is no text, as far as the first byte that would end a line.
        let mut line = Vec::new();
        let mut reader = BufReader::with_capacity(16, child.stdout.take().expect("a pipe"));
        reader.read_until(b'\n', &mut line).expect("a line");
        drop(reader);
        let output = child.wait_with_output().expect("the command ends");
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert_eq!((output.status.code(), &*stderr), (Some(status), ""), "{args:?}");
        assert!(line.len() > 1, "{args:?}: {line:?}");
    }
}

/// Runs the command with standard streams redirected as a shell has it.
fn closed(redirection: &str, args: &[&str]) -> Outcome {
    let command = adsdv(args);
    let mut shell = Command::new("sh");
    shell.args(["-c", &format!("exec \"$0\" \"$@\" {redirection}")]).arg(command.get_program()).args(args);
    shell.current_dir(command.get_current_dir().expect("it was set")).env("RUST_BACKTRACE", "1");
    calm(outcome(&mut shell))
}

/// There is no standard output at all: the status is what it would have been.
#[test]
pub(super) fn a_standard_output_that_is_closed() {
    for &(args, status) in COMMANDS {
        let outcome = closed(">&-", args);
        assert_eq!((outcome.status, outcome.stderr.as_str()), (Some(status), ""), "{args:?}");
    }
}

#[test]
pub(super) fn a_standard_input_that_is_closed_is_empty() {
    let outcome = closed("<&-", &["check", "-"]);
    refused(&outcome, "standard input: the log is empty", "candump -L");
}

/// The operator is gone, so the car goes, too.
#[test]
pub(super) fn a_terminal_that_is_closed() {
    let status = folder_with("bad-input-terminal", "status", b"").join("status");
    let line = format!("trap '' HUP; {SCREEN}; echo $? > {}", text(&status));
    let Some(mut terminal) = Terminal::new(&line) else { return };
    terminal.shows("happened");
    // Not in the midst of drawing, which ends it anyway, but while it waits for keys.
    thread::sleep(Duration::from_millis(200));
    drop(terminal);
    let late = Instant::now() + screen::PATIENCE;
    let ended = loop {
        let ended = fs::read_to_string(&status).expect("it is there");
        if ended.ends_with('\n') {
            break ended;
        }
        assert!(Instant::now() < late, "it goes on without a terminal");
        thread::sleep(Duration::from_millis(10));
    };
    let ended = ended.trim().parse().expect("a status");
    may_end_with(ended);
    assert_eq!(ended, 2);
}

#[test]
pub(super) fn a_full_disk() {
    for &(args, _) in COMMANDS {
        let full = OpenOptions::new().write(true).open("/dev/full").expect("Linux has it");
        let outcome = calm(outcome(adsdv(args).stdout(full)));
        refused(&outcome, "standard output: cannot write the answer: ", "free some space");
    }
}

/// The status still tells.
#[test]
pub(super) fn a_full_disk_for_errors() {
    for args in [&["check", "no-such.log"][..], &["demo", "--scenario", "tests"], &["--no-such-option"]] {
        let full = OpenOptions::new().write(true).open("/dev/full").expect("Linux has it");
        assert_eq!(outcome(adsdv(args).stderr(full)).status, Some(2), "{args:?}");
        assert_eq!(closed("2>&-", args).status, Some(2), "{args:?}");
    }
}

/// The log of a demo for which there is not enough room: the command says so, and what there was room for can be judged.
#[test]
pub(super) fn a_full_disk_for_the_log_of_a_demo() {
    refused(&run(&["demo", "--log", "/dev/full"]), "/dev/full: cannot write the log: ", "free some space");
    let log = folder_with("bad-input-full", "run.log", b"").join("run.log");
    let command = adsdv(&["demo", "--log", text(&log)]);
    let mut small = Command::new("sh");
    // A file of little more than 100 KB, which cuts a line: the system refuses to write more, as a full disk does.
    small.args(["-c", "trap '' XFSZ; ulimit -f 201; exec \"$0\" \"$@\""]).arg(command.get_program());
    // Where lines are counted that tests run, there would be no room for the counts either, which LLVM would tell.
    small.env("LLVM_PROFILE_FILE", "/dev/null");
    let outcome = calm(outcome(small.args(command.get_args())));
    refused(&outcome, "run.log: cannot write the log: ", "with --log");
    let written = fs::read(&log).expect("it is there");
    assert_eq!(written.len(), 201 * 512);
    let whole = String::from_utf8_lossy(&written).matches('\n').count();
    reported(&check_input(&[], &written).stdout, whole, &["(0 violations, ", &format!("line {}", whole + 1)]);
}

/// Tables for which there is not enough room: no part of one is there, and a file that was is as it was.
#[test]
pub(super) fn a_full_disk_for_a_table() {
    let decode = ["decode", "--format", "parquet", MISSION, "-o"];
    let said = "cannot write what was decoded: ";
    refused(&run(&[&decode[..], &["/dev/full"]].concat()), said, "free some space");
    let folder = folder_with("bad-input-table", "run.parquet", b"before");
    let [file, new, empty] = ["run.parquet", "new", "empty"].map(|name| folder.join(name));
    fs::create_dir_all(&empty).expect("the folder can be written");
    for asked in
        [&[text(&file)][..], &[text(&new), "--table", "messages"], &[text(&empty), "--table", "messages"]]
    {
        let command = adsdv(&[&decode[..], asked].concat());
        let mut small = Command::new("sh");
        small.args(["-c", "trap '' XFSZ; ulimit -f 20; exec \"$0\" \"$@\""]).arg(command.get_program());
        small.env("LLVM_PROFILE_FILE", "/dev/null").current_dir(crate::run::workspace());
        refused(&calm(outcome(small.args(command.get_args()))), said, "with --output");
    }
    assert_eq!(fs::read(&file).expect("it is there"), b"before");
    assert_eq!(fs::read_dir(&folder).expect("a folder").count(), 2, "and what is empty");
    assert_eq!(fs::read_dir(&empty).expect("a folder").count(), 0, "which stays so");
}

/// A page for which there is not enough room: the report is printed, no part of the page is there, and a file that was is as it was.
#[test]
pub(super) fn a_full_disk_for_a_page() {
    let said = "cannot write the page: ";
    let report = crate::run::run(&["check", MISSION]).stdout;
    let full = run(&["check", MISSION, "--html", "/dev/full"]);
    assert_eq!((full.status, &full.stdout), (Some(2), &report));
    explained(&full.stderr, said, "free some space");
    let folder = folder_with("bad-input-page", "run.html", b"<!doctype html>before");
    for file in [folder.join("run.html"), folder.join("new.html")] {
        let command = adsdv(&["check", MISSION, "--html", text(&file)]);
        let mut small = Command::new("sh");
        small.args(["-c", "trap '' XFSZ; ulimit -f 20; exec \"$0\" \"$@\""]).arg(command.get_program());
        small.env("LLVM_PROFILE_FILE", "/dev/null").current_dir(crate::run::workspace());
        let outcome = calm(outcome(small.args(command.get_args())));
        assert_eq!((outcome.status, &outcome.stdout), (Some(2), &report));
        explained(&outcome.stderr, said, "with --html");
    }
    assert_eq!(fs::read(folder.join("run.html")).expect("it is there"), b"<!doctype html>before");
    assert_eq!(fs::read_dir(&folder).expect("a folder").count(), 1);
}

/// A folder that is not there, or a directory in the place of the page.
#[test]
pub(super) fn a_page_that_has_no_place() {
    let missing = run(&["check", MISSION, "--html", "no-such-folder/run.html"]);
    assert_eq!((missing.status, missing.stdout), (Some(2), crate::run::run(&["check", MISSION]).stdout));
    explained(
        &missing.stderr,
        "no-such-folder/run.html: cannot write the page: ",
        "make the directory first",
    );
    refused(
        &run(&["check", MISSION, "--html", "tests"]),
        "tests: cannot write the page: ",
        "name a file in it with --html",
    );
}

/// What was explored is reported, though the log of a counterexample cannot be written; those that can be are.
#[test]
pub(super) fn a_full_disk_for_counterexamples() {
    let folder = folder_with("bad-input-counterexamples", "unrelated", b"");
    symlink("/dev/full", folder.join("counterexample-driving-neutral.log")).expect("a file of that name");
    let asked =
        ["verify", "--model", "open", "--vectors", "read", "--reading", "fault-trigger=edge", "--logs"];
    let outcome = run(&[&asked[..], &[text(&folder)]].concat());
    assert_eq!(outcome.status, Some(2), "{}", outcome.stderr);
    explained(
        &outcome.stderr,
        "counterexample-driving-neutral.log: cannot write counterexamples: ",
        "free some space",
    );
    let rows = |text: &str| text.lines().filter(|line| line.contains("FAILS in ")).count();
    assert_eq!(rows(&outcome.stdout), 2, "{}", outcome.stdout);
    for expected in ["  ready-sdc ", "FAILS driving-finished\n"] {
        assert!(outcome.stdout.contains(expected), "{expected:?} is not in {}", outcome.stdout);
    }
    let written = fs::read(folder.join("counterexample-driving-finished.log")).expect("it is there");
    assert!(written.len() > lines(100).len() && written.ends_with(b"\n"));
}

/// The report is printed, and which excerpt could not be written; a file in the place of the directory is refused before all.
#[test]
pub(super) fn excerpts_that_cannot_be_written() {
    let folder = folder_with("bad-input-excerpts", "unrelated", b"");
    symlink("/dev/full", folder.join("02-fault-flag-unfounded.log")).expect("a file of that name");
    let outcome = run(&["check", "--excerpt", text(&folder), FINISHED_WHILE_MOVING]);
    assert_eq!(outcome.status, Some(2), "{}", outcome.stderr);
    explained(&outcome.stderr, "02-fault-flag-unfounded.log: cannot write excerpts: ", "free some space");
    reported(&outcome.stdout, 32_535, &["(2 violations, "]);
    assert!(fs::read(folder.join("01-finished-while-moving.log")).is_ok_and(|log| log.ends_with(b"\n")));
    for directory in [folder.join("unrelated"), folder.join("unrelated/deeper")] {
        let outcome = run(&["check", "--excerpt", text(&directory), FINISHED_WHILE_MOVING]);
        refused(&outcome, ": cannot write excerpts: ", "it is no directory");
    }
}

/// A command that goes on until it is stopped; it is stopped when this is dropped, so also when a test fails.
struct Running(Child);

impl Drop for Running {
    fn drop(&mut self) {
        // It may have ended by itself.
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// The Explorer serves, whether or not anybody could read where.
#[test]
pub(super) fn an_explorer_that_cannot_print_its_address() {
    cannot_print_its_address("explore");
}

/// And so does the page that judges.
#[test]
pub(super) fn a_page_that_cannot_print_its_address() {
    cannot_print_its_address("web");
}

fn cannot_print_its_address(name: &str) {
    let full = OpenOptions::new().write(true).open("/dev/full").expect("Linux has it");
    let mut command = adsdv(&[name, "--port", "0"]);
    let mut server = Running(command.stdout(full).stderr(Stdio::piped()).spawn().expect("it starts"));
    let mut errors = BufReader::new(server.0.stderr.take().expect("a pipe"));
    let (sender, receiver) = mpsc::channel();
    thread::spawn(move || {
        let mut line = String::new();
        let read = errors.read_line(&mut line);
        sender.send(read.map(|_| line))
    });
    let line = receiver.recv_timeout(Duration::from_mins(1)).expect("a line in time").expect("text");
    assert!(line.starts_with("adsdv: standard output: cannot write the answer: "), "{line}");
    serves_on(&mut server);

    let mut command = adsdv(&[name, "--port", "0"]);
    let mut server =
        Running(command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("it starts"));
    drop(server.0.stdout.take());
    serves_on(&mut server);
    server.0.kill().expect("it runs");
    let mut stderr = String::new();
    server.0.stderr.take().expect("a pipe").read_to_string(&mut stderr).expect("text");
    assert_eq!(stderr, "");
}

fn serves_on(server: &mut Running) {
    let begun = Instant::now();
    while begun.elapsed() < Duration::from_millis(500) {
        assert!(server.0.try_wait().is_ok_and(|status| status.is_none()), "it ended");
        thread::sleep(Duration::from_millis(10));
    }
}
