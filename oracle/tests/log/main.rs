//! Logs as they are read: what is said of each kind of line, of one that fails while it is read, and of one in which no time
//! passes.

mod reports;

use std::error::Error as _;
use std::io::{self, Read};

use adsdv_oracle::candump::{FrameKind, Record};
use adsdv_oracle::judge::{Report, Severity};
use adsdv_oracle::log::{LogError, LogJudge, LogOptions, judge_log, judge_readable};
use adsdv_spec::messages::Vcu2AiStatus;

const FRAME: &str = "can0 520#0000010000000000\n";

/// A disk that fails.
struct Failing;

impl Read for Failing {
    fn read(&mut self, _: &mut [u8]) -> io::Result<usize> {
        Err(io::ErrorKind::TimedOut.into())
    }
}

fn warnings(report: &Report) -> Vec<&str> {
    let warnings = report.findings.iter().filter(|finding| finding.severity == Severity::Warning);
    warnings.map(|finding| finding.seen.as_str()).collect()
}

#[test]
fn what_came_before_a_failure_is_judged() {
    let log = format!("(1.000000) {FRAME}rubbish\n(1.010000) {FRAME}(1.0");
    let failing = || log.as_bytes().chain(Failing);
    let (report, failure) = judge_readable(failing(), &LogOptions::default(), |_| {}).expect("frames");
    assert_eq!(report.frames, 2);
    let found = warnings(&report);
    assert!(found.len() == 2 && found[1].starts_with("cannot read on after line 3: "), "{found:?}");
    assert_eq!(
        failure.map(|failure| (failure.line, failure.source.kind())),
        Some((3, io::ErrorKind::TimedOut))
    );
    // Who asks for a verdict on all of it gets none.
    let error = judge_log(failing(), &LogOptions::default(), |_| {}).expect_err("it fails");
    assert!(matches!(&error, LogError::Read(read) if read.line == 3), "{error}");
    assert_eq!(error.source().map(ToString::to_string), Some(error.to_string()));
    let empty = judge_log(&b""[..], &LogOptions::default(), |_| {}).expect_err("no frame");
    assert!(empty.source().is_none(), "{empty}");
    // Nothing that could be judged.
    let error = judge_readable(b"rubbish\n".chain(Failing), &LogOptions::default(), |_| {}).map(|_| ());
    assert!(matches!(error, Err(LogError::Read(read)) if read.line == 1));
    let (report, failure) = judge_readable(log.as_bytes(), &LogOptions::default(), |_| {}).expect("frames");
    assert!(failure.is_none() && warnings(&report).len() == 2, "{report:?}");
}

#[test]
fn a_log_in_which_no_time_passes_is_reported() {
    let log = |frames: usize, last: &str| format!("(1.000000) {FRAME}").repeat(frames) + last;
    for (log, says) in [
        (log(100, ""), None),
        (log(101, ""), Some("no time passes in 101 frames, ")),
        (log(101, &format!("(1.000001) {FRAME}")), None),
        (format!("(1.000002) {FRAME}") + &log(101, ""), Some("no time passes in 102 frames, ")),
    ] {
        let report = judge_log(log.as_bytes(), &LogOptions::default(), |_| {}).expect("frames");
        let warnings = warnings(&report);
        assert_eq!(warnings.len(), usize::from(says.is_some()), "{warnings:?}");
        assert!(warnings.iter().zip(says).all(|(warnings, says)| warnings.starts_with(says)), "{warnings:?}");
    }
}

/// A frame of 520h with this AS state on a live bus.
fn heard(judge: &mut LogJudge, ms: i64, state: u8) {
    let (kind, time_ns) = (FrameKind::Standard, (1000 + ms) * 1_000_000);
    let data = &[0, 0, state, 0, 0, 0, 0, 0];
    judge.frame(&Record {
        line: 0,
        time_ns,
        interface: "can0",
        kind,
        id: Vcu2AiStatus::ID.into(),
        data,
        direction: None,
        terminated: true,
    });
}

#[test]
fn the_judge_of_a_live_bus_reports_news_as_time_passes() {
    let mut judge = LogJudge::new(LogOptions::default());
    // Before the first frame there is nothing to wait for.
    judge.time_passes(5_000_000_000);
    heard(&mut judge, 0, 1);
    heard(&mut judge, 10, 2);
    assert_eq!(judge.news().0.len(), 0);
    judge.time_passes(1_100_000_000);
    assert_eq!((judge.news().0.len(), judge.news().0.len()), (1, 0));
    judge.lost(3);
    heard(&mut judge, 120, 2);
    let report = judge.finish(0).expect("frames");
    assert_eq!((report.frames, report.duration_ns, report.transitions.len()), (3, 120_000_000, 1));
    let warnings = warnings(&report);
    assert!(warnings.len() == 1 && warnings[0].starts_with("3 frames lost here, "), "{warnings:?}");
}
