//! A line of a gigabyte, really streamed, in half a gigabyte of memory: it is passed over or refused, and costs itself alone.

use std::io::{self, Write};
use std::process::Command;

use super::{adsdv, calm, fed, judged, lines, refused};
use crate::run::{MISSION, file, outcome, run};

const GIGABYTE: usize = 1 << 30;
/// What the command may have, in KiB, of which its threads take most only as addresses.
const MEMORY: u32 = 500_000;

/// The command with limited memory; with less than that it is ended by a signal, which is no status.
fn limited(args: &[&str]) -> Command {
    let command = adsdv(args);
    let mut limited = Command::new("sh");
    limited.args(["-c", &format!("ulimit -v {MEMORY}; exec \"$0\" \"$@\"")]).arg(command.get_program());
    limited.args(command.get_args()).env("RUST_BACKTRACE", "1");
    limited.current_dir(command.get_current_dir().expect("it was set"));
    limited
}

/// Writes a line that begins like a frame and has no end.
fn long(out: &mut impl Write) -> io::Result<()> {
    out.write_all(b"(1795209999.134300) vcan0 520#")?;
    let piece = vec![b'0'; 1 << 20];
    (0..GIGABYTE / piece.len()).try_for_each(|_| out.write_all(&piece))
}

#[test]
pub(super) fn in_a_log() {
    let (mission, before) = (file(MISSION), lines(5000));
    let outcome = fed(&mut limited(&["check", "-"]), |stdin| {
        stdin.write_all(&before)?;
        long(stdin)?;
        stdin.write_all(b"\n")?;
        stdin.write_all(&mission[before.len()..])
    });
    judged(
        &outcome,
        33_940,
        &["line 5001, column 1: found ", "expected a line of at most 8192 bytes", "1 warning"],
    );
    let outcome = fed(&mut limited(&["check", "-"]), long);
    refused(&outcome, ": no readable frame in 1 line", "candump -L");
}

/// Of two logs that are compared, it costs itself alone as well.
#[test]
pub(super) fn in_a_log_that_is_compared() {
    let outcome = fed(&mut limited(&["compare", MISSION, "-"]), |stdin| {
        stdin.write_all(&file(MISSION))?;
        long(stdin)
    });
    assert_eq!((outcome.status, outcome.stderr.as_str()), (Some(1), ""), "{}", outcome.stdout);
    assert!(outcome.stdout.ends_with("\nthey differ: 1 finding\n"), "{}", outcome.stdout);
}

/// A scenario of so many bytes is none: nobody waits until they are read.
#[test]
pub(super) fn in_a_scenario() {
    for command in [&["demo"][..], &["vcu", "no-can", "--plain"]] {
        let outcome = fed(&mut limited(&[command, &["--scenario", "-"]].concat()), long);
        refused(
            &outcome,
            "standard input: is longer than 4194304 bytes; expected a scenario",
            "adsdv demo --help",
        );
    }
}

#[test]
pub(super) fn in_a_suite() {
    let suite = run(&["suite"]).stdout;
    let mut command = limited(&["conform", "--suite", "/dev/stdin", "--", "cat"]);
    let outcome = fed(&mut command, |stdin| {
        stdin.write_all(suite.as_bytes())?;
        long(stdin)?;
        stdin.write_all(b"\nrubbish\n")
    });
    refused(&outcome, ": 2 lines that are no tests", "correct these lines");
    for expected in
        ["line 202: is longer than 4194304 bytes; expected a test", "line 203: expected value at column 1"]
    {
        assert!(outcome.stderr.contains(expected), "{expected:?} is not in {}", outcome.stderr);
    }
}

/// Lines that are no tests, so many that even what is wrong with them would not fit: the first are listed, the others counted.
#[test]
pub(super) fn a_suite_of_bad_lines() {
    const LINES: usize = 5_000_000;
    let mut command = limited(&["conform", "--suite", "/dev/stdin", "--", "cat"]);
    let outcome = fed(&mut command, |stdin| stdin.write_all(&b"x\n".repeat(LINES)));
    refused(&outcome, ": 5000000 lines that are no tests", "correct these lines");
    assert!(outcome.stderr.contains("\n  and 4999990 more\n"), "{}", outcome.stderr);
}

/// On standard output of a program it is refused before it is over; on its standard error, it is passed over.
#[test]
pub(super) fn of_a_program() {
    let says = |to: &str| {
        let program = format!("head -c {GIGABYTE} /dev/zero | tr '\\0' a >&{to}");
        calm(outcome(&mut limited(&["conform", "--timeout", "60", "--", "sh", "-c", &program])))
    };
    refused(
        &says("1"),
        ": a line of more than 65536 bytes; expected a JSON object on one line",
        "line break",
    );
    let outcome = says("2");
    refused(&outcome, ": the program ended early", "until the end of its input");
    assert!(outcome.stderr.len() < 10_000, "all of it is printed");
}
