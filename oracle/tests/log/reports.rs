//! What is said of logs, to the letter: `reports.txt` has it.
//!
//! `UPDATE_EXPECT=1 cargo test -p adsdv-oracle --test log` writes it anew.

use std::fmt::Write as _;

use adsdv_oracle::judge::Report;
use adsdv_oracle::log::{LogOptions, LogProgress, judge_log};
use expect_test::expect_file;

/// A frame of 520h with this AS state.
fn status(ms: u64, interface: &str, state: u8, direction: &str) -> String {
    format!("({}.{:03}000) {interface} 520#0000{state:02X}0000000000{direction}\n", ms / 1000, ms % 1000)
}

/// A frame of 510h.
fn answer(ms: u64, interface: &str, direction: &str) -> String {
    format!("({}.{:03}000) {interface} 510#000000000000{direction}\n", ms / 1000, ms % 1000)
}

/// Frames of 520h, one every 10 ms.
fn frames(count: u64, direction: &str) -> String {
    (0..count).map(|place| status(1000 + place * 10, "can0", 1, direction)).collect()
}

/// A log of the AI Computer, which may have sent what only others may, at the end.
fn recorded_by_ai(own: u64, own_received: u64, received: u64, sent: u64, forged: &str) -> String {
    let mut log = String::new();
    let mut ms = 1000;
    let mut add = |line: &dyn Fn(u64) -> String, count: u64| {
        for _ in 0..count {
            ms += 10;
            log += &line(ms);
        }
    };
    add(&|ms| answer(ms, "can0", " T"), own);
    add(&|ms| answer(ms, "can0", " R"), own_received);
    add(&|ms| status(ms, "can0", 1, " R"), received);
    add(&|ms| status(ms, "can0", 1, " T"), sent);
    add(&|ms| format!("({}.{:03}000) can0 {forged} T\n", ms / 1000, ms % 1000), 2);
    log
}

/// Names, and logs.
fn logs() -> Vec<(&'static str, String)> {
    let good = || frames(3, "");
    let with = |line: &str| good() + line + "\n" + &status(1030, "can0", 1, "");
    let many: String = (0..70).map(|place| status(1100, &format!("can{place}"), 1, "")).collect();
    vec![
        ("empty", String::new()),
        ("an empty line", "\n".to_owned()),
        ("two lines of rubbish", "rubbish\nmore\n".to_owned()),
        ("frames", good()),
        ("a byte order mark", format!("\u{feff}{}", good())),
        ("carriage returns", good().replace('\n', "\r\n")),
        ("blank lines", good().replace('\n', "\n\n")),
        ("rubbish in the middle", with("rubbish")),
        ("no time", with("can0 520#0000010000000000")),
        ("no interface", with("(1.025000)  520#0000010000000000")),
        (
            "no interface in the first line",
            "(1795209995.234358)  520#0000010000000000\n".to_owned() + &good(),
        ),
        ("a frame of no message", with("(1.025000) can0 123#00")),
        ("an extended identifier", with("(1.025000) can0 00000520#0000010000000000")),
        ("remote frames", with("(1.025000) can0 520#R\n(1.026000) can0 520#R8")),
        ("an error frame", with("(1.025000) can0 20000004#0000000000000000")),
        ("CAN FD", with("(1.025000) can0 520##10000010000000000")),
        ("CAN XL", with("(1.025000) can0 00520#80:00:00000000#0000")),
        ("another interface", with("(1.025000) can1 123#00")),
        (
            "another interface with the document's messages",
            with(&status(1025, "can1", 2, "").replace('\n', "")),
        ),
        ("no message of the document", "(1.000000) can0 123#00\n(1.010000) can1 123#00\n".to_owned()),
        (
            "the first interface has none",
            "(1.000000) can0 123#00\n".to_owned() + &status(1010, "can1", 1, ""),
        ),
        ("more interfaces than are listed", good() + &many),
        ("dropped frames", with("DROPCOUNT: dropped 3 CAN frames on 'can0' socket (total drops 3)")),
        ("one dropped frame", with("DROPCOUNT: dropped 1 CAN frame on 'can0' socket (total drops 1)")),
        (
            "dropped on another interface",
            with("DROPCOUNT: dropped 3 CAN frames on 'can1' socket (total drops 3)"),
        ),
        ("cut off in a frame", good() + "(1.030000) can0 520#00000100"),
        ("cut off in a frame, with a line feed", good() + "(1.030000) can0 520#00000100\n"),
        ("cut off before the line feed", good() + "(1.030000) can0 520#0000010000000000"),
        ("cut off in a frame of no message", good() + "(1.030000) can0 123#00"),
        ("cut off in a time", good() + "(1.03"),
        ("time goes back", good() + &status(1005, "can0", 1, "") + &status(200, "can0", 1, "")),
        ("received", frames(10, " R")),
        ("sent by the AI Computer", recorded_by_ai(1, 0, 5, 0, "000#00")),
        ("sent by the AI Computer, 520h", recorded_by_ai(1, 0, 5, 1, "520#0000010000000000")),
        ("sent by somebody, of whom too little was received", recorded_by_ai(1, 0, 4, 0, "000#00")),
        ("sent by somebody, as much as a VCU", recorded_by_ai(1, 0, 8, 2, "000#00")),
        ("sent by somebody who received 510h", recorded_by_ai(3, 1, 9, 0, "000#00")),
        ("sent by somebody who sent no 510h", recorded_by_ai(0, 0, 9, 0, "000#00")),
        ("no time passes in 100 frames", status(1000, "can0", 1, "").repeat(100)),
        ("no time passes in 101 frames", status(1000, "can0", 1, "").repeat(101)),
    ]
}

fn printed(report: &Report) -> String {
    let mut text = format!(
        "{} frames in {} us, {}\n",
        report.frames,
        report.duration_ns / 1000,
        report.verdict().name()
    );
    for finding in &report.findings {
        let (severity, rule, party) = (finding.severity.name(), finding.rule.id(), finding.party.name());
        let _ = writeln!(
            text,
            "{} us: {severity} of {rule} by {party}: {}",
            finding.t_ns / 1000,
            finding.message()
        );
    }
    text
}

#[test]
fn the_reports_on_logs_are_as_written() {
    let mut text = String::new();
    for (name, log) in logs() {
        for interface in [None, Some("can0"), Some("can1")] {
            let options = LogOptions { interface: interface.map(str::to_owned), ..LogOptions::default() };
            let said = match judge_log(log.as_bytes(), &options, |_| {}) {
                Ok(report) => printed(&report),
                Err(error) => format!("{error}\n"),
            };
            let _ = writeln!(text, "================ {name}, on {}\n{said}", interface.unwrap_or("any"));
        }
    }
    expect_file!["reports.txt"].assert_eq(&text);
}

#[test]
fn progress_is_reported_every_65536_lines() {
    const LINES: usize = 1 << 16;
    for (lines, expected) in [
        (LINES - 1, vec![]),
        (LINES, vec![65_536]),
        (3 * LINES - 1, vec![65_536, 131_072]),
        (3 * LINES, vec![65_536, 131_072, 196_608]),
    ] {
        let log = status(1000, "can0", 1, "").repeat(lines);
        let mut printed = Vec::new();
        let progress = |progress: LogProgress| printed.push(progress.lines);
        judge_log(log.as_bytes(), &LogOptions::default(), progress).expect("frames");
        assert_eq!(printed, expected);
    }
}
