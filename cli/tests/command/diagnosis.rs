//! `adsdv conform` of programs that are wrong in several places: each deviation by itself, in the first screen.

use std::fs;

use serde_json::{Value, json};

use crate::conform::{conform, report, text};
use crate::run::temporary;

/// The deviations that are printed, one after the other, before the figure; of the first 24 lines, which is a screen.
fn first_screen(args: &[&str]) -> String {
    let (status, text) = text(&["--runs", "20"], "deviating", args);
    assert_eq!(status, Some(1), "{text}");
    text.lines().take(24).collect::<Vec<_>>().join("\n")
}

fn names(args: &[&str], deviations: &[&str]) {
    let screen = first_screen(args);
    for text in deviations {
        assert!(screen.contains(text), "{text:?} is not in the first screen:\n{screen}");
    }
}

/// One condition more at the first arrow, and nothing behind it was ever tested.
#[test]
fn a_condition_more_does_not_hide_the_mistakes_behind_it() {
    names(
        &["off-ready:needs:ami=3", "handshake:+450ms", "ready-off:missing"],
        &[
            "AS_OFF -> AS_READY also needs ami == AUTOCROSS",
            "AI_COMMS_LOST after 500 ms; expected 50 ms",
            "AS_READY -> AS_OFF is never taken",
        ],
    );
}

#[test]
fn an_arrow_that_comes_one_cycle_later_is_late_and_not_missing() {
    names(&["driving-finished:late:1"], &["AS_DRIVING -> AS_FINISHED one step late"]);
}

#[test]
fn a_program_that_brakes_after_half_a_second_has_another_time_and_no_other_reading() {
    let json = report(&["--runs", "20"], "deviating", &["handshake:+450ms"]);
    assert_eq!(json["diagnosis"]["deviations"][0]["id"], "handshake:+450ms");
    assert_eq!(json["readings"]["comms-lost"], "every-state");
}

/// Its handshake goes on where the document lets it rest, so that answers to the reference's bit would not be answers to its own.
#[test]
fn a_handshake_of_its_own_is_answered_by_its_own_bit_and_no_communication_seems_to_be_lost() {
    let screen = first_screen(&["remembers:handshake"]);
    assert!(screen.contains("the handshake stands still while TS master switch OFF"), "{screen}");
    let json = report(&["--runs", "20"], "deviating", &["remembers:handshake"]);
    let ids: Vec<&Value> =
        json["diagnosis"]["deviations"].as_array().expect("a list").iter().map(|one| &one["id"]).collect();
    assert_eq!(ids, ["remembers:handshake"], "{json}");
}

/// A program that needs no power cycle answers an open question; one whose handshake is wrong besides does not seem to need one.
#[test]
fn that_no_power_cycle_is_needed_is_a_reading_also_where_the_handshake_is_wrong() {
    let program = ["reads:power-cycle=not-latched", "remembers:handshake"];
    let json = report(&["--runs", "20"], "deviating", &program);
    assert_eq!(json["readings"]["power-cycle"], "not-latched", "{json}");
    assert_eq!(json["readings"]["comms-lost"], "every-state", "{json}");
}

/// The document does not say which of two causes counts, and no test asks for that.
#[test]
fn what_is_against_decisions_of_this_project_alone_is_observed_and_fails_with_strict() {
    let options = ["--runs", "20", "--diagnose"];
    let json = report(&options, "deviating", &["ready:cause:6-before-1"]);
    let deviations = json["diagnosis"]["deviations"].as_array().expect("a list");
    assert!(deviations.len() == 1 && deviations.iter().all(|one| one["observed"] == true), "{deviations:?}");
    assert_eq!(json["conforms"], true);
    let strict = report(&[&options[..], &["--strict"]].concat(), "deviating", &["ready:cause:6-before-1"]);
    assert_eq!(strict["conforms"], false);
}

