//! `adsdv compare`: what differs between two recordings, as a person reads it. The files in `golden/` are read by people;
//! `UPDATE_EXPECT=1 cargo test -p adsdv --test command` writes them anew.

use std::path::{Path, PathBuf};

use adsdv_oracle::judge::Rule;
use adsdv_spec::AsState;
use serde_json::{Value, json};

use crate::golden::compare_text;
use crate::run::{FINISHED_WHILE_MOVING, MISSION, Outcome, adsdv, fed, file, run, temporary};
use crate::schema::{Spoil, validator};

/// What is printed of two logs, which has a status, and names them as a person does.
fn compared(args: &[&str], status: i32) -> String {
    let Outcome { status: ended, stdout, stderr } = run(&[&["compare"], args].concat());
    assert_eq!((ended, stderr.as_str()), (Some(status), ""), "{args:?}: {stdout}");
    for line in stdout.lines().filter(|_| !args.contains(&"--json")) {
        assert!(line.chars().count() <= 100, "{line}");
    }
    assert!(args.contains(&"--json") || stdout.lines().count() <= 50, "more than a screen: {stdout}");
    stdout.replace(&format!("{}/", env!("CARGO_TARGET_TMPDIR")), "")
}

/// The mission, of which only some lines are there, each of which may be another.
fn mission(name: &str, mend: impl Fn(usize, &str) -> Option<String>) -> PathBuf {
    let log = String::from_utf8(file(MISSION)).expect("text");
    let lines = log.lines().enumerate().filter_map(|(place, line)| mend(place, line));
    let log: String = lines.flat_map(|line| [line, "\n".to_owned()]).collect();
    temporary(name, log.as_bytes())
}

/// The log of a scenario of an edition.
fn played(name: &str, edition: &str, scenario: &str) -> PathBuf {
    let scenario = temporary(&format!("{name}.txt"), scenario.as_bytes());
    let log = temporary(name, b"");
    let played = run(&["demo", "--edition", edition, "--scenario", text(&scenario), "--log", text(&log)]);
    assert_eq!(played.stderr, "");
    log
}

fn text(path: &Path) -> &str {
    path.to_str().expect("text")
}

#[test]
fn the_two_recordings() {
    compare_text("compare-finished-while-moving.txt", &compared(&[MISSION, FINISHED_WHILE_MOVING], 1));
}

#[test]
fn one_that_ends_before_as_ready() {
    let cut = mission("compare-cut.log", |place, line| (place < 1500).then(|| line.to_owned()));
    compare_text("compare-cut.txt", &compared(&[MISSION, text(&cut)], 1));
}

/// Begun late, and cut: what is in between is compared all the same.
#[test]
fn one_that_begins_later() {
    let late = mission("compare-late.log", |place, line| (place > 9000).then(|| line.to_owned()));
    compare_text("compare-late.txt", &compared(&[MISSION, text(&late)], 1));
}

const READY: &str = "0 ebs ARMED, ami SKIDPAD\n0.5 tsms on, asms on\n";

/// Nobody selects a mission, so that the VCU stays in `AS_OFF`.
#[test]
fn a_silent_ai_computer() {
    let good = played("compare-good.log", "4.0", &format!("{READY}AS_READY +6 go on\nAS_DRIVING +2 end\n"));
    let heard = played("compare-heard.log", "4.0", &format!("{READY}3 end\n"));
    let silent = std::fs::read_to_string(heard).expect("it was written");
    // 120h and 502h show the state as well.
    let others = [" 51", " 502#", " 120#"];
    let lines = silent.lines().filter(|line| others.iter().all(|other| !line.contains(other)));
    let off = |line: &str| {
        let Some(at) = line.find("520#") else { return line.to_owned() };
        // The low half of the third byte is the state.
        format!("{}1{}", &line[..at + 9], &line[at + 10..])
    };
    let silent: String = lines.map(|line| off(line) + "\n").collect();
    let silent = temporary("compare-silent.log", silent.as_bytes());
    compare_text("compare-silent-ai.txt", &compared(&[text(&good), text(&silent)], 1));
}

/// Of another edition, and "Go" came before the five seconds had passed.
#[test]
fn another_edition_and_go_too_early() {
    let good = played("compare-4.log", "4.0", &format!("{READY}AS_READY +6 go on\nAS_DRIVING +2 end\n"));
    let early = played("compare-2026.log", "2026", &format!("{READY}AS_READY +2 go on\n+4 end\n"));
    compare_text("compare-editions.txt", &compared(&[text(&good), text(&early)], 1));
}

