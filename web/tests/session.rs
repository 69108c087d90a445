//! What a page asks, asked without a browser: the same requests, and the same answers.

use std::fs;
use std::io::{Cursor, Read};
use std::path::Path;

use adsdv_web::{Answer, Session};
use serde_json::{Value, json};

fn log(name: &str) -> Vec<u8> {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/logs").join(name);
    fs::read(&file).unwrap_or_else(|error| panic!("{}: {error}", file.display()))
}

fn text(session: &mut Session, request: &Value, log: impl Read + Send + 'static) -> String {
    match session.answer(&request.to_string(), log) {
        Answer::Text(text) => text,
        Answer::Refused(why) => panic!("{request}: {why}"),
    }
}

fn answer(session: &mut Session, request: &Value) -> Value {
    serde_json::from_str(&text(session, request, std::io::empty())).expect("JSON")
}

fn refusal(session: &mut Session, request: &str, log: &'static [u8]) -> Value {
    match session.answer(request, log) {
        Answer::Refused(why) => serde_json::from_str(&why).expect("JSON"),
        Answer::Text(text) => panic!("{request}: {text}"),
    }
}

fn judged(log: Vec<u8>, more: &Value) -> Value {
    let mut request = json!({ "do": "judge", "name": "run.log" });
    for (key, value) in more.as_object().expect("an object") {
        request[key] = value.clone();
    }
    let text = text(&mut Session::default(), &request, Cursor::new(log));
    serde_json::from_str(&text).expect("JSON")
}

#[test]
fn a_log_is_judged_by_the_edition_that_it_tells_or_by_another() {
    for (name, verdict) in [("mission.log", "conforms"), ("finished-while-moving.log", "violates")] {
        let whole = judged(log(name), &json!({}));
        assert_eq!((whole["verdict"].as_str(), whole["edition"].as_str()), (Some(verdict), Some("4.0")));
        let check = &whole["data"]["check"];
        assert_eq!((check["verdict"].as_str(), check["edition"].as_str()), (Some(verdict), Some("4.0")));
        assert_eq!(whole["data"]["name"], "run.log");
        let brief = judged(log(name), &json!({ "brief": true }));
        assert!(brief["data"].is_null());
        for key in ["verdict", "edition", "violations", "warnings", "frames", "duration_s"] {
            assert_eq!(brief[key], whole[key], "{name}: {key}");
        }
        let named = judged(log(name), &json!({ "edition": "3.0", "readings": ["go-edge=edge"] }));
        assert_eq!((&named["edition"], &named["recognised"]), (&json!("3.0"), &json!(false)));
        let settings = named["data"]["settings"].to_string();
        assert!(settings.contains("reading go-edge=edge: "), "{settings}");
    }
}