#[test]
fn an_edge_of_go_that_the_handshake_loses_and_a_wheel_that_alone_counts_are_found() {
    names(
        &["go:needs-handshake", "moving:wheel-2"],
        &[
            "an edge of \"Go\" is lost while the AI Computer's HANDSHAKE is not the VCU's",
            "only the front right wheel tells whether the vehicle moves",
        ],
    );
}

#[test]
fn a_state_and_a_cause_that_there_are_not_are_deviations_and_the_run_goes_on() {
    names(
        &["finished:shows:as_state=0", "brake:shows:shutdown_cause=99"],
        &["as_state is 0 where it should be AS_FINISHED", "shutdown_cause is 99 in EMERGENCY_BRAKE"],
    );
}

#[test]
fn a_deviation_has_a_scenario_that_shows_it_and_that_fails_again_when_it_is_run_as_a_test() {
    let deviations = ["ready-dwell:+50ms", "driving-finished:missing"];
    let json = report(&["--runs", "0"], "deviating", &deviations);
    let found = json["diagnosis"]["deviations"].as_array().expect("a list");
    assert_eq!(found.len(), 2, "{found:?}");
    for deviation in found {
        let file = temporary("one.jsonl", b"");
        fs::write(&file, deviation["example"]["test"].as_str().expect("a test")).expect("it can be written");
        let options = ["--runs", "0", "--no-diagnosis", "--suite", file.to_str().expect("a path of text")];
        let again = report(&options, "deviating", &deviations);
        assert_eq!((&again["tests"], &again["failed_tests"]), (&json!(1), &json!(1)), "{deviation}");
        let beside = deviation["example"]["beside"].as_array().expect("a list");
        if beside.is_empty() {
            let id = deviation["id"].as_str().expect("an id");
            assert_eq!(report(&options, "deviating", &[id])["failed_tests"], 1, "{id} alone shows it");
        }
    }
}

#[test]
fn what_is_printed_of_two_deviations() {
    let (status, text) =
        text(&["--runs", "20"], "deviating", &["off-ready:needs:ami=3", "driving:shows:go_signal=0"]);
    assert_eq!(status, Some(1));
    crate::golden::compare_text("conform-deviations.txt", &text);
}

#[test]
fn answers_to_open_questions_that_are_not_the_default_ones_are_told_beside_the_deviations() {
    let program = ["reads:power-cycle=not-latched", "ready-off:missing"];
    let json = report(&["--runs", "0"], "deviating", &program);
    assert_eq!(json["diagnosis"]["readings"], json!({"power-cycle": "not-latched"}), "{json}");
    assert_eq!(json["diagnosis"]["deviations"].as_array().map(Vec::len), Some(1), "{json}");
}

#[test]
fn accepted_deviations_are_no_failure_and_others_are() {
    let file = temporary("known.txt", b"");
    let path = file.to_str().expect("a path of text");
    let deviations = ["ready-dwell:+50ms", "driving-finished:missing"];
    let written = conform(&["--runs", "0", "--write-accept", path], "deviating", &deviations);
    assert_eq!(written.status, Some(1), "{}", written.stderr);
    let known = fs::read_to_string(&file).expect("it was written");
    assert!(known.contains("\nready-dwell:+50ms  no reason given yet\n"), "{known}");
    fs::write(&file, known.replace("no reason given yet", "as ordered")).expect("it can be written");

    let accept = ["--runs", "0", "--accept", path];
    let (status, text) = text(&accept, "deviating", &deviations);
    assert_eq!(status, Some(0), "{text}");
    assert!(
        text.contains("accepted: as ordered")
            && text.contains("deviating ready-dwell:+50ms driving-finished:missing: conforms"),
        "{text}"
    );
    let others = report(&accept, "deviating", &["ready-dwell:+50ms", "ready-off:missing"]);
    assert_eq!(
        (&others["conforms"], &others["diagnosis"]["unused"]),
        (&json!(false), &json!(["driving-finished:missing"])),
        "one that is not accepted, and one that is and is not there"
    );
}

