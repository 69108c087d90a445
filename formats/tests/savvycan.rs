//! A log of candump and the same frames as SavvyCAN writes them come to the same: frame by frame, and when they are judged.

use std::fmt::Write as _;
use std::fs;
use std::io::Cursor;
use std::path::Path;

use adsdv_formats::{Entries, Entry, Format, Log, open};
use adsdv_oracle::log::{LogOptions, judge_entries};

/// The frames, each with its time, its identifier and its data.
fn frames(mut log: Log) -> Vec<(i64, u32, Vec<u8>)> {
    let mut frames = Vec::new();
    while let Some(entry) = log.next_entry().expect("memory can be read") {
        let Entry::Frame(record) = entry else { panic!("{entry:?}") };
        frames.push((record.time_ns, record.id, record.data.to_vec()));
    }
    frames
}

fn opened(text: &str) -> Log {
    open(Cursor::new(text.to_owned())).expect("it is a recording")
}

#[test]
fn a_log_as_savvycan_writes_it_is_judged_as_the_log_is() {
    for (name, violates) in [("mission", false), ("finished-while-moving", true)] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../tests/logs/{name}.log"));
        let log = fs::read_to_string(&path)
            .unwrap_or_else(|error| panic!("cannot read {}: {error}", path.display()));
        let expected = frames(opened(&log));
        let mut text = String::from("Time Stamp,ID,Extended,Dir,Bus,LEN,D1,D2,D3,D4,D5,D6,D7,D8\n");
        for (time_ns, id, data) in &expected {
            write!(text, "{},{id:08X},false,Rx,0,{},", time_ns / 1000, data.len())
                .expect("a string can be written");
            for byte in data {
                write!(text, "{byte:02X},").expect("a string can be written");
            }
            text.push('\n');
        }
        assert_eq!(opened(&text).format(), Format::SavvyCan);
        assert!(frames(opened(&text)) == expected, "{name}: the frames are others");
        let judged = |text| {
            let (report, _) =
                judge_entries(opened(text), &LogOptions::default(), |_| {}).expect("it is judged");
            (report.verdict(), report.findings, format!("{:?}", report.transitions))
        };
        let (as_it_was, as_csv) = (judged(&log), judged(&text));
        assert_eq!(as_csv, as_it_was, "{name}");
        assert_eq!(as_it_was.1.iter().any(|finding| finding.rule.id() == "finished-while-moving"), violates);
    }
}
