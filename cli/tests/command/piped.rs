//! `adsdv watch -`: frames from standard input, in every form of text, through a pipe that is slow or stutters.

use std::fmt::Write as _;
use std::io::{BufRead as _, BufReader, Read as _, Write as _};
use std::process::{Child, Stdio};
use std::time::Duration;

use adsdv_oracle::candump::{Entry, Reader};
use serde_json::Value;

use crate::run::{self, adsdv, fed, run};

const MISSION: &str = include_str!("../../../tests/logs/mission.log");

/// `adsdv watch -`, which waits for what is written to it.
fn watch(options: &[&str]) -> Child {
    adsdv(&[&["watch", "-"], options].concat())
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the command starts")
}

/// What it prints of pieces that are written one after the other, with so long a pause between them.
fn piped<'a>(
    options: &[&str],
    pieces: impl Iterator<Item = &'a [u8]>,
    pause: Duration,
) -> (Option<i32>, String) {
    let mut child = watch(options);
    let mut stdin = child.stdin.take().expect("a pipe");
    for piece in pieces {
        stdin.write_all(piece).and_then(|()| stdin.flush()).expect("it reads");
        std::thread::sleep(pause);
    }
    drop(stdin);
    let output = child.wait_with_output().expect("it ends");
    assert_eq!(String::from_utf8_lossy(&output.stderr), "");
    (output.status.code(), String::from_utf8(output.stdout).expect("text"))
}

/// The report as JSON, without what only a bus has.
fn report(printed: &str) -> Value {
    let mut report: Value =
        serde_json::from_str(printed).unwrap_or_else(|error| panic!("{error}: {printed}"));
    report.as_object_mut().expect("an object").remove("bus");
    report
}

/// What `check` says of the same.
fn checked() -> Value {
    report(&run(&["check", "--json", run::MISSION]).stdout)
}

/// The mission as other programs print it.
fn as_printed(mut line: impl FnMut(f64, &str, u32, &[u8]) -> String) -> String {
    let (mut reader, mut text) = (Reader::new(MISSION.as_bytes()), String::new());
    while let Some(entry) = reader.next_record().expect("it can be read") {
        let Entry::Frame(record) = entry else { panic!("{entry:?}") };
        #[expect(clippy::cast_precision_loss, reason = "microseconds of 2026 fit")]
        let seconds = (record.time_ns / 1000) as f64 / 1e6;
        text.push_str(&line(seconds, record.interface, record.id, record.data));
    }
    text
}

fn bytes(data: &[u8]) -> String {
    data.iter().fold(String::new(), |mut text, byte| {
        let _ = write!(text, " {byte:02X}");
        text
    })
}

#[test]
fn what_a_slow_or_stuttering_pipe_brings_is_judged_like_the_log() {
    let expected = checked();
    let whole = std::iter::once(MISSION.as_bytes());
    // Pieces that end in the middle of lines, and hundreds of milliseconds between some that were none on the bus.
    let stuttering = MISSION.as_bytes().chunks(MISSION.len() / 7);
    let slow = MISSION.as_bytes().chunks(4096);
    for (printed, how) in [
        (piped(&["--json"], whole, Duration::ZERO), "at once"),
        (piped(&["--json"], stuttering, Duration::from_millis(400)), "stuttering"),
        (piped(&["--json"], slow, Duration::from_millis(1)), "slow"),
    ] {
        assert_eq!((printed.0, report(&printed.1)), (Some(0), expected.clone()), "{how}");
    }
}

#[test]
fn every_form_of_text_is_judged_like_the_log() {
    let expected = checked();
    let screen = as_printed(|seconds, interface, id, data| {
        format!(" ({seconds:.6})  {interface}  {id:03X}   [{}] {}\n", data.len(), bytes(data))
    });
    let python_can = as_printed(|seconds, interface, id, data| {
        let len = data.len();
        format!(
            "Timestamp: {seconds:.6}    ID:      {id:03x}    S Rx                DL:  {len}   {}     Channel: {interface}\n",
            bytes(data)
        )
    });
    for text in [screen, python_can] {
        let printed = piped(&["--json"], std::iter::once(text.as_bytes()), Duration::ZERO);
        assert_eq!((printed.0, report(&printed.1)), (Some(0), expected.clone()), "{text:.200}");
    }
}

#[test]
fn what_is_certain_is_printed_while_the_pipe_is_open_and_a_signal_ends_it_with_a_report() {
    let mut child = watch(&[]);
    let mut stdin = child.stdin.take().expect("a pipe");
    let mut stdout = BufReader::new(child.stdout.take().expect("a pipe"));
    let half = MISSION.len() / 2;
    let half = half + MISSION[half..].find('\n').expect("a line") + 1;
    stdin.write_all(&MISSION.as_bytes()[..half]).expect("it reads");
    let mut printed = String::new();
    while !printed.contains("AS_READY -> AS_DRIVING") {
        assert!(stdout.read_line(&mut printed).expect("a line") > 0, "{printed}");
    }
    assert!(!printed.contains("TIMELINE"), "the report comes in the end: {printed}");
    #[cfg(unix)]
    {
        let pid = child.id().to_string();
        let killed = std::process::Command::new("kill").args(["-INT", &pid]).status();
        assert!(killed.is_ok_and(|status| status.success()));
        let status = child.wait().expect("it ends");
        stdout.read_to_string(&mut printed).expect("text");
        assert_eq!(status.code(), Some(0), "{printed}");
        assert!(printed.contains("TIMELINE") && printed.contains("bus: "), "{printed}");
    }
    drop(stdin);
    let _ = child.kill();
}

#[test]
fn what_is_no_recording_is_refused_with_what_it_is() {
    let refused = |input: &str| {
        let ran = fed(&mut adsdv(&["watch", "-"]), |stdin| stdin.write_all(input.as_bytes()));
        assert_eq!(ran.status, Some(2), "{}", ran.stdout);
        ran.stderr
    };
    assert!(refused("").starts_with("adsdv: standard input: the log is empty"), "{}", refused(""));
    assert!(
        refused("hello\n").starts_with("adsdv: standard input: no readable frame in 1 line"),
        "{}",
        refused("hello\n")
    );
    let database = refused("SQLite format 3\0");
    assert!(database.starts_with("adsdv: standard input: it is an SQLite database"), "{database}");
}
