//! Logs that are cut off, broken in the middle, or have odd times: every frame that can be read is judged, and the rest is reported.

use std::io::Write as _;
use std::os::fd::OwnedFd;
use std::os::unix::net::UnixStream;
use std::process::Stdio;

use super::{Outcome, adsdv, calm, check, explained, fed, judged, lines, refused, reported, rubbish};
use crate::run::{FINISHED_WHILE_MOVING, MISSION, file, outcome};

/// The frames of the recorded mission.
const FRAMES: usize = 33_940;

/// The mission with something else after so many of its lines.
fn broken_after(count: usize, other: &[u8]) -> Vec<u8> {
    let (mission, before) = (file(MISSION), lines(count));
    [&before, other, &mission[before.len()..]].concat()
}

/// The lines of the recorded mission, each changed.
fn changed(change: impl Fn(usize, &str) -> String) -> Vec<u8> {
    let log = String::from_utf8(file(MISSION)).expect("text");
    log.lines().enumerate().map(|(index, line)| change(index, line) + "\n").collect::<String>().into_bytes()
}

fn without_time(line: &str) -> String {
    line.split_once(' ').expect("a time and a frame").1.to_owned()
}

#[test]
pub(super) fn rubbish_in_the_middle() {
    let outcome = check(&broken_after(5000, &rubbish()));
    judged(&outcome, FRAMES, &["warning LOG 2 broken-line", "line 5001, column 1: found "]);
    // It costs itself alone: what is found in the frames is what is found without it.
    let timeline = |text: &str| text.split("FINDINGS").next().map(str::to_owned);
    assert_eq!(timeline(&outcome.stdout), timeline(&check(&file(MISSION)).stdout));
    let before = [&rubbish()[..], &file(FINISHED_WHILE_MOVING)].concat();
    let outcome = check(&before);
    assert_eq!(outcome.status, Some(1), "the violations are found");
    judged(&outcome, 32_535, &["(2 violations, ", "broken-line line 1, column 1: found "]);
}

/// Cut off at each byte of its last line: the frames before are there, and the report says what is missing.
#[test]
pub(super) fn a_truncated_log() {
    const WHOLE: usize = 50;
    let line = b"(1795209995.294610) vcan0 520#0000010000000000";
    for cut in 1..=line.len() {
        let outcome = check(&[&lines(WHOLE)[..], &line[..cut]].concat());
        let frames = outcome
            .stdout
            .lines()
            .find(|line| line.contains(" frames in "))
            .and_then(|line| line.split(' ').nth(2))
            .and_then(|count| count.parse().ok());
        let frames = frames.unwrap_or_else(|| panic!("{}", outcome.stdout));
        assert!(frames == WHOLE || frames == WHOLE + 1, "{frames} frames, cut after {cut}");
        if cut < line.len() {
            judged(&outcome, frames, &["(0 violations, 1 warning, ", "broken-line line 51"]);
        } else {
            judged(&outcome, WHOLE + 1, &["(0 violations, 0 warnings, "]);
        }
    }
}

#[test]
pub(super) fn times_that_go_backwards() {
    // Two frames changed places.
    let mission = String::from_utf8(file(MISSION)).expect("text");
    let mut swapped: Vec<&str> = mission.lines().collect();
    swapped.swap(9000, 9001);
    let outcome = check((swapped.join("\n") + "\n").as_bytes());
    judged(
        &outcome,
        FRAMES,
        &["(0 violations, 0 warnings, ", "time-backwards the log's time goes back by 0.011 ms"],
    );
    // The clock was set back, or two recordings stand one behind the other.
    let twice = file(MISSION).repeat(2);
    let says =
        ["(0 violations, 0 warnings, ", "goes back by 25995.893 ms; judged as a new recording from here on"];
    let outcome = check(&twice);
    judged(&outcome, 2 * FRAMES, &says);
    assert_eq!(outcome.stdout.matches("AS_READY        -> AS_DRIVING").count(), 2, "{}", outcome.stdout);
}

