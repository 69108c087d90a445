//! Files that are missing, directories, empty, or rubbish: each command that gets one says so.

use std::fs;
use std::os::unix::fs::PermissionsExt as _;

use adsdv_spec::Edition;

use super::{adsdv, check, fed, folder_with, judged, lines, refused, rubbish, run, text};
use crate::run::{MISSION, temporary};

/// The commands that read a file, each with that file last; no CAN interface is needed to be refused one.
const READERS: [(&[&str], &str); 5] = [
    (&["check"], "log"),
    (&["compare", MISSION], "log"),
    (&["demo", "--scenario"], "scenario"),
    (&["vcu", "no-can", "--plain", "--scenario"], "scenario"),
    (&["conform", "--suite"], "suite"),
];

/// The arguments of a command that reads this file.
fn given<'a>(reader: &[&'a str], file: &'a str) -> Vec<&'a str> {
    let program = if reader.contains(&"--suite") { &["--", "cat"][..] } else { &[] };
    [reader, &[file], program].concat()
}

#[test]
pub(super) fn a_missing_file() {
    for (reader, what) in READERS {
        let expected = format!("no-such-file: cannot open the {what}: ");
        refused(&run(&given(reader, "no-such-file")), &expected, "check the path");
    }
    refused(
        &run(&["conform", "--", "no/such/vcu"]),
        "no/such/vcu: cannot start the program: ",
        "check the path",
    );
}

#[test]
pub(super) fn a_missing_folder_for_what_is_written() {
    let demo = run(&["demo", "--log", "no-such-folder/run.log"]);
    refused(&demo, "no-such-folder/run.log: cannot write the log: ", "make the directory first");
    let verify = run(&["verify", "--logs", "no-such-folder"]);
    refused(&verify, "no-such-folder: cannot write counterexamples: ", "make the directory first");
}

#[test]
pub(super) fn a_directory() {
    for (reader, what) in READERS.into_iter().filter(|(reader, _)| *reader != ["check"]) {
        let outcome = run(&given(reader, "tests"));
        refused(&outcome, &format!("tests: is a directory; expected a {what}"), "");
    }
    // A directory may hold logs; this one does not.
    refused(&run(&["check", "docs"]), "docs: has no log; ", "with recordings in it");
    let folder = folder_with("bad-input-logs", "notes.txt", b"not a log\n");
    fs::write(folder.join("run.log"), lines(3)).expect("it is ours");
    let outcome = run(&["check", text(&folder)]);
    assert_eq!((outcome.status, outcome.stderr.as_str()), (Some(0), ""));
    let begins = "1 log: 1 conforming\n1 file without a frame passed over\n";
    assert!(outcome.stdout.starts_with(begins), "{}", outcome.stdout);
    for program in ["./tests", "tests"] {
        let expected = format!("{program}: is a directory; expected a program");
        refused(&run(&["conform", "--", program]), &expected, "the program in it");
    }
    refused(&run(&["demo", "--log", "tests"]), "tests: cannot write the log: ", "name a file in it");
}

#[test]
pub(super) fn an_empty_file() {
    let empty = temporary("bad-input-empty", b"");
    for (reader, expected) in READERS.map(|(reader, _)| reader).iter().zip([
        "the log is empty; expected lines of candump -L, such as ",
        "BAD, ",
        "is no scenario",
        "is no scenario",
        "the suite is empty; expected one test a line",
    ]) {
        refused(&run(&given(reader, text(&empty))), expected, "");
    }
    fs::set_permissions(&empty, fs::Permissions::from_mode(0o755)).expect("it is ours");
    let outcome = run(&["conform", "--", text(&empty)]);
    refused(&outcome, "cannot start the program: ", "start the program by hand");
}

/// A file without any line that can be read.
#[test]
pub(super) fn binary_rubbish() {
    let file = temporary("bad-input-rubbish", &rubbish());
    for (reader, expected) in READERS.map(|(reader, _)| reader).iter().zip([
        ": no readable frame in ",
        ": no readable frame in ",
        ": is no scenario",
        ": is no scenario",
        " lines that are no tests",
    ]) {
        let outcome = run(&given(reader, text(&file)));
        refused(&outcome, expected, "");
        assert!(
            outcome.stderr.contains("line 1") && outcome.stderr.contains("expected "),
            "{}",
            outcome.stderr
        );
        assert!(outcome.stderr.len() < 10_000, "all of it is printed");
    }
}

