//! What the report says of how close a log came, and of what was not in it.

use crate::run::{MISSION, check_input, file, run};

/// The lines of the recorded mission that this picks, as a log.
fn picked(pick: impl Fn(&str) -> bool) -> Vec<u8> {
    let mission = String::from_utf8(file(MISSION)).expect("text");
    mission.lines().filter(|line| pick(line)).flat_map(|line| [line, "\n"]).collect::<String>().into_bytes()
}

/// The verdict of a log that was given as standard input.
fn verdict(log: &[u8]) -> String {
    let outcome = check_input(&["--edition", "4.0"], log);
    assert_eq!(outcome.stderr, "");
    let last = outcome.stdout.lines().last().expect("a verdict");
    last.strip_prefix("standard input: ").expect("the log is named").to_owned()
}

#[test]
fn the_verdict_says_what_was_not_there() {
    let of = |id: &'static str| move |line: &str| line.contains(id);
    let begins = |log: Vec<u8>, lines| {
        log.split_inclusive(|byte| *byte == b'\n').take(lines).collect::<Vec<_>>().concat()
    };
    for (log, says) in [
        (file(MISSION), "conforms (0 violations, "),
        (picked(of(" 51")), "conforms, as far as it goes: no message of the VCU (0 violations, "),
        (picked(of(" 52")), "conforms, as far as it goes: no message of the AI Computer (0 violations, "),
        (
            begins(picked(of(" 520")), 90),
            "conforms, as far as it goes: no message of the AI Computer, never left AS_OFF (0 violations, ",
        ),
        (begins(file(MISSION), 1700), "conforms, as far as it goes: never left AS_OFF (0 violations, "),
        (
            picked(|line| !line.contains(" 520#")),
            "conforms, as far as it goes: no AS_STATE shown (0 violations, ",
        ),
    ] {
        let verdict = verdict(&log);
        assert!(verdict.starts_with(says), "{verdict}\nexpected {says}");
    }
}

/// The closest five, and of each kind one; then the numbers of requirements.
#[test]
fn the_margins_stand_behind_the_findings() {
    let report = run(&["check", MISSION]).stdout;
    let (_, behind) = report.split_once("\nMARGINS\n").expect("a section");
    let (margins, behind) = behind.split_once("\n\n").expect("an empty line");
    let kinds: Vec<&str> = margins.lines().filter_map(|line| line.split_whitespace().nth(4)).collect();
    assert_eq!(kinds, ["ready-dwell", "message-gap", "handshake-answer", "finished-speed", "steer-at-go"]);
    let mut lines = behind.lines();
    assert!(lines.next().is_some_and(|line| line.starts_with("AI handshake: ")));
    let counts = lines.next().expect("a line").strip_prefix("requirements that a log can show: ");
    let counts: Vec<&str> = counts.expect("the numbers").split(", ").collect();
    assert_eq!(counts[0], "0 violated");
    assert!(counts.len() == 4 && counts[3].ends_with(" not exercised"), "{counts:?}");
    let none = check_input(&["--edition", "3.0"], b"(1.0) can0 123#00\n").stdout;
    assert!(!none.contains("MARGINS"), "{none}");
}