#[test]
pub(super) fn times_that_are_absent() {
    // Of one line in a hundred: the others are judged.
    let outcome = check(&changed(|index, line| match index % 100 {
        7 => without_time(line),
        _ => line.to_owned(),
    }));
    judged(&outcome, FRAMES - 340, &["line 8, column 1: found \"vcan0 ", "expected a time such as"]);
    // Of all lines: there is nothing to judge.
    let outcome = check(&changed(|_, line| without_time(line)));
    refused(&outcome, ": no readable frame in 33940 lines; line 1, column 1: ", "candump -L");
    // Of all lines the same: there are frames, and no time in which anything could be late.
    let outcome = check(&changed(|_, line| format!("(0000000000.000000) {}", without_time(line))));
    let says = [
        "(0 violations, 1 warning, ",
        "no time passes in 33940 frames, so that nothing was judged that takes time",
    ];
    judged(&outcome, FRAMES, &says);
}

/// The disk, or whatever the log comes from, fails in the middle: what came before is judged and printed, and the status says
/// that it is no verdict on the log.
#[test]
pub(super) fn a_log_that_fails_while_it_is_read() {
    for (option, read) in [("--color=auto", 1000), ("--color=auto", 0), ("--json", 1000)] {
        let Outcome { status, stdout, stderr } = failing(&["check", option, "-"], &lines(read));
        assert_eq!(status, Some(2), "{stderr}");
        let error = match read {
            0 => "standard input: cannot read it: ".to_owned(),
            _ => format!("standard input: cannot read on after line {read}: "),
        };
        explained(&stderr, &error, "copy the log to another disk");
        match (option, read) {
            (_, 0) => assert_eq!(stdout, ""),
            ("--json", _) => {
                assert!(
                    stdout.starts_with("{\"schema\":1,\"edition\":\"4.0\",\"recognised\":")
                        && stdout.contains("\"frames\":1000,")
                        && stdout.contains("cannot read on after line 1000")
                );
            }
            _ => reported(&stdout, read, &["broken-line cannot read on after line 1000: "]),
        }
    }
}

/// Runs a command on a log from a connection that breaks when it has been read.
fn failing(args: &[&str], log: &[u8]) -> Outcome {
    let (mut ours, mut theirs) = UnixStream::pair().expect("a pair of sockets");
    // What was said to the other end and never heard there makes the end of the connection an error.
    theirs.write_all(b"unheard").expect("it is connected");
    let mut command = adsdv(args);
    command.stdin(Stdio::from(OwnedFd::from(theirs)));
    ours.write_all(log).expect("there is room for a short log");
    drop(ours);
    calm(outcome(&mut command))
}

/// What can be read of two logs is compared: rubbish, a cut and times that go back are findings of the one that has them.
#[test]
pub(super) fn a_comparison_with_a_broken_log() {
    let compared = |log: &[u8]| {
        let outcome = fed(&mut adsdv(&["compare", MISSION, "-"]), |stdin| stdin.write_all(log));
        assert_eq!((outcome.status, outcome.stderr.as_str()), (Some(1), ""), "{}", outcome.stdout);
        outcome.stdout
    };
    let rubbish = compared(&broken_after(5000, &rubbish()));
    assert!(rubbish.contains("  broken-line (") && !rubbish.contains("WHERE THEY PART"), "{rubbish}");
    let cut = compared(&[&lines(1500)[..], b"(1795209996.4"].concat());
    assert!(cut.contains("  broken-line\n") && cut.contains("line 1501, column"), "{cut}");
    assert!(compared(&file(MISSION).repeat(2)).contains("  time-backwards\n"));
    // A log that fails: what came before is compared, and the error says that it is not all of it.
    let Outcome { status, stdout, stderr } = failing(&["compare", "-", MISSION], &lines(1000));
    assert_eq!(status, Some(2), "{stdout}");
    explained(
        &stderr,
        "GOOD, standard input: cannot read on after line 1000: ",
        "copy the log to another disk",
    );
    assert!(stdout.contains("GOOD  standard input: 1000 frames in "), "{stdout}");
}
