//! `adsdv decode`: what it prints, where, and what it says of what it cannot.

use std::fs;
use std::io::Write as _;
use std::path::Path;

use crate::run::{MISSION, Outcome, adsdv, fed, file, run, temporary};

/// Runs it on a log that is given as standard input.
fn decoded(args: &[&str], log: &[u8]) -> Outcome {
    fed(adsdv(&["decode", "-"]).args(args), |stdin| stdin.write_all(log))
}

#[test]
fn the_edition_is_recognised_and_every_frame_decoded() {
    let outcome = run(&["decode", "--single-line", MISSION]);
    assert_eq!(outcome.status, Some(0));
    assert!(outcome.stderr.starts_with("note: decoded by version 4.0: "), "{}", outcome.stderr);
    let log = String::from_utf8(file(MISSION)).expect("text");
    assert_eq!(outcome.stdout.lines().count(), log.lines().count());
    for (ours, theirs) in outcome.stdout.lines().zip(log.lines()) {
        let (line, text) = ours.split_once(" :: ").expect("a decoded line");
        assert_eq!(line, theirs);
        assert!(text.ends_with(')') && text.contains('('), "{text}");
    }
}

#[test]
fn the_default_is_a_line_for_each_signal() {
    let outcome = decoded(&["--edition", "2026"], b"(1.000000) can0 513#0A00\n");
    let text = "(0000000001.000000) can0 513#0A00 ::\nAI2VCU_Steer(\n    STEER_REQUEST: 1.0 deg\n)\n";
    assert_eq!((outcome.status, outcome.stdout.as_str(), outcome.stderr.as_str()), (Some(0), text, ""));
}

#[test]
fn a_file_holds_what_standard_output_would() {
    for format in ["text", "csv", "jsonl", "vcd"] {
        let printed = run(&["decode", "--format", format, MISSION]);
        let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("decoded.{format}"));
        let written = run(&["decode", "--format", format, "-o", path.to_str().expect("text"), MISSION]);
        assert_eq!(
            (written.status, written.stdout.as_str(), &written.stderr),
            (Some(0), "", &printed.stderr)
        );
        assert!(printed.stdout == fs::read_to_string(&path).expect("the file is there"), "{format}");
    }
}

#[test]
fn what_was_not_decoded_is_said() {
    let log = b"(1.0) can0 513#0A00\nrubbish\nDROPCOUNT: dropped 3 CAN frames on 'can0' socket (total drops 3)\n(1.1) can0 7FF#\n";
    let outcome = decoded(&["--edition", "2026", "--format", "csv"], log);
    let notes = "\
note: 1 line could not be read; the first: line 2, column 1: found \"rubbish\", expected a time such as (1436509052.249713)
note: 3 frames lost before they were recorded, the log says
note: 1 frame of 2: of no message that is known, or no data frame
";
    assert_eq!((outcome.status, outcome.stderr.as_str()), (Some(0), notes));
    assert_eq!(outcome.stdout.lines().count(), 3);
}

#[test]
fn an_edition_that_is_not_certain_is_said() {
    let outcome = decoded(&[], b"(1.0) can0 513#0A00\n");
    assert_eq!(outcome.status, Some(0));
    let newest = adsdv_spec::Edition::ALL.last().expect("an edition").version;
    let doubt = format!("note: decoded by version {newest}, though 4.0 ");
    assert!(outcome.stderr.starts_with(&doubt), "{}", outcome.stderr);
}

#[test]
fn a_database_of_ones_own_is_decoded_beside_and_the_editions_messages_count() {
    let dbc = temporary("decode-team.dbc", b"BO_ 1312 Mine: 8 T\n SG_ A : 0|8@1+ (1,0) [0|0] \"\" T\nBO_ 2566869221 Big: 2 T\n SG_ B : 7|16@0- (0.5,0) [0|0] \"V\" T\n");
    let dbc = dbc.to_str().expect("text");
    let log = b"(1.0) can0 18FF50E5#FFFE\n(1.0) can0 513#0A00\n";
    let outcome = decoded(&["--edition", "2026", "--single-line", "--dbc", dbc], log);
    assert!(
        outcome.stdout.starts_with("(0000000001.000000) can0 18FF50E5#FFFE :: Big(B: -1.0 V)\n"),
        "{}",
        outcome.stdout
    );
    let note = format!("note: {dbc}: these identifiers are of the edition 2026, which counts: 520\n");
    assert_eq!((outcome.status, outcome.stderr), (Some(0), note));
}