#[test]
pub(super) fn a_program_that_answers_rubbish() {
    let folder = folder_with("bad-input-program", "answers", &[&b"\xff\x1b[2J"[..], &rubbish()].concat());
    let answers = folder.join("answers");
    let outcome = run(&["conform", "--", "cat", text(&answers)]);
    refused(
        &outcome,
        ": a line that is not UTF-8; expected a JSON object on one line",
        "write answers in UTF-8",
    );
    assert!(outcome.stderr.contains("\n  sent      {\"op\":\"reset\"}"), "{}", outcome.stderr);
    // As a program it is no better.
    fs::set_permissions(&answers, fs::Permissions::from_mode(0o755)).expect("it is ours");
    let outcome = run(&["conform", "--", text(&answers)]);
    refused(&outcome, "cannot start the program: ", "start the program by hand");
}

/// Standard input can be read once, and which of two logs cannot be read is named.
#[test]
pub(super) fn standard_input_for_both_logs() {
    refused(&run(&["compare", "-", "-"]), "- and -: standard input can be read only once", "cat > ");
    refused(&run(&["compare", "no-such-file", MISSION]), "GOOD, no-such-file: cannot open the log: ", "path");
    refused(&run(&["compare", MISSION, "no-such-file"]), "BAD, no-such-file: cannot open the log: ", "path");
    let empty = fed(&mut adsdv(&["compare", "-", MISSION]), |_| Ok(()));
    refused(&empty, "GOOD, standard input: the log is empty", "candump -L");
}

/// What a damaged compressed log, and one that was copied through the wrong program, begin with is known, and named.
#[test]
pub(super) fn logs_in_another_wrapping() {
    refused(&check(b"\x1f\x8b\x08\0rest\n"), ": cannot read it: ", "it is damaged, or was cut off");
    refused(&check(b"SQLite format 3\0"), ": it is an SQLite database, ", "adsdv.check");
    for edition in Edition::ALL {
        // Printed with tabs, as databases are.
        let database = crate::run::run(&["dbc", "--edition", edition.version]).stdout;
        refused(&check(database.as_bytes()), "found \"VERSION ", "it is a CAN database and no recording");
    }
    let wide: Vec<u8> = lines(3).iter().flat_map(|&byte| [byte, 0]).collect();
    judged(&check(&[b"\xff\xfe", &wide[..]].concat()), 3, &["no violations, no warnings"]);
    // The mark of UTF-8 costs nothing: not even the first frame.
    judged(&check(&[b"\xef\xbb\xbf", &lines(3)[..]].concat()), 3, &["no violations, no warnings"]);
    judged(&check(&[b"\xef\xbb\xbf\r\n", &lines(3)[..]].concat()), 3, &["no violations, no warnings"]);
}

/// A recording of each format that was cut off in the middle: what came before is judged, or it says why there is nothing.
#[test]
pub(super) fn a_recording_of_any_format_that_was_cut_off() {
    let samples = crate::run::workspace().join("formats/tests/samples");
    let mut count = 0;
    for file in fs::read_dir(samples).expect("there are samples") {
        let path = file.expect("it can be listed").path();
        let bytes = fs::read(&path).expect("it can be read");
        let outcome = check(&bytes[..bytes.len() / 2]);
        let says = if outcome.status == Some(2) { &outcome.stderr } else { &outcome.stdout };
        assert!(says.contains(" frame") || says.contains("--features"), "{}: {outcome:?}", path.display());
        count += 1;
    }
    assert!(count > 10, "{count}");
}

/// One line that is wrong among good ones is reported with its number; a scenario or a suite of which it is part is not run.
#[test]
pub(super) fn rubbish_between_good_lines() {
    let mission = crate::run::file("can/scenarios/mission.txt");
    let scenario = [&mission[..], b"\xff\xfe\0\n0.5 asms on\n"].concat();
    let outcome =
        fed(&mut adsdv(&["demo", "--scenario", "-"]), |stdin| std::io::Write::write_all(stdin, &scenario));
    refused(&outcome, "standard input: is no scenario", "adsdv demo --help");
    let line = String::from_utf8_lossy(&mission).lines().count() + 1;
    assert!(outcome.stderr.contains(&format!("\nline {line}, column 1: found ")), "{}", outcome.stderr);

    let suite = crate::run::run(&["suite"]).stdout;
    let (first, rest) = suite.split_once('\n').expect("lines");
    let suite = [first.as_bytes(), b"\n\xff\xfe\0\n", rest.as_bytes()].concat();
    let file = temporary("bad-input-suite", &suite);
    let outcome = run(&given(&["conform", "--suite"], text(&file)));
    refused(&outcome, ": a line that is no test", "correct these lines");
    assert!(outcome.stderr.contains("\n  line 2: is not UTF-8; expected a test"), "{}", outcome.stderr);
}
