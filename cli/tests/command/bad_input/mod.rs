//! Bad input is a feature: whatever is wrong with what a command is given, or with where its answer goes, it says so in a
//! sentence and what to do, keeps every frame that can be read, and ends with the status that docs/bad-input.md has for it.
//!
//! - `given.rs`: files that are missing, directories, empty, or rubbish;
//! - `kept.rs`: answers in the place of what is read;
//! - `log.rs`: logs that are cut off, broken in the middle, or have odd times, and a disk that fails while one is read;
//! - `long_line.rs`: a line of a gigabyte, in little memory;
//! - `exam.rs`: programs that cannot be examined;
//! - `bus.rs`: a CAN interface that is not there;
//! - `output.rs`: readers that leave, and disks that are full;
//! - `required.rs`: logs that do not show what they are to show;
//! - `rules.rs`: files that are no rules;
//! - `table.rs`: the table of docs/bad-input.md has a row for each of these, each row its tests, and each test its exit statuses.
//!
//! An interface that vanishes takes one: these tests are in `can/tests/socket`, and run on a kernel that has vcan.

mod bus;
mod cars;
mod exam;
mod given;
mod kept;
mod log;
mod long_line;
mod output;
mod required;
mod rules;
mod table;

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::{ChildStdin, Command};

use crate::run::{self, Outcome};

/// The command, which would print a backtrace if it had one.
fn adsdv(args: &[&str]) -> Command {
    let mut command = run::adsdv(args);
    command.env("RUST_BACKTRACE", "1");
    command
}

/// Runs the command to its end.
fn run(args: &[&str]) -> Outcome {
    calm(run::outcome(&mut adsdv(args)))
}

/// Runs a command, and writes its standard input as it reads.
fn fed(command: &mut Command, write: impl FnOnce(&mut ChildStdin) -> io::Result<()> + Send) -> Outcome {
    calm(run::fed(command, write))
}

/// Judges a log that is given as standard input.
fn check(log: &[u8]) -> Outcome {
    fed(&mut adsdv(&["check", "-"]), |stdin| stdin.write_all(log))
}

/// It ended by itself, with a status that docs/bad-input.md has for it, and not by a panic.
#[track_caller]
fn calm(outcome: Outcome) -> Outcome {
    let Outcome { status, stdout, stderr } = &outcome;
    table::may_end_with(status.unwrap_or_else(|| panic!("ended by a signal: {stderr}")));
    for word in ["panicked", "stack backtrace", "RUST_BACKTRACE"] {
        assert!(!stdout.contains(word) && !stderr.contains(word), "{stdout}{stderr}");
    }
    for text in [stdout, stderr] {
        assert!(text.chars().all(|c| c == '\n' || !c.is_control()), "{text:?}");
    }
    outcome
}

/// There is no answer; the error says this in its first line, and what to do in its last.
#[track_caller]
fn refused(outcome: &Outcome, error: &str, hint: &str) {
    let Outcome { status, stdout, stderr } = outcome;
    assert_eq!((*status, stdout.as_str()), (Some(2), ""), "{stderr}");
    explained(stderr, error, hint);
}

/// The first line says what is wrong, the last what to do.
#[track_caller]
fn explained(stderr: &str, error: &str, hint: &str) {
    let first = stderr.lines().next().unwrap_or_default();
    assert!(first.starts_with("adsdv: ") && first.contains(error), "{error:?} is not in {stderr}");
    let last = stderr.lines().last().unwrap_or_default();
    assert!(last.starts_with("hint: ") && last.contains(hint), "{hint:?} is not in {stderr}");
}

/// There is a verdict on so many frames, and the report says all of this; a text is wrapped, and compared without that.
#[track_caller]
fn judged(outcome: &Outcome, frames: usize, says: &[&str]) {
    let Outcome { status, stdout, stderr } = outcome;
    assert!(matches!(status, Some(0 | 1)) && stderr.is_empty(), "{status:?} {stderr}");
    reported(stdout, frames, says);
}

#[track_caller]
fn reported(stdout: &str, frames: usize, says: &[&str]) {
    let counted = format!(": {frames} frames in ");
    // Before the first empty line; the edition before it may take more than a line.
    let mut head = stdout.lines().take_while(|line| !line.is_empty());
    assert!(head.any(|line| line.contains(&counted)), "not {frames} frames: {stdout}");
    let words = stdout.split_whitespace().collect::<Vec<_>>().join(" ");
    for said in says {
        assert!(words.contains(said), "{said:?} is not in {stdout}");
    }
}

/// The first lines of the recorded mission.
fn lines(count: usize) -> Vec<u8> {
    let log = run::file(run::MISSION);
    log.split_inclusive(|&byte| byte == b'\n').take(count).flatten().copied().collect()
}

/// Bytes that are nothing: every one there is, so also those that end lines and those that move a terminal's cursor.
fn rubbish() -> Vec<u8> {
    (0..=u8::MAX).cycle().take(100_000).chain([b'\n']).collect()
}

/// An empty folder for one test, and in it a file of this content.
fn folder_with(name: &str, file: &str, content: &[u8]) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    // It may be there from an earlier run.
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).expect("the folder for tests can be written");
    fs::write(folder.join(file), content).expect("the folder for tests can be written");
    folder
}

fn text(path: &Path) -> &str {
    path.to_str().expect("a path of text")
}
