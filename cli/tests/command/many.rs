//! `adsdv check` of several logs: the worst first, the status of the worst, and what it writes for programs and CI.

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::run::{FINISHED_WHILE_MOVING, MISSION, Outcome, run, workspace};
use crate::schema::validator;

/// A folder with two logs, one that violates and one that conforms, beside a file that is none.
fn season(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let inner = folder.join("sub");
    fs::create_dir_all(&inner).expect("it can be made");
    for (log, to) in [(MISSION, folder.join("a.log")), (FINISHED_WHILE_MOVING, inner.join("b.log"))] {
        fs::copy(workspace().join(log), to).expect("it can be copied");
    }
    fs::write(inner.join("README.txt"), "no log").expect("it can be written");
    fs::write(folder.join(".hidden"), "(1.0) can0 520#00").expect("it can be written");
    folder
}

fn text(path: &Path) -> &str {
    path.to_str().expect("a path of text")
}

#[test]
fn the_worst_comes_first_with_its_report_and_its_status() {
    let Outcome { status, stdout, stderr } = run(&["check", MISSION, FINISHED_WHILE_MOVING, MISSION]);
    assert_eq!((status, stderr.as_str()), (Some(1), ""));
    let lines: Vec<&str> = stdout.lines().collect();
    assert_eq!(lines[0], "3 logs: 1 violating, 2 conforming");
    assert_eq!(lines[2], "verdict     violations  warnings   duration  log");
    assert_eq!(lines[3], "violates             2         0   26.000 s  tests/logs/finished-while-moving.log");
    assert!(lines[4].starts_with("            AI finished-while-moving at 13.010 s: "), "{}", lines[4]);
    assert_eq!(lines[5], "conforms             0         0   25.996 s  tests/logs/mission.log");
    assert_eq!(lines[5], lines[6]);
    // What follows is the report of the worst, as that log alone has it.
    let alone = run(&["check", FINISHED_WHILE_MOVING]).stdout;
    assert!(stdout.ends_with(&format!("\nTHE WORST\n{alone}\n")), "{stdout}");
    // Of logs without fault no report is needed.
    let Outcome { status, stdout, .. } = run(&["check", MISSION, MISSION]);
    assert!(status == Some(0) && !stdout.contains("TIMELINE"), "{stdout}");
}

#[test]
fn a_log_that_cannot_be_read_is_the_worst_and_hides_no_other() {
    let Outcome { status, stdout, stderr } = run(&["check", MISSION, "no-such.log", FINISHED_WHILE_MOVING]);
    assert_eq!((status, stderr.as_str()), (Some(2), ""));
    assert!(stdout.starts_with("3 logs: 1 unreadable, 1 violating, 1 conforming\n"), "{stdout}");
    let unreadable =
        "unreadable           0         0    0.000 s  no-such.log\n            cannot open the log: ";
    assert!(stdout.contains(unreadable), "{stdout}");
    assert!(
        stdout.contains("\nTHE WORST\nedition ") && stdout.contains("finished-while-moving.log: violates")
    );
}

#[test]
fn a_directory_is_all_the_logs_in_it_and_a_pattern_those_that_match() {
    let folder = season("many-folder");
    let Outcome { status, stdout, .. } = run(&["check", text(&folder)]);
    assert_eq!(status, Some(1));
    assert!(
        stdout.starts_with("2 logs: 1 violating, 1 conforming\n1 file without a frame passed over\n"),
        "{stdout}"
    );
    assert!(stdout.contains("b.log\n") && !stdout.contains(".hidden"), "{stdout}");
    // As a shell of Windows gives it: not replaced by the files.
    let Outcome { status, stdout, .. } = run(&["check", &format!("{}/*.log", text(&folder))]);
    assert!(status == Some(0) && stdout.contains("a.log") && !stdout.contains("b.log"), "{stdout}");
    let refused = run(&["check", &format!("{}/*.blf", text(&folder))]);
    assert!(refused.status == Some(2) && refused.stderr.contains("nothing matches"), "{}", refused.stderr);
}

#[test]
fn a_program_gets_a_line_for_each_log_in_their_order() {
    let args = ["check", "--json", FINISHED_WHILE_MOVING, "no-such.log", MISSION];
    let Outcome { status, stdout, stderr } = run(&args);
    assert_eq!((status, stderr.as_str()), (Some(2), ""));
    let lines: Vec<Value> = stdout.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect();
    let logs: Vec<&str> = lines.iter().map(|line| line["log"].as_str().expect("a name")).collect();
    assert_eq!(logs, [FINISHED_WHILE_MOVING, "no-such.log", MISSION]);
    let (of_line, of_report) = (validator("logs"), validator("check"));
    for line in &lines {
        assert!(of_line.is_valid(line), "{line}");
        assert_eq!(of_report.is_valid(line), line.get("error").is_none(), "{line}");
    }
    assert!(!of_line.is_valid(&serde_json::json!({ "schema": 1, "log": "a.log" })));
    // But for the name it is what that log alone gives.
    let alone: Value = serde_json::from_str(&run(&["check", "--json", MISSION]).stdout).expect("JSON");
    let mut last = lines[2].clone();
    last.as_object_mut().map(|line| line.remove("log"));
    assert_eq!(last, alone);
}

#[test]
fn a_ci_gets_a_suite_for_each_log_and_a_summary() {
    let folder = season("many-ci");
    let (junit, summary) = (folder.join("check.xml"), folder.join("check.md"));
    let files = ["--junit", text(&junit), "--summary", text(&summary)];
    let of = |logs: &[&str]| {
        let status = run(&[&["check"], &files[..], logs].concat()).status;
        let read = |file: &Path| fs::read_to_string(file).expect("it was written");
        (status, read(&junit), read(&summary))
    };
    let (status, xml, markdown) = of(&[MISSION, FINISHED_WHILE_MOVING, "no-such.log"]);
    assert_eq!(status, Some(2));
    assert_eq!(xml.matches("<testsuite ").count(), 3, "{xml}");
    assert!(
        xml.contains(r#"failures="3" errors="0""#) && xml.contains(r#"name="finished-while-moving""#),
        "{xml}"
    );
    assert!(
        markdown.starts_with("## adsdv check: 3 logs: 1 unreadable, 1 violating, 1 conforming\n"),
        "{markdown}"
    );
    assert!(markdown.contains("| violates | 2 | 0 | 26.000 s | 4.0 | "), "{markdown}");
    // One alone gives them as well.
    let (status, xml, markdown) = of(&[MISSION]);
    assert_eq!((status, xml.matches("<testsuite ").count()), (Some(0), 1));
    assert!(xml.contains(r#"failures="0""#) && markdown.contains("1 log: 1 conforming"), "{xml}\n{markdown}");
    let refused = run(&["check", "--junit", "no-such-folder/x.xml", MISSION, MISSION]);
    assert!(refused.status == Some(2) && refused.stderr.contains("--junit"), "{}", refused.stderr);
}

#[test]
fn what_is_of_one_log_is_refused_of_several() {
    let refused = |args: &[&str], words: &str| {
        let Outcome { status, stdout, stderr } = run(&[&["check"], args].concat());
        assert_eq!((status, stdout.as_str()), (Some(2), ""), "{args:?}");
        assert!(stderr.contains(words), "{stderr}");
    };
    refused(&["--excerpt", "no-such-folder", MISSION, MISSION], "--excerpt: writes the excerpts of one log");
    refused(&["-", MISSION], "-: standard input is judged alone");
}
