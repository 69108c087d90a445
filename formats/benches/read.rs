//! How fast recordings are read, format by format: the same frames in each.
//!
//! ```text
//! cargo bench -p adsdv-formats
//! ```
//!
//! The throughput shown is in frames ("item/s") and in bytes of the file. The frames are those of a recorded log, repeated with their time
//! going on, and are held in memory as the tools would write them.

use std::fmt::Write as _;
use std::fs;
use std::hint::black_box;
use std::io::Cursor;
use std::path::Path;

use adsdv_formats::{Entries, Entry, Format, open};
use divan::Bencher;
use divan::counter::{BytesCount, ItemsCount};

/// How many frames a recording has.
const FRAMES: usize = 200_000;
/// The formats of text. Of the binary ones `examples/speed.rs` times files that other tools have written.
const TEXT: [Format; 5] = [Format::Candump, Format::Asc, Format::Trc, Format::Csv, Format::SavvyCan];
/// Between the end of the log and the beginning of its repetition.
const GAP_NS: i64 = 10_000_000;

fn main() {
    divan::main();
}

/// From the bytes of a recording to frames.
#[divan::bench(args = TEXT)]
fn read(bencher: Bencher, format: Format) {
    let text: &'static [u8] = written(format).leak();
    bencher.counter(ItemsCount::new(FRAMES)).counter(BytesCount::of_slice(text)).bench(|| {
        let mut log = open(Cursor::new(black_box(text))).expect("memory can be read");
        assert_eq!(log.format(), format);
        let mut count = 0;
        while let Some(Entry::Frame(record)) = log.next_entry().expect("memory can be read") {
            black_box(&record);
            count += 1;
        }
        assert_eq!(count, FRAMES, "every line is a frame");
    });
}

struct Frame {
    time_ns: i64,
    id: u32,
    data: Vec<u8>,
}

/// The frames of the recorded log, repeated.
fn frames() -> Vec<Frame> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/logs/mission.log");
    let file =
        fs::File::open(&path).unwrap_or_else(|error| panic!("cannot read {}: {error}", path.display()));
    let mut log = open(file).expect("it is a recording");
    let mut frames = Vec::new();
    while let Some(Entry::Frame(record)) = log.next_entry().expect("the file can be read") {
        frames.push(Frame { time_ns: record.time_ns, id: record.id, data: record.data.to_vec() });
    }
    let span = frames.last().map_or(0, |last| last.time_ns) - frames.first().map_or(0, |first| first.time_ns);
    let repeated = (0..).flat_map(|copy| {
        frames.iter().map(move |frame| Frame {
            time_ns: frame.time_ns + copy * (span + GAP_NS),
            id: frame.id,
            data: frame.data.clone(),
        })
    });
    repeated.take(FRAMES).collect()
}

/// The recording in a format.
fn written(format: Format) -> Vec<u8> {
    let frames = frames();
    let start = frames.first().map_or(0, |frame| frame.time_ns);
    let mut text = String::from(match format {
        Format::Candump => "",
        Format::Asc => {
            "date Fri Nov 20 21:26:35.234 2026\nbase hex  timestamps absolute\ninternal events logged\n"
        }
        Format::Trc => ";$FILEVERSION=2.1\n;$STARTTIME=46346.893463360626\n;$COLUMNS=N,O,T,B,I,d,R,L,D\n",
        Format::Blf | Format::Mcap => unreachable!("not of text"),
        Format::Csv => "timestamp,arbitration_id,extended,remote,error,dlc,data\n",
        Format::SavvyCan => "Time Stamp,ID,Extended,Dir,Bus,LEN,D1,D2,D3,D4,D5,D6,D7,D8\n",
    });
    for (number, Frame { time_ns, id, data }) in frames.iter().enumerate() {
        let (seconds, micros) = (time_ns / 1_000_000_000, time_ns % 1_000_000_000 / 1_000);
        let (since, len) = ((time_ns - start) / 1_000, data.len());
        let bytes = |gap| hex(data, gap);
        let (whole, part) = (since / 1_000_000, since % 1_000_000);
        let done = match format {
            Format::Candump => writeln!(text, "({seconds:010}.{micros:06}) vcan0 {id:03X}#{}", bytes("")),
            Format::Asc => {
                writeln!(text, " {whole}.{part:06} 1  {id:<15X} Rx   d {len:x} {}", bytes(" "))
            }
            Format::Trc => {
                let (whole, part) = (since / 1_000, since % 1_000);
                writeln!(
                    text,
                    "{number:>7} {whole:>9}.{part:03} DT  1     {id:04X} Rx -  {len:<4} {}",
                    bytes(" ")
                )
            }
            Format::Blf | Format::Mcap => unreachable!("not of text"),
            Format::Csv => writeln!(text, "{seconds}.{micros:06},0x{id:x},0,0,0,{len},{}", base64(data)),
            Format::SavvyCan => writeln!(text, "{since},{id:08X},false,Rx,0,{len},{},", bytes(",")),
        };
        done.expect("a string can be written");
    }
    text.into_bytes()
}

fn hex(data: &[u8], gap: &str) -> String {
    data.iter().map(|byte| format!("{byte:02X}")).collect::<Vec<_>>().join(gap)
}

fn base64(data: &[u8]) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::new();
    for three in data.chunks(3) {
        let byte = |index| u32::from(three.get(index).copied().unwrap_or(0));
        let word = byte(0) << 16 | byte(1) << 8 | byte(2);
        for place in 0..4 {
            let digit = DIGITS[(word >> (18 - 6 * place) & 63) as usize];
            text.push(if place <= three.len() { char::from(digit) } else { '=' });
        }
    }
    text
}
