//! The reports of the recorded logs against the files in `golden/`: a change of the judge or of the text shows as a
//! change of a file that people read. `UPDATE_EXPECT=1 cargo test -p adsdv --test command` writes them anew.

use expect_test::expect_file;

use crate::run::{FINISHED_WHILE_MOVING, MISSION, run};

fn compare(file: &str, args: &[&str]) {
    compare_text(file, &run(args).stdout);
}

/// Compares what a command has printed with a file in `golden/`.
pub(crate) fn compare_text(file: &str, report: &str) {
    expect_file![format!("../golden/{file}")].assert_eq(report);
}

#[test]
fn mission() {
    compare("mission.txt", &["check", "--edition", "3.0", MISSION]);
}

#[test]
fn mission_by_the_edition_that_it_speaks() {
    compare("mission-recognised.txt", &["check", MISSION]);
}

#[test]
fn finished_while_moving() {
    compare("finished-while-moving.txt", &["check", "--edition", "3.0", FINISHED_WHILE_MOVING]);
}

#[test]
fn finished_while_moving_by_the_edition_that_it_speaks() {
    compare("finished-while-moving-recognised.txt", &["check", FINISHED_WHILE_MOVING]);
}

#[test]
fn with_readings_pinned() {
    let args = [
        "check",
        "--edition",
        "3.0",
        "--reading",
        "fault-trigger=edge",
        "--window",
        "20",
        FINISHED_WHILE_MOVING,
    ];
    compare("finished-while-moving-edge.txt", &args);
}
