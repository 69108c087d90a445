//! What the judge says: the state, what blocks the arrows, and the findings.

use std::fmt::Write as _;
use std::fs;
use std::io::Cursor;

use adsdv_decode::{Catalog, Options};
use adsdv_oracle::judge::{Report, Severity};
use adsdv_oracle::log::{LogOptions, judge_recognised};
use adsdv_spec::Edition;

use super::read::{Contents, contents, written};
use crate::frames::catalog;

/// A recorded run.
pub(super) fn run(name: &str) -> String {
    let file = format!("{}/../tests/logs/{name}", env!("CARGO_MANIFEST_DIR"));
    fs::read_to_string(file).expect("a log of the repository")
}

/// A recorded run as MCAP, and the report of `adsdv check`.
fn judged(log: &str) -> (Contents, Report) {
    let opened = || adsdv_formats::open(Cursor::new(log.to_owned())).expect("a log");
    let judged = judge_recognised(opened(), &LogOptions::default(), |_| {}).expect("a report");
    let catalog = Catalog::of(judged.recognised.edition);
    let (file, _, _) = written(log, &catalog, &Options::default());
    (Contents::of(&file), judged.report)
}

#[test]
fn the_findings_are_those_of_check() {
    for name in ["mission.log", "finished-while-moving.log"] {
        let mut log = run(name);
        log.push_str("rubbish\nDROPCOUNT: dropped 3 CAN frames on 'vcan0' socket (total drops 3)\n(1795210300.0) can7 520#00\n");
        let (contents, report) = judged(&log);
        let first =
            log.get(1..18).and_then(|time| time.replace('.', "").parse::<i64>().ok()).expect("a time") * 1000;
        let mut expected: Vec<_> = report
            .findings
            .iter()
            .map(|finding| {
                let level = match finding.severity {
                    Severity::Note => 2,
                    Severity::Warning => 3,
                    Severity::Violation => 4,
                };
                let message = format!("{} [{}, {}]", finding.message(), finding.rule.id(), finding.section);
                (first + finding.t_ns, level, finding.party.name().to_owned(), message)
            })
            .collect();
        let mut found: Vec<_> = contents
            .on("/adsdv/findings")
            .map(|said| {
                let text = |key: &str| said.says[key].as_str().expect("text").to_owned();
                let time = i64::try_from(said.time).expect("a time");
                let stamp = &said.says["timestamp"];
                assert_eq!(
                    stamp["sec"]
                        .as_i64()
                        .map(|sec| sec * 1_000_000_000 + stamp["nsec"].as_i64().unwrap_or(-1)),
                    Some(time)
                );
                (time, said.says["level"].as_i64().expect("a level"), text("name"), text("message"))
            })
            .collect();
        expected.sort();
        found.sort();
        assert_eq!(found, expected);
        assert!(found.len() > 6, "{found:#?}");
    }
}

#[test]
fn the_state_is_said_when_it_changes_and_each_second_up_to_the_end() {
    let (contents, report) = judged(&run("mission.log"));
    let said: Vec<_> = contents.on("/adsdv/as_state").collect();
    let mut states: Vec<_> = said.iter().map(|said| said.says["state"].as_str().expect("text")).collect();
    assert!(said.iter().zip(said.iter().skip(1)).all(|(one, next)| next.time - one.time <= 1_010_000_000));
    let lasts = said.last().zip(said.first()).map(|(last, first)| last.time - first.time);
    assert_eq!(lasts, u64::try_from(report.duration_ns).ok());
    states.dedup();
    assert_eq!(states, ["AS_OFF", "AS_READY", "AS_DRIVING", "AS_FINISHED", "AS_OFF"]);
    for (transition, state) in report.transitions.iter().zip(states.iter().skip(1)) {
        let since = |said: &&super::read::Said| {
            said.says["state"] == **state && said.says["since"]["sec"].as_u64() > Some(1_795_209_995)
        };
        let since = said.iter().copied().find(since).map(|said| &said.says["since"]).expect("that state");
        let time =
            since["sec"].as_i64().zip(since["nsec"].as_i64()).map(|(sec, nsec)| sec * 1_000_000_000 + nsec);
        assert_eq!(time, Some(1_795_209_995_234_358_000 + transition.t_ns));
    }
}

#[test]
fn what_blocks_an_arrow_is_said_in_words() {
    let mut log = String::new();
    for frame in 0..50 {
        let _ = writeln!(log, "(1.{:03}000) can0 520#0000010000000000", frame * 10);
    }
    let contents = contents(&log, &catalog(&Edition::V2026));
    let last = &contents.on("/adsdv/blocked").last().expect("it is said").says;
    assert_eq!(last["state"], "AS_OFF");
    let ready = &last["AS_OFF_to_AS_READY"];
    assert_eq!(
        (&ready["blocked"], &ready["asms"], &ready["ebs_armed"]),
        (&"true".into(), &"false".into(), &"unknown".into())
    );
    assert!(ready["by"].as_str().is_some_and(|by| by.starts_with("AS master switch ON, ")), "{ready}");
    assert_eq!(last["AS_READY_to_AS_DRIVING"]["blocked"], "unknown");
}

#[test]
fn times_go_on_where_the_clock_is_set_back() {
    let mut log = "(100.0) can0 520#0000010000000000\n(100.01) can0 520#0000010000000000\n".to_owned();
    for frame in 0..100 {
        let _ = writeln!(log, "(50.{:02}) can0 520#00000{}0000000000", frame, 1 + u8::from(frame == 90));
    }
    let contents = contents(&log, &catalog(&Edition::V2026));
    let last = contents.on("/adsdv/as_state").last().expect("it is said");
    assert_eq!((last.time, last.says["state"].as_str()), (50_990_000_000, Some("AS_OFF")));
    assert_eq!(last.says["since"]["sec"], 50);
    assert!(contents.on("/adsdv/findings").any(|said| said.says["rule"] == "time-backwards"));
}
