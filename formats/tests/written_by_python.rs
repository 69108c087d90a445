//! What python-can writes as BLF, and the Python library of MCAP as that, is read frame by frame.
//!
//! `ADSDV_PYTHON` names a Python that has the packages `python-can` and `mcap`. Without it the comparison is passed over, and fails where
//! `ADSDV_REQUIRE_PYTHON_CAN=1` asks for it.

use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::Command;

use adsdv_formats::{Entries as _, Entry, open};
use adsdv_oracle::candump::{Direction, FrameKind, Record};

/// The folder of what Python wrote.
fn written(name: &str) -> Option<PathBuf> {
    let Some(python) = std::env::var_os("ADSDV_PYTHON") else {
        assert!(
            std::env::var_os("ADSDV_REQUIRE_PYTHON_CAN").is_none_or(|value| value != "1"),
            "ADSDV_PYTHON is not set"
        );
        eprintln!("skipped: ADSDV_PYTHON names no Python with python-can and mcap");
        return None;
    };
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    fs::create_dir_all(&folder).expect("a folder for what Python writes");
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/written_by_python/write.py");
    let status = Command::new(python).arg(script).arg(&folder).status().expect("ADSDV_PYTHON runs");
    assert!(status.success(), "the script has written its files");
    Some(folder)
}

/// A value of a line of JSON as the script writes it: flat, and without a comma in a value.
fn value<'a>(line: &'a str, key: &str) -> &'a str {
    let (_, behind) = line.split_once(&format!("\"{key}\": ")).expect("the script writes each key");
    behind.split([',', '}']).next().unwrap_or_default().trim_matches('"')
}

/// What a frame is, in the words of the script.
struct Expected<'a>(&'a str);

impl Expected<'_> {
    fn number(&self, key: &str) -> i64 {
        value(self.0, key).parse().expect("a number")
    }

    fn is(&self, key: &str) -> bool {
        value(self.0, key) == "true"
    }

    fn kind(&self, fd_flags: bool) -> FrameKind {
        let extended = self.is("extended");
        let number = |key| u8::try_from(self.number(key)).expect("a small number");
        match value(self.0, "kind") {
            "standard" => FrameKind::Standard,
            "extended" => FrameKind::Extended,
            "remote" => FrameKind::Remote { extended, len: number("len") },
            "error" => FrameKind::Error,
            _ => FrameKind::Fd { extended, flags: if fd_flags { number("flags") } else { 0 } },
        }
    }

    fn compare(&self, record: &Record<'_>, fd_flags: bool, nearly_ns: i64) {
        let data: Vec<String> = record.data.iter().map(|byte| format!("{byte:02x}")).collect();
        assert_eq!(
            (record.kind, i64::from(record.id)),
            (self.kind(fd_flags), self.number("id")),
            "{}",
            self.0
        );
        assert_eq!(data.concat(), value(self.0, "data"), "{}", self.0);
        let late = record.time_ns - self.number("time_ns");
        assert!(late.abs() <= nearly_ns, "{late} ns late: {}", self.0);
    }
}

fn compare(file: &Path, mut also: impl FnMut(&Expected<'_>, &Record<'_>)) {
    let lines = fs::read_to_string(file.with_file_name("frames.jsonl")).expect("what the script wrote");
    let mut lines = lines.lines();
    let mut log = open(File::open(file).expect("it was written")).expect("it can be read");
    let mut count = 0;
    while let Some(entry) = log.next_entry().expect("it can be read on") {
        let Entry::Frame(record) = entry else { panic!("{}: {entry:?}", file.display()) };
        also(&Expected(lines.next().expect("no more frames than were written")), &record);
        count += 1;
    }
    assert_eq!((count, lines.next()), (300, None), "{}", file.display());
}

#[test]
fn blf_of_python_can_is_read_frame_by_frame() {
    let Some(folder) = written("blf") else { return };
    for level in ["-1", "0", "1", "9"] {
        compare(&folder.join(format!("level{level}.blf")), |expected, record| {
            // python-can has times in floating point, with a grain of 240 ns in this century.
            expected.compare(record, true, 500);
            assert_eq!(record.interface, format!("can{}", expected.number("channel")));
            let sent = if expected.is("tx") { Direction::Tx } else { Direction::Rx };
            assert_eq!(record.direction, (record.kind != FrameKind::Error).then_some(sent));
        });
    }
}

#[cfg(feature = "mcap")]
#[test]
fn mcap_of_python_is_read_frame_by_frame() {
    let Some(folder) = written("mcap") else { return };
    for name in ["zstd", "lz4", "none", "ros1", "bare", "unchunked"] {
        compare(&folder.join(format!("{name}.mcap")), |expected, record| {
            expected.compare(record, false, 0);
            assert_eq!(record.interface, format!("/can{}", expected.number("channel")));
            assert_eq!(record.direction, Some(if expected.is("tx") { Direction::Tx } else { Direction::Rx }));
        });
    }
}