#[test]
fn what_cannot_be_answered_says_what_was_given_and_what_to_do() {
    let mut session = Session::default();
    let cases: [(&str, &[u8], &str); 10] = [
        (r#"{"do":"judge","name":"a.log"}"#, b"", "a.log: the log is empty"),
        (r#"{"do":"judge","name":"a.log"}"#, b"rubbish\n", "a.log: no readable frame in 1 line"),
        (r#"{"do":"judge","name":"a.db3"}"#, b"SQLite format 3\0", "a.db3: it is an SQLite database"),
        (
            r#"{"do":"judge","name":"a","edition":"9"}"#,
            b"",
            "the request: there is no edition \"9\"; expected one of 3.0,",
        ),
        (r#"{"do":"judge","name":"a","readings":["x"]}"#, b"", "the request: there is no reading \"x\""),
        (
            r#"{"do":"judge","name":"a","edition":"3.0","readings":["go-edge=edge","go-edge=seen-low"]}"#,
            b"",
            "reading go-edge=seen-low: go-edge is already pinned to edge",
        ),
        (r#"{"do":"run","ms":1}"#, b"", "the request: there is no car yet"),
        (r#"{"do":"example","id":"x"}"#, b"", "the request: there is no example"),
        (r#"{"do":"dance"}"#, b"", "the request: unknown variant"),
        ("nonsense", b"", "the request: expected"),
    ];
    for (request, log, says) in cases {
        let error = refusal(&mut session, request, log);
        let line =
            format!("{}: {}", error["what"].as_str().unwrap_or(""), error["why"].as_str().unwrap_or(""));
        assert!(line.starts_with(says), "{request}: {line}");
        assert!(error["hint"].as_str().is_some_and(|hint| !hint.is_empty()), "{request}: {error}");
    }
}

#[test]
fn what_fails_in_the_middle_is_judged_up_to_there() {
    struct Fails;
    impl Read for Fails {
        fn read(&mut self, _: &mut [u8]) -> std::io::Result<usize> {
            Err(std::io::Error::other("the disk is gone"))
        }
    }
    let request = json!({ "do": "judge", "name": "run.log" });
    let text = text(&mut Session::default(), &request, Cursor::new(log("mission.log")).chain(Fails));
    let judged: Value = serde_json::from_str(&text).expect("JSON");
    assert_eq!(judged["data"]["check"]["frames"], 33940);
    assert!(
        judged["failure"]["why"].as_str().is_some_and(|why| why.contains("the disk is gone")),
        "{}",
        judged["failure"]
    );
}

#[test]
fn each_example_is_the_log_that_its_title_says() {
    let mut session = Session::default();
    let about = answer(&mut session, &json!({ "do": "about" }));
    let rules = |id: &str| match id {
        "finished" => Some("finished-while-moving"),
        "handshake" => Some("handshake-late"),
        _ => None,
    };
    for example in about["examples"].as_array().expect("a list") {
        let id = example["id"].as_str().expect("text");
        let log = text(&mut session, &json!({ "do": "example", "id": id }), std::io::empty());
        let judged = judged(log.into_bytes(), &json!({ "edition": example["edition"] }));
        let violations: Vec<&str> = judged["data"]["check"]["findings"]
            .as_array()
            .expect("a list")
            .iter()
            .filter(|one| one["severity"] == "violation")
            .filter_map(|one| one["rule"].as_str())
            .collect();
        assert_eq!(violations.first().copied(), rules(id), "{id}: {violations:?}");
        let states = judged["data"]["check"]["exercised"]["states"].to_string();
        let shows = match id {
            "mission" | "mission-2026" => "AS_FINISHED",
            "finished" | "handshake" | "remote-estop" | "power-cycle" => "EMERGENCY_BRAKE",
            _ => "AS_READY",
        };
        assert!(states.contains(shows), "{id}: {states}");
        if id == "torque" {
            assert!(!states.contains("AS_DRIVING"), "{states}");
        }
    }
}

#[test]
fn a_drive_is_what_the_demo_drives() {
    let mut session = Session::default();
    let begun = answer(&mut session, &json!({ "do": "begin", "edition": "3.0", "scenario": "mission" }));
    assert_eq!(
        begun["figure"]["picture"]["states"][0],
        json!({ "name": "AS_OFF", "light": "off", "x": 400.0, "y": 50.0 })
    );
    let mut changes = Vec::new();
    for _ in 0..400 {
        let run = answer(&mut session, &json!({ "do": "run", "ms": 100 }));
        assert_eq!(run["findings"], json!([]), "{run}");
        for change in run["transitions"].as_array().expect("a list") {
            // Each is an arrow of the figure that is shown.
            let arrows = begun["figure"]["arrows"].as_array().expect("a list");
            assert!(
                arrows.iter().any(|arrow| arrow["from"] == change["from"] && arrow["to"] == change["to"]),
                "{change}"
            );
            changes.push(change["to"].as_str().unwrap_or_default().to_owned());
        }
        if run["state"] == "AS_FINISHED" {
            break;
        }
    }
    assert_eq!(changes, ["AS_READY", "AS_DRIVING", "AS_FINISHED"]);

    let drive = text(&mut session, &json!({ "do": "drive-log" }), std::io::empty());
    let mut demo = Vec::new();
    let scenario = adsdv_can::scenario::Scenario::mission();
    let ai = adsdv_can::ai::Ai::new(&adsdv_spec::Edition::V3_0, adsdv_can::ai::Plan::DEFAULT);
    let taken =
        adsdv_can::demo::run(&scenario, ai, &adsdv_can::demo::DemoOptions::default(), |time_ns, frame| {
            let record = adsdv_oracle::candump::Record {
                line: 0,
                time_ns,
                interface: adsdv_can::demo::BUS,
                kind: adsdv_oracle::candump::FrameKind::Standard,
                id: frame.id.into(),
                data: frame.data(),
                direction: None,
                terminated: true,
            };
            adsdv_oracle::candump::write_record(&mut demo, &record)
        });
    taken.expect("a mission ends");
    assert!(demo.starts_with(drive.as_bytes()), "other frames");
}

#[test]
fn whether_a_condition_holds_decides_which_arrow_is_taken() {
    let mut session = Session::default();
    let begun = answer(&mut session, &json!({ "do": "begin", "edition": "2026", "scenario": "power-cycle" }));
    let arrows = begun["figure"]["arrows"].as_array().expect("a list");
    let mut before: Option<Value> = None;
    let mut taken = 0;
    for _ in 0..9000 {
        let run = answer(&mut session, &json!({ "do": "run", "ms": 10 }));
        if let Some(before) = before.filter(|before| before["state"] != run["state"]) {
            let (from, to) = (&before["state"], &run["state"]);
            let arrow = arrows.iter().find(|arrow| arrow["from"] == *from && arrow["to"] == *to);
            // Power is no arrow.
            if let Some(arrow) = arrow {
                let terms = arrow["terms"].as_array().expect("a list");
                assert!(
                    !terms.is_empty() && terms.iter().all(|term| term["conditions"][0]["text"].is_string()),
                    "{arrow}"
                );
                taken += 1;
            }
        }
        if run["next"].is_null() && run["t"].as_f64() > Some(5.0) {
            break;
        }
        before = Some(run);
    }
    assert!(taken >= 3, "{taken} arrows were taken");
}
