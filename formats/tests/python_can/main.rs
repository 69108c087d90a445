//! What python-can writes is read to the frames that it was given: `write.py` writes some of every kind with each of its writers.
//!
//! `ADSDV_PYTHON` names an interpreter that has python-can, such as that of a virtual environment. Without it this test says so and
//! passes, unless `ADSDV_REQUIRE_PYTHON_CAN=1` is set.

mod reference;

use std::env;
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::Command;

use adsdv_formats::{Entries, Entry, Format, open};
use reference::{Keeps, Reference};

/// What a writer makes of frames.
struct Tool {
    /// Its file, `run.` and this.
    name: &'static str,
    format: Format,
    keeps: Keeps,
}

/// Every writer of `write.py`.
const TOOLS: [Tool; 4] = [
    Tool {
        name: "asc",
        format: Format::Asc,
        keeps: Keeps { start_ns: 1_000_000, error_data: false, error_direction: false, ..Keeps::ALL },
    },
    Tool { name: "trc", format: Format::Trc, keeps: Keeps { start_ns: 2_000, ..Keeps::CLASSIC_DATA } },
    Tool {
        name: "1-0.trc",
        format: Format::Trc,
        keeps: Keeps {
            start_ns: i64::MAX,
            step_ns: 1_000_000,
            direction: false,
            channel: Some("1"),
            ..Keeps::CLASSIC_DATA
        },
    },
    Tool {
        name: "csv",
        format: Format::Csv,
        keeps: Keeps { direction: false, channel: Some("can"), fd_is_marked: false, ..Keeps::ALL },
    },
];

/// The directory with what python-can wrote; `None` where there is no python-can.
fn written() -> Option<PathBuf> {
    let Some(python) = env::var_os("ADSDV_PYTHON") else {
        let required = env::var_os("ADSDV_REQUIRE_PYTHON_CAN").is_some_and(|value| value == "1");
        assert!(!required, "ADSDV_PYTHON has to name an interpreter that has python-can");
        eprintln!("skipped: ADSDV_PYTHON names no interpreter that has python-can");
        return None;
    };
    let directory = Path::new(env!("CARGO_TARGET_TMPDIR")).join("python_can");
    fs::create_dir_all(&directory).expect("the directory of the build can be written");
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/python_can/write.py");
    let output = Command::new(&python).arg(script).arg(&directory).output();
    let output = output.unwrap_or_else(|error| panic!("cannot run {}: {error}", python.display()));
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    Some(directory)
}

#[test]
fn what_python_can_writes_is_read_to_the_frames_that_it_was_given() {
    let Some(directory) = written() else { return };
    let text = fs::read_to_string(directory.join("reference.jsonl")).expect("the reference was written");
    let frames: Vec<Reference> = text.lines().map(Reference::read).collect();
    assert!(frames.len() > 500);
    for Tool { name, format, keeps } in TOOLS {
        let file = File::open(directory.join(format!("run.{name}"))).expect("the file was written");
        let mut log = open(file).expect("the file is known");
        assert_eq!(log.format(), format, "{name}");
        let mut expected = frames.iter().filter(|frame| keeps.has(frame));
        // Time of the first frame: as it was, and as it is read.
        let mut first = None;
        let mut count = 0;
        while let Some(entry) = log.next_entry().expect("the file can be read") {
            let Entry::Frame(record) = entry else { panic!("{name}: {entry:?}") };
            let frame =
                expected.next().unwrap_or_else(|| panic!("{name}: there is one frame more: {record:?}"));
            keeps.compare(name, frame, &record);
            let (was, is) = *first.get_or_insert((frame.time_ns, record.time_ns));
            let off = (record.time_ns - is) - (frame.time_ns - was);
            assert!(off.abs() <= keeps.step_ns, "{name}: {record:?} is {off} ns off {frame:?}");
            count += 1;
        }
        assert!(expected.next().is_none(), "{name}: only {count} frames are read");
        assert!(count > 200, "{name}: {count}");
        let (was, is) = first.expect("there is a frame");
        assert!(is.abs_diff(was) <= keeps.start_ns.unsigned_abs(), "{name} starts at {is}, not {was}");
    }
}