#[test]
fn a_file_of_accepted_deviations_that_is_wrong_is_refused() {
    let file = temporary("wrong.txt", b"");
    let path = file.to_str().expect("a path of text");
    fs::write(&file, "# known\ngo:level\n").expect("it can be written");
    let outcome = conform(&["--runs", "0", "--accept", path], "deviating", &[]);
    assert_eq!(outcome.status, Some(2));
    assert!(outcome.stderr.contains("line 2: \"go:level\" has no reason"), "{}", outcome.stderr);
    let none = conform(&["--runs", "0", "--accept", "no/such/file"], "deviating", &[]);
    assert!(
        none.status == Some(2) && none.stderr.contains("hint: a line is an id and a reason"),
        "{}",
        none.stderr
    );
}

#[test]
fn the_figure_of_the_program_is_drawn_with_what_differs() {
    let (dot, mermaid) = (temporary("figure.dot", b""), temporary("figure.mmd", b""));
    for (file, parts) in [
        (&dot, ["digraph figure_2 {", "DIFFERS", "MISSING", "color=\"#c00000\""]),
        (&mermaid, ["stateDiagram-v2", "DIFFERS<br/>", "MISSING<br/>", "AS_READY --> AS_OFF"]),
    ] {
        let path = file.to_str().expect("a path of text");
        conform(
            &["--runs", "0", "--figure", path],
            "deviating",
            &["ready-off:missing", "off-ready:needs:ami=3"],
        );
        let drawn = fs::read_to_string(file).expect("it was written");
        assert!(parts.iter().all(|part| drawn.contains(part)), "{drawn}");
    }
}

/// The example ends with an error as soon as a step does not take its cycle.
#[test]
fn a_program_at_a_slow_cycle_is_diagnosed_by_what_it_says_of_itself() {
    let options = ["--runs", "20", "--diagnosis-limit", "600"];
    let about = r#"{"cycle_ms":100}"#;
    let (_, report) = text(&options, "deviating", &["--about", about, "handshake:+450ms"]);
    let screen = report.lines().take(24).collect::<Vec<_>>().join("\n");
    for text in ["cycle 100 ms, as it says", "AI_COMMS_LOST after 500 ms; expected 50 ms"] {
        assert!(screen.contains(text), "{text:?} is not in the first screen:\n{screen}");
    }
    assert!(report.contains("a time is known to 100 ms"), "{report}");
    let (_, report) =
        text(&["--runs", "0", "--no-diagnosis", "--cycle-ms", "10"], "deviating", &["go:level"]);
    assert!(!report.contains("DEVIATIONS"), "{report}");
}

