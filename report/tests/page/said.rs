//! The sentences of the page, of both recordings and of logs that tell little.

use std::fmt::Write as _;

use expect_test::expect_file;

use crate::{Run, recorded, run};

/// What stands on the page in sentences.
fn said(run: &Run) -> String {
    let data = run.data();
    let text = |value: &serde_json::Value| value.as_str().unwrap_or_default().to_owned();
    let summary = &data["summary"];
    let mut out = format!(
        "{}: {}\nNext: {}\n",
        text(&summary["mood"]),
        text(&summary["verdict"]),
        text(&summary["next"])
    );
    for one in summary["matters"].as_array().into_iter().flatten() {
        let _ = writeln!(
            out,
            "- {} ({}): {} [{}]",
            text(&one["title"]),
            text(&one["mood"]),
            text(&one["text"]),
            one["at"]
        );
    }
    for one in data["questions"].as_array().into_iter().flatten() {
        let (question, answer) = (text(&one["question"]), text(&one["answer"]));
        let _ = writeln!(
            out,
            "{question} ({}, {} in {})\n  {answer}",
            text(&one["mood"]),
            one["at"],
            text(&one["show"])
        );
    }
    out
}

#[test]
fn of_the_mission() {
    expect_file!["../golden/mission.txt"].assert_eq(&said(&run(&recorded("mission"))));
}

#[test]
fn of_the_mission_that_was_finished_while_moving() {
    let log = recorded("finished-while-moving");
    expect_file!["../golden/finished-while-moving.txt"].assert_eq(&said(&run(&log)));
}

/// A recording in which the VCU shows a state that there is none of, once.
fn with_a_state_that_there_is_none_of(name: &str) -> Vec<u8> {
    let log = String::from_utf8(recorded(name)).expect("text");
    let at = log.match_indices("520#").nth(500).expect("so many frames").0 + "520#0001".len();
    [&log[..at], "0F", &log[at + 2..]].concat().into_bytes()
}

/// What to do next about a log.
fn next(log: &[u8]) -> String {
    let run = run(log);
    adsdv_report::next(&run.edition.rules, &run.report)
}

#[test]
fn a_violation_by_the_ai_computer_is_to_be_fixed_first_though_the_vcu_erred_before() {
    let next = next(&with_a_state_that_there_is_none_of("finished-while-moving"));
    assert!(next.starts_with("Fix first, in the AI Computer: MISSION_STATUS == FINISHED"), "{next}");
}

#[test]
fn where_only_the_vcu_erred_there_is_nothing_to_fix_in_the_ai_computer() {
    let next = next(&with_a_state_that_there_is_none_of("mission"));
    assert!(next.starts_with("Nothing to fix in the AI Computer"), "{next}");
    assert!(next.contains("First, in the VCU: VCU2AI_Status (520h): AS_STATE is 15"), "{next}");
}

/// What the tour of the page shows is what it says.
#[test]
fn the_answers_in_the_documentation() {
    let data = run(&recorded("finished-while-moving")).data();
    let tour = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/report.md");
    let tour = std::fs::read_to_string(tour).expect("the tour");
    let questions = data["questions"].as_array().expect("questions");
    assert_eq!(questions.len(), 10);
    for one in questions {
        let text = |key: &str| one[key].as_str().expect("text");
        let row = format!("| {} | {} | ", text("question"), text("answer"));
        assert!(tour.contains(&row), "{row}");
    }
}

#[test]
fn of_a_recording_of_the_ai_computer_alone() {
    let log = recorded("mission");
    let is_of_ai = |line: &&str| ["510#", "511#", "512#", "513#", "514#"].iter().any(|id| line.contains(id));
    let text = String::from_utf8(log).expect("text");
    let lines: Vec<&str> = text.lines().filter(is_of_ai).collect();
    expect_file!["../golden/ai-alone.txt"].assert_eq(&said(&run((lines.join("\n") + "\n").as_bytes())));
}

/// Requests of which the vehicle shows nothing, a silence of a second, and what the recorder says it lost.
#[test]
fn of_requests_that_reach_nothing_and_frames_that_are_lost() {
    let mut log = String::new();
    for cycle in 0..400_u32 {
        let time = 1.0 + f64::from(cycle) * 0.01 + if cycle < 300 { 0.0 } else { 1.0 };
        let bit = cycle % 2;
        let torque = if (100..200).contains(&cycle) { "C800" } else { "0000" };
        let steer = if (120..150).contains(&cycle) { "6400" } else { "0000" };
        for (id, data) in [
            (0x520, format!("0{bit}06020000000000")),
            (0x521, "000000000000".to_owned()),
            (0x523, "0000D2000000".to_owned()),
            (0x524, "0000000011".to_owned()),
            (0x510, format!("0{bit}10000000000000")),
            (0x511, format!("{torque}D006")),
            (0x513, steer.to_owned()),
        ] {
            let _ = writeln!(log, "({time:.6}) can0 {id:03X}#{data}");
        }
        if cycle == 300 {
            log.push_str("DROPCOUNT: dropped 7 CAN frames on 'can0' socket (total drops 7)\n");
        }
    }
    expect_file!["../golden/unanswered.txt"].assert_eq(&said(&run(log.as_bytes())));
}
