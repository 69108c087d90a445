//! The first screen of what `adsdv conform` prints of a program that deviates, and the scenarios below it.

use serde_json::Value;

use crate::conform::{conform, text};
use crate::run::temporary;

/// So many lines are a screen.
const SCREEN: usize = 25;

fn first_screen(text: &str) -> String {
    text.lines().take(SCREEN).collect::<Vec<_>>().join("\n")
}

/// Nearly every test fails at its first step.
#[test]
fn nine_deviations_are_all_listed_before_what_shows_them() {
    let program = [
        "off-ready:needs:ami=3",
        "handshake:+450ms",
        "ready-off:missing",
        "driving-finished:late:1",
        "ebs-timer:-4000ms",
        "moving:wheel-2",
        "driving:shows:shutdown_cause=99",
        "driving-brake:2:missing",
        "ready:cause:6-before-1",
    ];
    let (status, text) = text(&["--runs", "20"], "deviating", &program);
    let screen = first_screen(&text);
    assert_eq!(status, Some(1));
    for named in [
        "9 deviations, 1 of them no failure, where the document is silent",
        "- AS_OFF -> AS_READY also needs ami == AUTOCROSS\n",
        "- AI_COMMS_LOST after 500 ms\n",
        "- AS_READY -> AS_OFF is never taken\n",
        "- AS_DRIVING -> AS_FINISHED one step late\n",
        "- EMERGENCY_BRAKE can be left after 11000 ms\n",
        "- only the front right wheel tells whether the vehicle moves\n",
        "- shutdown_cause is 99 in AS_DRIVING",
        "- AS_DRIVING -> EMERGENCY_BRAKE is not taken by \"Go\" signal OFF\n",
        "- AS_READY -> EMERGENCY_BRAKE by AI COMPUTER REQUEST and AI COMMS FAULT at once gives AI COMMS\n",
    ] {
        assert!(screen.contains(named), "{named:?} is not in the first screen:\n{screen}");
    }
    let silent = screen.find("at once gives").expect("it is there");
    assert!(
        screen.rfind("is not taken by").is_some_and(|failure| failure < silent),
        "what counts comes first"
    );
}

/// The fault opens the shutdown circuit in the end; what is blamed is what the scenario has.
#[test]
fn where_torque_and_brakes_are_asked_for_at_once_no_open_shutdown_circuit_is_blamed() {
    let edition = ["--edition", "4.0"];
    let program = [&edition[..], &["driving-brake:6:missing"]].concat();
    let (_, report) = text(&[&edition[..], &["--runs", "0"]].concat(), "deviating", &program);
    let screen = first_screen(&report);
    let named = "is not taken by front axle torque request != 0 and a brake";
    assert!(screen.contains(named), "{named:?} is not in the first screen:\n{screen}");
    let (_, failures) =
        text(&[&edition[..], &["--runs", "0", "--no-diagnosis"]].concat(), "deviating", &program);
    // The figure below has all conditions of the arrow.
    let (named, _) = screen.split_once("\nFIGURE 2").unwrap_or((&screen, ""));
    let (_, failures) = failures.split_once("\nFAILURES\n").expect("there are some");
    let (failures, _) = failures.split_once("\nREADINGS\n").expect("they come next");
    for report in [named, failures] {
        let blamed = ["SDC open", "shutdown circuit"].iter().find(|blamed| report.contains(**blamed));
        assert_eq!(blamed, None, "{report}");
    }
    assert!(failures.contains("front axle torque request != 0"), "{failures}");
}

/// "Go" comes while the steering does not allow it, and the steering allows it later.
#[test]
fn an_input_that_is_set_and_reset_while_the_state_stays_stands_in_the_printed_scenario() {
    let with = |dt_ms: u32, more: &str| {
        format!(
            r#"{{"dt_ms":{dt_ms},"answers":true,"inputs":{{"asms":true,"tsms":true,"ami":"TRACK_DRIVE","ebs":"ARMED","mission_status":"SELECTED"{more}}}}}"#
        )
    };
    let blink = r#","go":true,"steer_request":5"#;
    let steps = [with(10, ""), with(5000, ""), with(10, blink), with(10, r#","go":true"#)].join(",");
    let file = temporary("blink.jsonl", format!("{{\"steps\":[{steps}]}}\n").as_bytes());
    let options = ["--runs", "0", "--no-diagnosis", "--suite", file.to_str().expect("a path of text")];
    let (_, report) = text(&options, "deviating", &["remembers:go-seen-off"]);
    let (_, printed) = report.split_once("INPUTS THAT CHANGED\n").expect("there is a scenario");
    let (printed, pasted) = printed.split_once("as a test for --suite: ").expect("it ends");
    assert!(printed.contains("steer_request 5") && printed.contains("steer_request 0"), "{printed}");
    // Whatever changes from step to step is printed, in that order.
    let pasted: Value = serde_json::from_str(pasted.lines().next().unwrap_or_default()).expect("JSON");
    let steps = pasted["steps"].as_array().expect("steps");
    let mut rest = printed.split_whitespace().map(|word| word.trim_end_matches(','));
    let (mut before, mut changed) = (&Value::Null, 0);
    for step in steps {
        let mut keys: Vec<&str> = Vec::new();
        for inputs in [before, &step["inputs"]] {
            keys.extend(inputs.as_object().into_iter().flatten().map(|(key, _)| key.as_str()));
        }
        keys.retain(|key| *key != "handshake" && before[*key] != step["inputs"][*key]);
        keys.dedup();
        for _ in &keys {
            assert!(rest.any(|word| keys.contains(&word)), "{keys:?} of {step} is missing:\n{printed}");
            changed += 1;
        }
        before = &step["inputs"];
    }
    assert!(changed >= 8, "{printed}");
}

#[test]
fn a_program_that_keeps_something_over_a_reset_is_said_to_and_is_not_diagnosed() {
    let (status, report) = text(&["--runs", "0"], "deviating", &["--no-reset", "ready-off:missing"]);
    let screen = first_screen(&report);
    assert_eq!(status, Some(1));
    assert!(screen.contains("or keep something over a reset"), "{screen}");
    assert!(screen.contains("not looked for: it does not answer alike each time"), "{screen}");
}

#[test]
fn what_a_program_says_of_itself_and_cannot_be_so_is_an_error_that_says_what_may_be_said() {
    for (about, wrong) in [
        (r#"{"cycle_ms":0}"#, "\"cycle_ms\" is 0; expected a whole number from 1 to 1000"),
        (r#"{"clock":"sun"}"#, "\"clock\" is \"sun\"; expected \"wall\" or \"steps\""),
        (r#"{"inputs":"asms"}"#, "\"inputs\" is \"asms\"; expected a list of keys"),
    ] {
        let outcome = conform(&[], "mutant", &["--about", about]);
        let first = outcome.stderr.lines().next().unwrap_or_default();
        assert_eq!(outcome.status, Some(2), "{first}");
        assert!(first.contains(&format!("what it says of itself cannot be so: {wrong}")), "{first}");
        assert!(outcome.stderr.contains("\nhint: say before the first answer only"), "{}", outcome.stderr);
    }
}
