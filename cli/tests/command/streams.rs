//! Standard input, and readers of the output that leave early.

use std::fmt::Write as _;
use std::io::{BufRead as _, BufReader};
use std::process::Stdio;

use crate::run::{FINISHED_WHILE_MOVING, MISSION, adsdv, check_input, file, run};

#[test]
fn standard_input_is_judged_like_the_file() {
    for log in [MISSION, FINISHED_WHILE_MOVING] {
        let (named, given) = (run(&["check", log]), check_input(&[], &file(log)));
        assert_eq!(given.stdout.replace("standard input: ", &format!("{log}: ")), named.stdout);
        assert_eq!(given.status, named.status);
        let (named, given) = (run(&["check", "--json", log]), check_input(&["--json"], &file(log)));
        assert_eq!((given.stdout, given.status), (named.stdout, named.status));
    }
}

#[test]
fn the_exit_status_is_the_verdict() {
    for (log, verdict, status) in [(MISSION, "conforms", 0), (FINISHED_WHILE_MOVING, "violates", 1)] {
        for option in ["--color=auto", "--json"] {
            let outcome = run(&["check", option, log]);
            assert_eq!(outcome.status, Some(status), "{}", outcome.stdout);
            assert!(outcome.stdout.lines().last().is_some_and(|line| line.contains(verdict)));
            assert_eq!(outcome.stderr, "");
        }
    }
}

#[test]
fn a_reader_that_leaves_early_is_no_error() {
    let cases: [(&[&str], _); 4] = [
        (&["check", MISSION], 0),
        (&["check", FINISHED_WHILE_MOVING], 1),
        (&["check", "--json", FINISHED_WHILE_MOVING], 1),
        (&["dbc"], 0),
    ];
    for (args, status) in cases {
        // Closed before the first byte: the reading end is dropped at once.
        let mut child =
            adsdv(args).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("the command starts");
        drop(child.stdout.take());
        let output = child.wait_with_output().expect("the command ends");
        assert_eq!(output.status.code(), Some(status), "{args:?}");
        assert_eq!(String::from_utf8_lossy(&output.stderr), "", "{args:?}");
    }
}

#[test]
fn a_reader_may_leave_after_the_first_line() {
    let mut child =
        adsdv(&["dbc"]).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("the command starts");
    let mut line = String::new();
    let mut reader = BufReader::with_capacity(16, child.stdout.take().expect("a pipe"));
    reader.read_line(&mut line).expect("a line");
    drop(reader);
    assert_eq!(line, "VERSION \"3.0\"\n");
    let output = child.wait_with_output().expect("the command ends");
    assert_eq!((output.status.code(), output.stderr.as_slice()), (Some(0), &b""[..]));
}

#[test]
fn what_was_chosen_stands_in_the_header() {
    let report = run(&["check", "--window", "20", "--interface", "vcan0", MISSION]).stdout;
    let header: Vec<_> = report.lines().take_while(|line| !line.is_empty()).collect();
    // The edition, and by what it is recognised, may take more than a line.
    let [_, .., frames, interface, window] = header[..] else { panic!("{header:?}") };
    assert!(frames.starts_with("tests/logs/mission.log: 33940 frames in 25.99"), "{header:?}");
    assert_eq!([interface, window], ["interface vcan0", "window 20 ms, deadline 50 ms"]);
}

#[test]
fn lines_fit_into_100_columns() {
    for log in [MISSION, FINISHED_WHILE_MOVING] {
        for line in run(&["check", log]).stdout.lines() {
            assert!(line.chars().count() <= 100, "{line}");
        }
    }
}

/// 500h comes as it does since 2026, and 120h is of 4.0 alone: each is long to say, and none decides.
#[test]
fn what_an_edition_is_recognised_by_fits_into_100_columns_where_one_fact_does_not() {
    let log = (0..400).fold(String::new(), |mut log, step| {
        let id = if step % 10 == 0 { "500" } else { "120" };
        let _ = writeln!(log, "({}.{:02}) can0 {id}#0000000000000000", step / 100, step % 100);
        log
    });
    let report = check_input(&[], log.as_bytes()).stdout;
    let [first, second] = [0, 1].map(|line| report.lines().nth(line).expect("a line"));
    let newest = adsdv_spec::Edition::ALL.last().expect("an edition").version;
    let recognised = format!("edition {newest} (recognised: 500h comes every 100 ms");
    assert!(first.starts_with(&recognised), "{report}");
    assert!(first.chars().count() <= 100, "{report}");
    let both = format!("{first} {second}");
    assert!(both.ends_with("; though 4.0 fits as well)"), "{report}");
}

#[test]
fn check_reports_what_a_short_log_does_not_show() {
    let log = b"(1.0) can0 520#0000010000000000\n";
    let report = check_input(&[], log);
    for line in [
        "standard input: 1 frame in 0.000 s",
        "  no change of AS_STATE seen",
        "AI handshake: no answers seen",
    ] {
        assert!(report.stdout.lines().any(|l| l == line), "{line:?} is missing: {}", report.stdout);
    }
}

#[test]
fn the_timeline_marks_a_transition_that_figure_2_does_not_have() {
    let mut log = String::new();
    for cycle in 0..100 {
        let state = if cycle < 50 { 1 } else { 3 };
        writeln!(log, "(0.{cycle:02}0000) can0 520#00000{state}0000000000").expect("a string");
    }
    let report = check_input(&[], log.as_bytes());
    assert_eq!(report.status, Some(1));
    let line = report.stdout.lines().find(|line| line.contains("AS_OFF          -> AS_DRIVING"));
    let words: Vec<_> = line.unwrap_or_default().split_whitespace().collect();
    assert_eq!((words.first(), words.last()), (Some(&"0.500"), Some(&"VIOLATION")), "{}", report.stdout);
}