/// Half as many requests, of twice the torque, and the operator takes two seconds more.
#[test]
fn other_requests_and_another_cycle() {
    let other = mission("compare-other.log", |place, line| {
        let (head, frame) = line.rsplit_once(' ')?;
        if frame.starts_with("514#") && place % 2 == 0 {
            return None;
        }
        // The torque is two bytes, in tenths of a newton metre.
        let frame = frame.replace("511#2003", "511#4006").replace("526#", "527#");
        let (time, interface) = head.split_once(' ')?;
        let us: u64 = time.trim_matches(['(', ')']).replace('.', "").parse().ok()?;
        let us = if place > 15_000 { us + 2_000_000 } else { us };
        Some(format!("({}.{:06}) {interface} {frame}", us / 1_000_000, us % 1_000_000))
    });
    compare_text("compare-requests.txt", &compared(&[MISSION, text(&other)], 1));
}

#[test]
fn a_recording_and_itself_do_not_differ() {
    for log in [MISSION, FINISHED_WHILE_MOVING] {
        let same = compared(&[log, log], 0);
        assert!(same.ends_with("\n\nnothing that matters differs\n"), "{same}");
        assert_eq!(same.lines().count(), 5, "{same}");
    }
    let shifted = mission("compare-shifted.log", |_, line| {
        let (seconds, rest) = line.split_once('.')?;
        let seconds: u64 = seconds.trim_start_matches('(').parse().ok()?;
        Some(format!("({}.{rest}", seconds + 12_345))
    });
    let shifted = compared(&[MISSION, text(&shifted)], 0);
    assert!(shifted.ends_with("\n\nnothing that matters differs\n"), "{shifted}");
}

#[test]
fn one_of_them_may_be_standard_input() {
    let named = compared(&[MISSION, FINISHED_WHILE_MOVING], 1);
    for (args, log) in [
        (["compare", "-", FINISHED_WHILE_MOVING], MISSION),
        (["compare", MISSION, "-"], FINISHED_WHILE_MOVING),
    ] {
        let given = fed(&mut adsdv(&args), |stdin| std::io::Write::write_all(stdin, &file(log)));
        assert_eq!(given.stdout.replace("standard input: ", &format!("{log}: ")), named);
        assert_eq!(given.status, Some(1));
    }
}

#[test]
fn options_count_for_both() {
    let by = compared(&["--edition", "3.0", MISSION, FINISHED_WHILE_MOVING], 1);
    assert!(by.starts_with("edition 3.0\nGOOD  "), "{by}");
    let interface = run(&["compare", "--interface", "can7", MISSION, MISSION]);
    assert!(
        interface.stderr.starts_with("adsdv: GOOD, tests/logs/mission.log: no data frame"),
        "{}",
        interface.stderr
    );
    let pinned =
        run(&["compare", "--reading", "go-edge=edge", "--reading", "go-edge=seen-low", MISSION, MISSION]);
    assert!(pinned.status == Some(2) && pinned.stderr.contains("is already pinned"), "{}", pinned.stderr);
    let edge = ["--edition", "3.0", "--reading", "fault-trigger=edge", MISSION, FINISHED_WHILE_MOVING];
    assert!(compared(&edge, 1).contains("WHERE THEY PART"));
}

fn json(args: &[&str], status: i32) -> Value {
    let line = compared(&[&["--json"], args].concat(), status);
    assert!(
        line.starts_with("{\"schema\":1,\"good\":{\"edition\":\"") && line.lines().count() == 1,
        "{line}"
    );
    let value: Value = serde_json::from_str(&line).expect("JSON");
    let errors: Vec<_> = validator("compare").iter_errors(&value).map(|error| error.to_string()).collect();
    assert!(errors.is_empty(), "{errors:#?}");
    value
}

