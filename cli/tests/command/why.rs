//! Logs of runs that did not get far: the first lines of the report say what a person needs. The files in `golden/` are read by
//! people; `UPDATE_EXPECT=1 cargo test -p adsdv --test command` writes them anew.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use crate::golden::compare_text;
use crate::run::{MISSION, file, run, temporary};

/// What a person reads first.
fn first_lines(name: &str, log: &[u8]) -> String {
    let log = temporary(name, log);
    let report = run(&["check", log.to_str().expect("text")]).stdout;
    let path = log.display().to_string();
    report.replace(&path, name).lines().take(10).fold(String::new(), |mut text, line| {
        writeln!(text, "{line}").expect("a string takes all");
        text
    })
}

/// The log of a scenario, in which some lines may be others.
pub(crate) fn played(
    name: &str,
    scenario: &str,
    edition: &str,
    mend: impl FnMut(&str) -> Option<String>,
) -> Vec<u8> {
    let scenario = temporary(&format!("{name}.txt"), scenario.as_bytes());
    let log = temporary(&format!("{name}.log"), b"");
    let (scenario, path) = (scenario.to_str().expect("text"), log.to_str().expect("text"));
    let played = run(&["demo", "--edition", edition, "--scenario", scenario, "--log", path]);
    assert_eq!(played.stderr, "");
    let frames = String::from_utf8(std::fs::read(&log).expect("it was written")).expect("text");
    frames.lines().filter_map(mend).collect::<Vec<_>>().join("\n").into_bytes()
}

/// Frames as they are.
#[allow(clippy::unnecessary_wraps)]
pub(crate) fn as_is(line: &str) -> Option<String> {
    Some(line.to_owned())
}

#[test]
fn cut_before_as_ready() {
    let mission = file(MISSION);
    let cut: Vec<&[u8]> = mission.split_inclusive(|byte| *byte == b'\n').take(1500).collect();
    compare_text("why-cut.txt", &first_lines("cut.log", &cut.concat()));
}

const READY: &str = "0 ebs ARMED, ami SKIDPAD\n0.5 tsms on, asms on\n";

#[test]
fn go_too_early() {
    let log = played("go-too-early", &format!("{READY}AS_READY +2 go on\n+4 end\n"), "2026", as_is);
    compare_text("why-go-too-early.txt", &first_lines("go-too-early.log", &log));
}

/// A line in which 520h shows another AS state.
fn shows(line: &str, state: &str) -> String {
    let at = line.find("520#").map(|at| at + "520#".len());
    at.map_or_else(
        || line.to_owned(),
        |at| {
            let mut line = line.to_owned();
            // The low half of the third byte.
            line.replace_range(at + 5..at + 6, state);
            line
        },
    )
}

/// All is switched on, and the VCU stays in AS_OFF because nobody selects a mission.
fn without_ai_computer(name: &str) -> Vec<u8> {
    played(name, &format!("{READY}3 end\n"), "4.0", |line| {
        let is_ai = line.split(' ').nth(2).is_some_and(|frame| frame.starts_with("51"));
        (!is_ai).then(|| shows(line, "1"))
    })
}

#[test]
fn a_silent_ai_computer() {
    compare_text("why-silent-ai.txt", &first_lines("silent.log", &without_ai_computer("silent")));
}

#[test]
fn what_is_not_known_is_not_said_to_be_seen() {
    let log = temporary("unheard.log", &without_ai_computer("unheard"));
    let report = run(&["check", "--json", log.to_str().expect("text")]).stdout;
    let report: serde_json::Value = serde_json::from_str(&report).expect("JSON");
    let blocked = report["stays"][0]["arrows"][0]["blocked"].as_array().expect("a list");
    let of = |kind: &str| {
        blocked.iter().flat_map(|one| one[kind].as_array().expect("a list").clone()).collect::<Vec<_>>()
    };
    let (failed, unknown) = (of("failed"), of("unknown"));
    assert!(!failed.is_empty() && failed.iter().all(|one| one["seen"].is_string()), "{failed:#?}");
    let mission = unknown.iter().filter(|one| one["condition"] == "mission-selected").collect::<Vec<_>>();
    assert!(!mission.is_empty() && mission.iter().all(|one| one["seen"].is_null()), "{mission:#?}");
}

#[test]
fn a_locked_wheel() {
    // The vehicle has come to drive, and reports one wheel at rest and three at 400 rpm; the AI Computer keeps NEUTRAL.
    let log = played("locked", &format!("{READY}AS_READY +6 go on\nAS_DRIVING +2 end\n"), "4.0", |line| {
        let (before, frame) = line.rsplit_once(' ')?;
        let frame = if frame.starts_with("525#") { "525#0000900190019001" } else { frame };
        Some(format!("{before} {frame}"))
    });
    compare_text("why-locked-wheel.txt", &first_lines("locked.log", &log));
}

#[test]
fn go_that_a_vcu_in_a_late_recording_does_not_hear() {
    let log = played("deaf", &format!("{READY}AS_READY +6 go on\n+1 end\n"), "2026", as_is);
    let log = String::from_utf8(log).expect("text");
    // From the moment on in which the car would drive, 520h shows AS_READY, and the AI Computer requests what it did before.
    let mut requests: BTreeMap<String, String> = BTreeMap::new();
    let mut driving = false;
    let mut deaf = |line: &str| {
        driving |= line.find("520#").is_some_and(|at| line.get(at + 9..at + 10) == Some("3"));
        let (head, frame) = line.rsplit_once(' ').expect("a frame");
        if driving && !frame.starts_with("51") {
            return shows(line, "2");
        }
        let (id, data) = frame.split_once('#').expect("an identifier");
        if !driving {
            requests.insert(id.to_owned(), data.to_owned());
        }
        // The first byte of 510h has the handshake.
        let (now, before) = (data.get(..2).unwrap_or_default(), requests.get(id).map_or("", String::as_str));
        let first = if id == "510" { now } else { before.get(..2).unwrap_or_default() };
        format!("{head} {id}#{first}{}", before.get(2..).unwrap_or_default())
    };
    let log: Vec<String> = log.lines().map(&mut deaf).collect();
    // The recorder is late by up to 9 ms.
    let mut random = fastrand::Rng::with_seed(1);
    let mut late = |line: &str| {
        let (time, rest) = line.split_once(' ').expect("a time");
        let us: u64 = time.trim_matches(['(', ')']).replace('.', "").parse().expect("a time");
        (us + random.u64(..9000), rest.to_owned())
    };
    let mut lines: Vec<(u64, String)> = log.iter().map(|line| late(line)).collect();
    lines.sort_by_key(|(us, _)| *us);
    let line = |(us, rest): &(u64, String)| format!("({}.{:06}) {rest}", us / 1_000_000, us % 1_000_000);
    let log = lines.iter().map(line).collect::<Vec<_>>().join("\n");
    compare_text("why-deaf-vcu.txt", &first_lines("deaf.log", log.as_bytes()));
}
