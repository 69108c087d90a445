//! How fast a log is judged: the whole way of `adsdv check`, and its two halves.
//!
//! ```text
//! cargo bench -p adsdv-oracle
//! ```
//!
//! The throughput shown is in frames ("item/s"). The logs are recorded ones, repeated with their time going on, and
//! are held in memory.

use std::fs;
use std::hint::black_box;
use std::path::Path;

use adsdv_oracle::candump::{Entry, Reader, write_frame};
use adsdv_oracle::judge::{Judge, JudgeOptions};
use adsdv_oracle::log::{LogOptions, judge_log};
use divan::Bencher;
use divan::counter::ItemsCount;

/// The recorded logs, in `tests/logs`.
const LOGS: [&str; 2] = ["mission.log", "finished-while-moving.log"];

/// How often a log is repeated: it is then much longer than the processor's caches.
const COPIES: i64 = 20;

/// Between the end of a log and the beginning of its repetition.
const GAP_NS: i64 = 10_000_000;

fn main() {
    divan::main();
}

/// From the text of a log to the report.
#[divan::bench(args = LOGS)]
fn check(bencher: Bencher, name: &str) {
    let frames = repeated(name);
    let text = candump(&frames);
    bencher.counter(ItemsCount::new(frames.len())).bench(|| {
        let report = judge_log(black_box(text.as_slice()), &LogOptions::default(), |_| {});
        assert!(report.as_ref().is_ok_and(|report| report.frames == frames.len() as u64));
        report
    });
}

/// From the text of a log to frames.
#[divan::bench(args = LOGS)]
fn read(bencher: Bencher, name: &str) {
    let frames = repeated(name);
    let text = candump(&frames);
    bencher.counter(ItemsCount::new(frames.len())).bench(|| {
        let mut reader = Reader::new(black_box(text.as_slice()));
        let mut count = 0;
        while let Some(Entry::Frame(record)) = reader.next_record().expect("memory can be read") {
            black_box(&record);
            count += 1;
        }
        assert_eq!(count, frames.len(), "every line is a frame");
    });
}

/// From frames to the report.
#[divan::bench(args = LOGS)]
fn judge(bencher: Bencher, name: &str) {
    let frames = repeated(name);
    bencher.counter(ItemsCount::new(frames.len())).bench(|| {
        let mut judge = Judge::new(JudgeOptions::default());
        for frame in black_box(&frames) {
            judge.frame(frame.time_ns, frame.id, frame.data());
        }
        judge.finish()
    });
}

struct Frame {
    time_ns: i64,
    id: u32,
    bytes: [u8; 8],
    len: u8,
}

impl Frame {
    fn data(&self) -> &[u8] {
        self.bytes.get(..usize::from(self.len)).unwrap_or(&self.bytes)
    }
}

/// The frames of a recorded log, repeated.
fn repeated(name: &str) -> Vec<Frame> {
    let frames = recorded(name);
    let (Some(first), Some(last)) = (frames.first(), frames.last()) else { return frames };
    let span = last.time_ns - first.time_ns + GAP_NS;
    (0..COPIES)
        .flat_map(|copy| {
            frames.iter().map(move |frame| Frame { time_ns: frame.time_ns + copy * span, ..*frame })
        })
        .collect()
}

fn recorded(name: &str) -> Vec<Frame> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/logs").join(name);
    let text = fs::read(&path).unwrap_or_else(|error| panic!("cannot read {}: {error}", path.display()));
    let mut reader = Reader::new(text.as_slice());
    let mut frames = Vec::new();
    while let Some(entry) = reader.next_record().expect("memory can be read") {
        let Entry::Frame(record) = entry else { panic!("{name} has a broken line: {entry:?}") };
        let mut bytes = [0; 8];
        bytes[..record.data.len()].copy_from_slice(record.data);
        frames.push(Frame {
            time_ns: record.time_ns,
            id: record.id,
            bytes,
            len: u8::try_from(record.data.len()).expect("a CAN frame has at most 8 bytes"),
        });
    }
    frames
}

/// The frames as `candump -L` writes them.
fn candump(frames: &[Frame]) -> Vec<u8> {
    let mut text = Vec::new();
    for frame in frames {
        write_frame(&mut text, frame.time_ns, "vcan0", frame.id, frame.data())
            .expect("memory can be written");
    }
    text
}