#[test]
fn what_shows_a_deviation_at_a_fixed_cycle_fails_again_when_it_is_run_as_a_test() {
    let program = ["--about", r#"{"cycle_ms":100}"#, "ready-dwell:+300ms", "driving-finished:late:2"];
    let json = report(&["--runs", "0", "--diagnosis-limit", "600"], "deviating", &program);
    let found = json["diagnosis"]["deviations"].as_array().expect("a list");
    assert_eq!(found.len(), 2, "{found:?}");
    for deviation in found {
        let file = temporary("at-cycle.jsonl", b"");
        fs::write(&file, deviation["example"]["test"].as_str().expect("a test")).expect("it can be written");
        let options = ["--runs", "0", "--no-diagnosis", "--suite", file.to_str().expect("a path of text")];
        let again = report(&options, "deviating", &program);
        assert_eq!((&again["tests"], &again["failed_tests"]), (&json!(1), &json!(1)), "{deviation}");
    }
}

#[test]
fn why_a_program_that_goes_by_a_clock_is_not_diagnosed_stands_in_the_report() {
    let to_ready = r#"{"dt_ms":20,"answers":true,"inputs":{"asms":true,"tsms":true,"ami":"TRACK_DRIVE","ebs":"ARMED","mission_status":"SELECTED"}}"#;
    let file = temporary("clock.jsonl", format!("{{\"steps\":[{to_ready}]}}\n").as_bytes());
    let options = ["--runs", "0", "--suite", file.to_str().expect("a path of text")];
    let clock = ["--about", r#"{"clock":"wall"}"#, "off-ready:missing"];
    let (_, report) = text(&options, "deviating", &clock);
    let said = report.lines().skip_while(|line| *line != "DEVIATIONS").nth(1).unwrap_or_default();
    assert!(said.starts_with("  not looked for: by a clock on the wall"), "{report}");
}

#[test]
fn without_a_diagnosis_only_the_tests_tell() {
    let json = report(&["--runs", "0", "--no-diagnosis"], "deviating", &["ready-off:missing"]);
    assert_eq!(json["diagnosis"], Value::Null);
    let refused = conform(&["--no-diagnosis", "--diagnose"], "deviating", &[]);
    assert_eq!(refused.status, Some(2), "{}", refused.stdout);
}

/// What the program of the documentation announces, as a line of the protocol.
fn documented() -> String {
    let page = include_str!("../../../docs/first-diagnosis.md");
    let (_, list) = page.split_once("ABOUT = ").expect("the page has a list");
    let (list, _) = list.split_once(",\n}").expect("it ends");
    format!("{}}}", list.split_whitespace().collect::<Vec<_>>().join(" "))
}

/// The example ends with an error as soon as it is given an input that it does not announce.
#[test]
fn a_program_that_announces_its_inputs_has_no_deviation_about_others() {
    let about = documented();
    let json = report(&["--runs", "20", "--diagnose"], "deviating", &["--about", &about]);
    assert_eq!(
        (&json["diagnosis"]["deviations"], &json["diagnosis"]["unexplained"]),
        (&json!([]), &json!(0)),
        "{json}"
    );
    let accepted = temporary("announced.txt", b"");
    let path = accepted.to_str().expect("a path of text");
    let options = ["--runs", "20", "--write-accept", path];
    let json = report(&options, "deviating", &["--about", &about, "handshake:+450ms", "ready-off:missing"]);
    let ids: Vec<&Value> =
        json["diagnosis"]["deviations"].as_array().expect("a list").iter().map(|one| &one["id"]).collect();
    assert_eq!(ids, ["handshake:+450ms", "ready-off:missing"]);
    let written = fs::read_to_string(&accepted).expect("it was written");
    assert_eq!(
        written.lines().filter(|line| !line.is_empty() && !line.starts_with('#')).count(),
        2,
        "{written}"
    );
}

#[test]
fn the_first_screen_of_a_program_that_announces_little_has_its_deviation() {
    let about = documented();
    let screen = first_screen(&["--about", &about, "ready-off:missing"]);
    assert!(screen.contains("AS_READY -> AS_OFF is never taken"), "{screen}");
    assert!(!screen.contains("hyd_press_f"), "names are listed by --all:\n{screen}");
    let (_, all) = text(&["--runs", "20", "--all"], "deviating", &["--about", &about, "ready-off:missing"]);
    assert!(all.contains("hyd_press_f"), "{all}");
}

#[test]
fn a_search_that_ends_before_it_knows_anything_says_so() {
    let options = ["--runs", "20", "--diagnosis-limit", "0.000001"];
    let (status, screen) = text(&options, "deviating", &["ready-off:missing"]);
    assert_eq!(status, Some(1));
    assert!(
        screen.contains("undecided: the search ended after 0.000001 s") && screen.contains("see FAILURES"),
        "{screen}"
    );
    assert!(!screen.contains("none in") && !screen.contains("  follows "), "{screen}");
    let json = report(&options, "deviating", &["ready-off:missing"]);
    let figure = json["diagnosis"]["figure"].as_array().expect("a list");
    assert!(figure.iter().all(|arrow| arrow["not_shown"] == true), "{figure:?}");
    let follows = json["follows"].as_array().expect("a list");
    assert!(follows.iter().all(|one| one["possible"].as_array().map(Vec::len) > Some(1)), "{follows:?}");
}