#[test]
fn json_keeps_to_its_schema() {
    let differ = json(&[MISSION, FINISHED_WHILE_MOVING], 1);
    assert_eq!(differ["parting"]["state"], "AS_DRIVING");
    let blocked = differ["parting"]["missed"]["blocked"].as_array().and_then(|all| all.last());
    assert_eq!(blocked.map(|last| &last["failed"][0]["message"]), Some(&json!("525h")));
    assert_eq!(differ["findings"].as_array().map(Vec::len), Some(2));
    let same = json(&[MISSION, MISSION], 0);
    assert_eq!((&same["differs"], &same["parting"]), (&json!(false), &Value::Null));
    let cut = mission("compare-json.log", |place, line| {
        (place > 9000 && !line.contains(" 513#") && (place % 2 == 0 || !line.contains(" 514#")))
            .then(|| line.to_owned())
    });
    let cut = json(&[MISSION, text(&cut)], 1);
    assert_eq!(cut["begin"], json!({"good": "AS_OFF", "bad": "AS_READY"}));
    assert_eq!(cut["frames"].as_array().map(Vec::len), Some(2), "{cut}");
    json(&["--edition", "3.0", FINISHED_WHILE_MOVING, MISSION], 1);
}

#[test]
fn the_schema_refuses_what_is_not_a_comparison() {
    let good = json(&[MISSION, FINISHED_WHILE_MOVING], 1);
    let validator = validator("compare");
    let spoil: [Spoil; 8] = [
        ("another key", |c| c["extra"] = json!(1)),
        ("another number of the form", |c| c["schema"] = json!(2)),
        ("no edition", |c| _ = c["good"].as_object_mut().map(|good| good.remove("edition"))),
        ("a missing part", |c| _ = c.as_object_mut().map(|c| c.remove("ranges"))),
        ("a state that is none", |c| c["parting"]["state"] = json!("AS_PARKED")),
        ("a third recording", |c| c["transitions"][0]["only"] = json!("ugly")),
        ("another rule", |c| c["findings"][0]["first"]["rule"] = json!("no-such-rule")),
        ("a range without an end", |c| {
            _ = c["ranges"][0]["good"].as_object_mut().map(|range| range.remove("max"));
        }),
    ];
    for (what, spoil) in spoil {
        let mut comparison = good.clone();
        spoil(&mut comparison);
        assert_ne!(comparison, good, "{what}");
        assert!(!validator.is_valid(&comparison), "{what} is accepted");
    }
}

#[test]
fn the_schema_names_every_rule_and_state() {
    let schema: Value = serde_json::from_str(&run(&["schema", "compare"]).stdout).expect("JSON");
    let ids: Vec<_> = Rule::ALL.iter().map(|rule| rule.id()).collect();
    let named = &schema["$defs"]["finding"]["properties"]["rule"]["enum"];
    assert_eq!(*named, json!(ids), "the `rule`s of cli/schema/compare.schema.json, and those of Rule::ALL");
    let states: Vec<_> = AsState::ALL.iter().map(|state| state.name()).collect();
    assert_eq!(
        schema["$defs"]["state"]["enum"],
        json!(states),
        "the `state`s of cli/schema/compare.schema.json"
    );
}

#[test]
fn color_is_for_the_text_and_only_if_it_is_asked_for() {
    let always = ["--color", "always", MISSION, FINISHED_WHILE_MOVING];
    let colored = compared_colored(&always);
    assert!(colored.contains("\x1b[1mWHERE THEY PART\x1b[0m"), "{colored}");
    assert!(!compared(&[MISSION, FINISHED_WHILE_MOVING], 1).contains('\x1b'));
    assert!(!compared(&[&always[..], &["--json"]].concat(), 1).contains('\x1b'));
}

/// With escapes, lines are longer than they look.
fn compared_colored(args: &[&str]) -> String {
    run(&[&["compare"], args].concat()).stdout
}

#[test]
fn the_examples_of_the_help_are_valid_arguments() {
    let help = run(&["compare", "--help"]).stdout;
    let mut tried = 0;
    for example in help.lines().filter_map(|line| line.split_once("adsdv compare ").map(|(_, args)| args)) {
        let arguments = example.split(['|', '>', '`']).next().unwrap_or_default();
        if !arguments.contains(".log") {
            continue;
        }
        let args: Vec<&str> = ["compare"].into_iter().chain(arguments.split_whitespace()).collect();
        let outcome = run(&args);
        let expected = ["GOOD, yesterday.log: cannot open", "GOOD, standard input: the log is empty"];
        assert!(expected.iter().any(|text| outcome.stderr.contains(text)), "{example}: {outcome:?}");
        tried += 1;
    }
    assert_eq!(tried, 5, "{help}");
}