/// Each with what it says, exactly.
#[test]
fn bad_input_is_refused_in_words() {
    let bad = temporary("decode-bad.dbc", b"BO_ 1 M: 8 T\n SG_ A : 0|65@1+ (1,0) [0|0] \"\" T\n");
    let none = temporary("decode-none.dbc", b"(1.0) can0 520#00\n");
    let (bad, none) = (bad.to_str().expect("text"), none.to_str().expect("text"));
    let line =
        "correct that line, or take the message out; python -m cantools dump shows how others read the file";
    let cases: [(&[&str], String); 10] = [
        (
            &["decode", "Cargo.toml"],
            "Cargo.toml: no readable frame in ".to_owned(),
        ),
        (&["decode", "nowhere.log"], "nowhere.log: cannot open the log: No such file or directory (os error 2)\nhint: check the path; - stands for standard input\n".to_owned()),
        (&["decode", "--single-line", "--format", "csv", MISSION], "--single-line: is for text, and --format asks for something else\nhint: leave one of the two options out\n".to_owned()),
        (&["decode", "--layout", "layout.json", MISSION], "--layout: is for MCAP, and --format asks for something else\nhint: add --format mcap, or leave --layout out\n".to_owned()),
        (&["decode", "--format", "mcap", "-o", "nowhere/run.mcap", MISSION], "nowhere/run.mcap: cannot write what was decoded: No such file or directory (os error 2)\nhint: make the directory first, or name another file with --output\n".to_owned()),
        (&["decode", "-o", "nowhere/run.txt", MISSION], "nowhere/run.txt: cannot write what was decoded: No such file or directory (os error 2)\nhint: make the directory first, or name another file with --output\n".to_owned()),
        (&["decode", "--dbc", bad, MISSION], format!("{bad}: line 2: A has 65 bits from bit 0 on, and M has 8 bytes; a float has 32 bits or 64\nhint: {line}\n")),
        (&["decode", "--dbc", none, MISSION], format!("{none}: it has no message: no line begins with BO_\nhint: --dbc takes a CAN database (DBC), such as adsdv dbc prints\n")),
        (&["decode", "--dbc", "nowhere.dbc", MISSION], "nowhere.dbc: cannot read the database: No such file or directory (os error 2)\nhint: check the path\n".to_owned()),
        (&["decode", "--interface", "can7", MISSION], format!("{MISSION}: ")),
    ];
    for (args, expected) in cases {
        let outcome = run(args);
        assert_eq!(outcome.status, Some(2), "{args:?}: {outcome:?}");
        assert!(outcome.stderr.starts_with(&format!("adsdv: {expected}")), "{args:?}: {}", outcome.stderr);
    }
    let unknown = run(&["decode", "--edition", "9", MISSION]);
    assert!(
        unknown.stderr.starts_with("error: invalid value '9' for '--edition <VERSION>'"),
        "{}",
        unknown.stderr
    );
    assert_eq!((unknown.status, unknown.stdout.as_str()), (Some(2), ""));
}

#[test]
fn an_mcap_is_judged_as_the_log_that_it_was_made_of() {
    let folder = emptied("decode-mcap");
    for log in [MISSION, "tests/logs/finished-while-moving.log"] {
        let mcap = folder.join("run.mcap");
        let mcap = mcap.to_str().expect("text");
        let outcome = run(&["decode", "--format", "mcap", "-o", mcap, log]);
        assert_eq!((outcome.status, outcome.stdout.as_str()), (Some(0), ""), "{outcome:?}");
        let (of_log, of_mcap) = (run(&["check", log]), run(&["check", mcap]));
        assert_eq!(of_mcap.stdout, of_log.stdout.replace(log, mcap));
        assert_eq!(of_mcap.status, of_log.status);
        // Through a pipe it is the same, byte for byte.
        let piped = adsdv(&["decode", "--format", "mcap", log]).output().expect("the command starts");
        assert!(piped.stdout == fs::read(mcap).expect("the file is there"));
    }
    assert_eq!(names(&folder), ["run.mcap"]);
}

