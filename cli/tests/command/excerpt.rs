//! `adsdv check --excerpt`: each file that it writes gives the finding that it is about.

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::run::{FINISHED_WHILE_MOVING, MISSION, Outcome, adsdv, check_input, fed, file, run, temporary};

/// A directory for one test, which is not there yet.
fn directory(name: &str) -> PathBuf {
    let directory = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    // It may be there from an earlier run.
    let _ = fs::remove_dir_all(&directory);
    directory
}

fn text(path: &Path) -> &str {
    path.to_str().expect("text")
}

fn files(directory: &Path) -> Vec<String> {
    let files = fs::read_dir(directory).expect("it is there").map(|file| file.expect("a file").file_name());
    let mut names: Vec<String> = files.map(|name| name.to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

/// The violations and warnings of a log, as rule, party, section and severity.
fn findings(args: &[&str], log: &[u8]) -> Vec<[String; 4]> {
    let outcome = check_input(&[&["--json"], args].concat(), log);
    let report: Value = serde_json::from_str(&outcome.stdout).expect("JSON");
    let findings = report["findings"].as_array().expect("an array").iter();
    let serious = findings.filter(|finding| finding["severity"] != "note");
    let word = |finding: &Value, key: &str| finding[key].as_str().expect("text").to_owned();
    serious.map(|finding| ["rule", "party", "section", "severity"].map(|key| word(finding, key))).collect()
}

/// The finding of each excerpt is one of the log, in order, and one of the excerpt.
fn shown(options: &[&str], edition: &str, log: &[u8], directory: &Path) {
    let by = [options, &["--edition", edition]].concat();
    let all = findings(&by, log);
    let names = files(directory);
    assert_eq!(names.len(), all.len());
    for ((name, finding), number) in names.iter().zip(&all).zip(1..) {
        assert_eq!(*name, format!("{number:02}-{}.log", finding[0]));
        let excerpt = fs::read(directory.join(name)).expect("it is there");
        assert!(findings(&by, &excerpt).contains(finding), "{name} does not show {finding:?}");
        assert!(excerpt.len() * 20 < log.len(), "{name} has {} bytes", excerpt.len());
    }
}

#[test]
fn each_excerpt_gives_its_finding() {
    let (directory, log) = (directory("excerpt-moving"), file(FINISHED_WHILE_MOVING));
    let plain = run(&["check", FINISHED_WHILE_MOVING]);
    let Outcome { status, stdout, stderr } =
        run(&["check", "--excerpt", text(&directory), FINISHED_WHILE_MOVING]);
    assert_eq!((status, stderr.as_str()), (Some(1), ""));
    let excerpts = stdout.strip_prefix(&plain.stdout).expect("the report comes first");
    assert!(
        excerpts.starts_with("\nEXCERPTS\n  2 logs in ") && excerpts.contains("--edition 4.0"),
        "{excerpts}"
    );
    assert!(excerpts.contains("\n  01-finished-while-moving.log      13.010 s, "), "{excerpts}");
    assert!(!excerpts.contains("does not show"), "{excerpts}");
    shown(&[], "4.0", &log, &directory);
}

#[test]
fn standard_input_is_cut_like_the_file() {
    let named = directory("excerpt-named");
    run(&["check", "--excerpt", text(&named), FINISHED_WHILE_MOVING]);
    let given = directory("excerpt-given");
    let args = ["check", "--json", "--excerpt", text(&given), "-"];
    let outcome =
        fed(&mut adsdv(&args), |stdin| std::io::Write::write_all(stdin, &file(FINISHED_WHILE_MOVING)));
    assert_eq!(outcome.stdout, run(&["check", "--json", FINISHED_WHILE_MOVING]).stdout);
    assert!(outcome.stderr.starts_with("\nEXCERPTS\n  2 logs in "), "{}", outcome.stderr);
    assert_eq!(files(&given), files(&named));
    for name in files(&given) {
        assert_eq!(fs::read(given.join(&name)).ok(), fs::read(named.join(&name)).ok(), "{name}");
    }
}

/// Under the options that the whole log was judged by, with a broken line, a silent AI Computer and a value out of range.
#[test]
fn options_and_many_kinds_of_findings() {
    let log = String::from_utf8(file(FINISHED_WHILE_MOVING)).expect("text");
    let mut lines: Vec<String> = log.lines().map(str::to_owned).collect();
    lines.retain(|line| !(line.contains(" 51") && ("(1795210165".."(1795210166").contains(&line.as_str())));
    lines.insert(8000, "rubbish".to_owned());
    lines.insert(20_000, "(1795".to_owned());
    let log = temporary("excerpt-many.log", (lines.join("\n") + "\n").as_bytes());
    let directory = directory("excerpt-many");
    let options = ["--edition", "3.0", "--reading", "fault-trigger=level", "--window", "20"];
    let outcome = run(&[&["check", "--excerpt", text(&directory)], &options[..], &[text(&log)]].concat());
    assert!(!outcome.stdout.contains("does not show"), "{}", outcome.stdout);
    shown(&options[2..], "3.0", &fs::read(&log).expect("it is there"), &directory);
}

#[test]
fn more_than_twenty_are_counted_and_other_files_are_left_alone() {
    let log = file(MISSION);
    let broken: Vec<u8> = log
        .split_inclusive(|&byte| byte == b'\n')
        .enumerate()
        .flat_map(|(place, line)| {
            let rubbish: &[u8] = if place % 1000 == 7 { b"rubbish\n" } else { b"" };
            [rubbish, line].concat()
        })
        .collect();
    let log = temporary("excerpt-rubbish.log", &broken);
    let directory = directory("excerpt-rubbish");
    fs::create_dir_all(directory.join("of-before")).expect("it can be made");
    let outcome = run(&["check", "--excerpt", text(&directory), text(&log)]);
    assert!(outcome.stdout.ends_with("  14 findings more, without an excerpt\n"), "{}", outcome.stdout);
    let names = files(&directory);
    assert_eq!(
        (names.len(), names[19].as_str(), names[20].as_str()),
        (21, "20-broken-line.log", "of-before")
    );
}

#[test]
fn a_log_without_findings_leaves_an_empty_directory() {
    let directory = directory("excerpt-none");
    let outcome = run(&["check", "--excerpt", text(&directory), MISSION]);
    assert_eq!(outcome.status, Some(0));
    assert!(outcome.stdout.contains("\nEXCERPTS\n  no violations, no warnings: nothing was written to "));
    assert_eq!(files(&directory), [""; 0]);
}
