//! The reports of the recorded logs against the files in `golden/`: a change of the judge or of the text shows as a
//! change of a file that people read.

use std::{env, fs, path::Path};

use crate::run::{FINISHED_WHILE_MOVING, MISSION, run};

/// Set to 1, it makes these tests write the files instead of comparing them.
const BLESS: &str = "ADSDV_BLESS";

fn compare(file: &str, args: &[&str]) {
    compare_text(file, &run(args).stdout);
}

/// Compares what a command has printed with a file in `golden/`.
pub(crate) fn compare_text(file: &str, report: &str) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden").join(file);
    if env::var_os(BLESS).is_some_and(|value| value == "1") {
        fs::write(&path, report).unwrap_or_else(|error| panic!("cannot write golden/{file}: {error}"));
        return;
    }
    let renew = format!("to renew it: {BLESS}=1 cargo test -p adsdv --test command golden");
    let golden = fs::read_to_string(&path)
        .unwrap_or_else(|error| panic!("cannot read golden/{file}: {error}; {renew}"));
    assert!(golden == report, "the report is not golden/{file}, it is:\n{report}\n{renew}");
}

#[test]
fn mission() {
    compare("mission.txt", &["check", MISSION]);
}

#[test]
fn finished_while_moving() {
    compare("finished-while-moving.txt", &["check", FINISHED_WHILE_MOVING]);
}

#[test]
fn with_readings_pinned() {
    let args = ["check", "--reading", "fault-trigger=edge", "--window", "20", FINISHED_WHILE_MOVING];
    compare("finished-while-moving-edge.txt", &args);
}