#[test]
fn a_layout_is_written_beside_the_mcap() {
    let folder = emptied("decode-layout");
    let [mcap, layout] = ["run.mcap", "layout.json"].map(|name| folder.join(name));
    let [mcap, layout] = [&mcap, &layout].map(|file| file.to_str().expect("text"));
    let args = ["decode", "--format", "mcap", "-o", mcap, "--layout", layout, MISSION];
    assert_eq!(run(&args).status, Some(0));
    let text = fs::read_to_string(layout).expect("the file is there");
    let json: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    assert!(json["configById"].is_object());
    let nowhere = run(&["decode", "--format", "mcap", "-o", mcap, "--layout", "nowhere/l.json", MISSION]);
    let says = "adsdv: nowhere/l.json: cannot write what --layout asks for: No such file or directory";
    assert!(nowhere.stderr.starts_with(says), "{}", nowhere.stderr);
    assert_eq!(nowhere.status, Some(2));
}

/// What is there stays as it is until the new file is whole.
#[test]
fn an_mcap_is_whole_or_not_there() {
    let folder = emptied("decode-whole");
    let mcap = folder.join("run.mcap");
    let args =
        ["decode", "--format", "mcap", "--interface", "can7", "-o", mcap.to_str().expect("text"), MISSION];
    assert_eq!(run(&args).status, Some(2));
    assert_eq!(names(&folder), [""; 0]);
    fs::write(&mcap, "before").expect("the folder for tests can be written");
    assert_eq!(run(&args).status, Some(2));
    assert_eq!(fs::read(&mcap).expect("it is there"), b"before");
    assert_eq!(names(&folder), ["run.mcap"]);
}

/// Files that any program may read are made, through links as well.
#[cfg(unix)]
#[test]
fn an_mcap_has_the_permissions_of_any_new_file_and_links_stay() {
    use std::os::unix::fs::{PermissionsExt as _, symlink};
    let folder = emptied("decode-link");
    let [mcap, link, text] = ["run.mcap", "link.mcap", "run.txt"].map(|name| folder.join(name));
    fs::write(&mcap, "before").expect("the folder for tests can be written");
    symlink(&mcap, &link).expect("the folder for tests can be written");
    assert_eq!(
        run(&["decode", "--format", "mcap", "-o", link.to_str().expect("text"), MISSION]).status,
        Some(0)
    );
    assert_eq!(run(&["decode", "-o", text.to_str().expect("text"), MISSION]).status, Some(0));
    assert!(fs::symlink_metadata(&link).expect("it is there").is_symlink());
    let mode = |file: &Path| fs::metadata(file).expect("it is there").permissions().mode();
    assert_eq!(mode(&mcap), mode(&text));
}

#[cfg(unix)]
#[test]
fn what_is_half_written_when_a_signal_ends_it_does_not_stay() {
    use std::os::unix::process::ExitStatusExt as _;
    use std::process::{Command, Stdio};

    let folder = emptied("decode-stopped");
    for (format, table) in [("mcap", None), ("parquet", Some("frames")), ("parquet", Some("messages"))] {
        let output = folder.join("run");
        let mut command = adsdv(&["decode", "--format", format, "-o"]);
        command.arg(&output).arg("-").args(table.map(|table| format!("--table={table}")));
        let mut child = command.stdin(Stdio::piped()).spawn().expect("the command starts");
        // The pipe stays open: there may be more.
        let mut stdin = child.stdin.take().expect("a pipe");
        stdin.write_all(&file(MISSION)).expect("it reads");
        while names(&folder).is_empty() {
            std::thread::sleep(std::time::Duration::from_millis(5));
        }
        // It has a name, and is listened for signals behind that.
        std::thread::sleep(std::time::Duration::from_millis(100));
        let sent = Command::new("kill").args(["-INT", &child.id().to_string()]).status();
        assert!(sent.is_ok_and(|status| status.success()));
        let status = child.wait().expect("it ends");
        assert_eq!(status.signal(), Some(2), "{format} {table:?}");
        assert_eq!(names(&folder), [""; 0], "{format} {table:?}");
    }
}

/// A folder for tests with nothing in it.
fn emptied(name: &str) -> std::path::PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    // It may not be there.
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir(&folder).expect("the folder for tests can be written");
    folder
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("it is there");
    let mut names: Vec<_> =
        entries.map(|entry| entry.expect("it is there").file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_said() {
    let mcap = run(&["decode", "--format", "mcap", "-o", "/dev/full", MISSION]);
    let outcome = run(&["decode", "-o", "/dev/full", MISSION]);
    assert_eq!((mcap.status, &mcap.stderr), (outcome.status, &outcome.stderr));
    let said = "adsdv: /dev/full: cannot write what was decoded: No space left on device (os error 28)\nhint: free some space, or name a file on another disk with --output\n";
    assert_eq!((outcome.status, outcome.stderr.as_str()), (Some(2), said));
}
