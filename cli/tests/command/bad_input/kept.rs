//! What is read is kept, whatever an option names for what is written.

use std::fs;

use super::{folder_with, refused, run, text};
use crate::run::{MISSION, file};

/// Every option that writes a file, beside a recording that it could replace.
#[test]
pub(super) fn an_answer_in_the_place_of_the_recording() {
    let recording = file(MISSION);
    let folder = folder_with("bad-input-kept", "run.log", &recording);
    let log = folder.join("run.log");
    // The same file by another name.
    let other = folder.join(".").join("run.log");
    let (log, other) = (text(&log), text(&other));
    for option in ["--html", "--junit", "--summary"] {
        let outcome = run(&["check", option, other, log]);
        refused(&outcome, &format!("would replace {log}, which is read; expected another file"), option);
        assert!(outcome.stderr.starts_with(&format!("adsdv: {option} ")), "{}", outcome.stderr);
    }
    refused(&run(&["check", "--junit", log, MISSION, log]), "would replace ", "--junit");
    for options in [&["--output"][..], &["--format", "csv", "--output"], &["--format", "vcd", "--output"]] {
        let arguments = [&["decode"], options, &[other, log]].concat();
        refused(&run(&arguments), &format!("would replace {log}, which is read"), "--output");
    }
    refused(&run(&["decode", "--format", "mcap", "--layout", log, log]), "would replace ", "--layout");
    assert_eq!(fs::read(log).expect("it is there"), recording, "it is as it was");
}

/// A team's own database is read as well.
#[test]
pub(super) fn an_answer_in_the_place_of_a_database() {
    let folder = folder_with("bad-input-kept-dbc", "team.dbc", crate::run::run(&["dbc"]).stdout.as_bytes());
    let database = folder.join("team.dbc");
    let before = fs::read(&database).expect("it is there");
    let outcome = run(&["decode", "--dbc", text(&database), "-o", text(&database), MISSION]);
    refused(&outcome, "would replace ", "--output");
    assert_eq!(fs::read(&database).expect("it is there"), before);
}

/// Where two names change places, the page would replace a recording that is not read at all.
#[test]
pub(super) fn a_page_in_the_place_of_something_else() {
    let recording = file(MISSION);
    let folder = folder_with("bad-input-kept-page", "run.log", &recording);
    let log = folder.join("run.log");
    refused(
        &run(&["check", "--html", text(&log), MISSION]),
        "would replace a file that is no page",
        "such as --html run.html",
    );
    assert_eq!(fs::read(&log).expect("it is there"), recording, "it is as it was");
    // What is empty, or was a page, is replaced.
    for before in ["", "<!DOCTYPE html>\n<title>yesterday</title>"] {
        let page = folder.join("run.html");
        fs::write(&page, before).expect("it is ours");
        let outcome = run(&["check", "--html", text(&page), MISSION]);
        assert_eq!((outcome.status, outcome.stderr.as_str()), (Some(0), ""));
        assert!(fs::metadata(&page).expect("it is there").len() > 100_000);
    }
}
