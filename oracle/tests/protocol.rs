//! The protocol: what is written is read back, its page tells all of it, and what is not in it is refused with reasons.

use std::collections::HashSet;

use adsdv_oracle::protocol::{Answer, Domain, INPUTS, InputsAsJson, Request, SHOWN, Shown};
use adsdv_spec::messages::{MissionStatus, SteerAngle};
use adsdv_spec::{Control, Inputs, Machine};

const PAGE: &str = include_str!("../PROTOCOL.md");

fn shown() -> Shown {
    let inputs = Inputs::default();
    let (_, outputs) = Machine::REFERENCE.step(&Control::INITIAL, &inputs, 10);
    Shown::of(&outputs, &inputs)
}

/// The inputs with one field at one of its values.
fn with(key: &str, raw: i32) -> Inputs {
    let mut inputs = Inputs::default();
    let field = INPUTS.iter().find(|field| field.key == key).unwrap();
    assert!((field.set)(&mut inputs, raw), "{key} = {raw}");
    inputs
}

fn values(domain: Domain) -> Vec<i32> {
    match domain {
        Domain::Flag => vec![0, 1],
        Domain::Names(names) => names.iter().map(|&(raw, _)| raw).collect(),
        Domain::Number { min, max } => vec![min, 0, max],
    }
}

#[test]
fn every_value_of_every_input_is_read_as_it_is_written() {
    for field in INPUTS {
        for raw in values(field.domain) {
            let request = Request::Step { dt_ms: 10, inputs: with(field.key, raw) };
            let line = request.to_string();
            assert_eq!(line.parse(), Ok(request), "{line}");
            assert_eq!((field.get)(&with(field.key, raw)), raw);
            // Names may be given as numbers.
            let number = format!("{{\"op\":\"step\",\"dt_ms\":10,\"{}\":{raw}}}", field.key);
            assert_eq!(number.parse(), Ok(request), "{number}");
        }
        for raw in [-100_000, 100_000] {
            assert!(!(field.set)(&mut Inputs::default(), raw), "{} = {raw}", field.key);
        }
    }
    assert_eq!(Request::Reset.to_string().parse(), Ok(Request::Reset));
}

#[test]
fn an_answer_that_shows_everything_agrees_and_each_field_of_it_counts() {
    let shown = shown();
    let line = shown.to_string();
    let answer: Answer = line.parse().unwrap();
    assert!(answer.agrees(&shown) && answer.differences(&shown).next().is_none());
    assert_eq!(answer, Answer::from(shown));
    for (field, value) in shown.iter() {
        let others = values(field.domain).into_iter().filter(|&raw| Some(raw) != value.raw);
        let state = shown.get("as_state").unwrap();
        for raw in others {
            let line = match field.key {
                "as_state" => format!("{{\"as_state\":{raw}}}"),
                key => format!("{{\"as_state\":\"{state}\",\"{key}\":{raw}}}"),
            };
            let answer: Answer = line.parse().unwrap();
            assert!(!answer.agrees(&shown), "{line}");
            let keys: Vec<&str> = answer.differences(&shown).map(|difference| difference.key).collect();
            assert_eq!(keys, [field.key]);
        }
    }
    assert!(shown.get("steer").unwrap().raw.is_none() && line.contains("\"steer\":null"));
}

#[test]
fn keys_are_unique_and_no_name_needs_escapes() {
    let inputs: HashSet<&str> = INPUTS.iter().map(|field| field.key).collect();
    let outputs: HashSet<&str> = SHOWN.iter().map(|field| field.key).collect();
    assert_eq!((inputs.len(), outputs.len()), (INPUTS.len(), SHOWN.len()));
    let domains = INPUTS.iter().map(|field| field.domain).chain(SHOWN.map(|field| field.domain));
    for domain in domains {
        if let Domain::Names(names) = domain {
            assert!(
                names
                    .iter()
                    .all(|(_, name)| name.chars().all(|c| c.is_ascii_alphanumeric() || "_ ".contains(c)))
            );
        }
    }
}

#[test]
fn the_page_names_every_key_and_every_value_and_its_example_is_true() {
    let (inputs, outputs) = PAGE.split_once("## Outputs").unwrap();
    let said = |part: &str, key: &str, domain: Domain| {
        let row = part.lines().find(|line| line.starts_with('|') && line.contains(&format!("`{key}`")));
        let row = row.unwrap_or_else(|| panic!("{key} is not in the page"));
        match domain {
            Domain::Flag => assert!(row.contains("`true`, `false`"), "{key}: {row}"),
            // AMI_STATE is said to be as the AMI.
            Domain::Names(_) if row.contains("as `ami`") => {}
            Domain::Names(names) => {
                assert!(names.iter().all(|(_, name)| row.contains(&format!("`{name}`"))), "{key}: {row}");
            }
            Domain::Number { min, max } => assert!(row.contains(&format!("{min} to {max}")), "{key}: {row}"),
        }
    };
    for field in INPUTS {
        said(inputs, field.key, field.domain);
    }
    for field in SHOWN {
        said(outputs, field.key, field.domain);
    }

    // How names count.
    let keyed = INPUTS.iter().map(|field| (field.key, field.domain));
    for (key, domain) in keyed.chain(SHOWN.map(|field| (field.key, field.domain))) {
        if let Domain::Names(names) = domain {
            let first = i32::from(matches!(key, "as_state" | "ebs"));
            assert!((first..).zip(names).all(|(number, &(raw, _))| raw == number), "{key}");
        }
    }

    let mut control = Control::INITIAL;
    let mut lines = PAGE.lines().filter(|line| line.starts_with(['>', '<']));
    while let (Some(question), Some(answer)) = (lines.next(), lines.next()) {
        match question[2..].parse::<Request>().unwrap() {
            Request::Reset => assert_eq!(&answer[2..], "{}"),
            Request::Step { dt_ms, inputs } => {
                let (after, outputs) = Machine::REFERENCE.step(&control, &inputs, dt_ms);
                control = after;
                let answer: Answer = answer[2..].parse().unwrap();
                assert!(answer.agrees(&Shown::of(&outputs, &inputs)), "{answer:?}");
            }
        }
    }
    assert_ne!(control, Control::INITIAL);
}

#[test]
fn bad_requests_are_refused_with_what_was_found_and_what_was_expected() {
    let refused = |line: &str| line.parse::<Request>().unwrap_err().to_string();
    for (line, found, expected) in [
        ("", "EOF", "a JSON object on one line"),
        ("{\"op\":\"step\"", "EOF", "a JSON object on one line"),
        ("[1]", "sequence", "a JSON object on one line"),
        ("{}", "no \"op\"", "\"reset\" or \"step\""),
        (r#"{"op":"jump"}"#, "\"jump\"", "\"reset\" or \"step\""),
        (r#"{"op":"reset","go":true}"#, "a reset", "nothing but \"op\""),
        (r#"{"op":"step"}"#, "no \"dt_ms\"", "milliseconds"),
        (r#"{"op":"step","dt_ms":-1}"#, "-1", "a whole number from 0"),
        (r#"{"op":"step","dt_ms":1.5}"#, "not whole", "a whole number from 0"),
        (r#"{"op":"step","dt_ms":99999999999}"#, "99999999999", "a whole number from 0"),
        (r#"{"op":"step","dt_ms":1,"gas":true}"#, "\"gas\"", "go"),
        (r#"{"op":"step","dt_ms":1,"go":"on"}"#, "\"on\"", "true or false"),
        (r#"{"op":"step","dt_ms":1,"go":2}"#, "2", "true or false"),
        (r#"{"op":"step","dt_ms":1,"go":[1]}"#, "a list", "true or false"),
        (r#"{"op":"step","dt_ms":1,"ebs":"OFF"}"#, "\"OFF\"", "\"ARMED\""),
        (r#"{"op":"step","dt_ms":1,"steer_angle":241}"#, "241", "-240 to 240"),
        (r#"{"op":"step","dt_ms":1,"go":true,"go":true}"#, "twice", "once"),
    ] {
        let said = refused(line);
        assert!(said.contains(found) && said.contains(expected), "{line}: {said}");
    }
}

#[test]
fn a_line_that_is_no_object_is_refused_with_what_it_is() {
    let refused = |line: &str| line.parse::<Answer>().unwrap_err().to_string();
    assert!(refused("[1]").starts_with("\"[1]\": invalid type: sequence, expected a JSON object at line 1"));
}

#[test]
fn bad_answers_are_refused_with_what_was_found_and_what_was_expected() {
    let refused = |line: &str| line.parse::<Answer>().unwrap_err().to_string();
    for (line, found, expected) in [
        ("hello", "hello", "a JSON object on one line"),
        ("{}", "no \"as_state\"", "at least that"),
        (r#"{"as_state":"READY"}"#, "\"READY\"", "\"AS_READY\""),
        (r#"{"as_state":0}"#, "0", "\"AS_READY\""),
        (r#"{"as_state":null}"#, "null", "\"AS_READY\""),
        (r#"{"as_state":2,"as_state":2}"#, "twice", "once"),
        (r#"{"as_state":2,"handshak":true}"#, "\"handshak\"", "handshake"),
        (r#"{"as_state":2,"steer":"left"}"#, "\"left\"", "-240 to 240"),
        (r#"{"as_state":2,"go_signal":{"a":1}}"#, "an object", "true or false"),
    ] {
        let said = refused(line);
        assert!(said.contains(found) && said.contains(expected), "{line}: {said}");
    }
    let long = format!("{{\"as_state\":\"{}", "x".repeat(100_000));
    assert!(refused(&long).len() < 400, "an excerpt is enough");
}

#[test]
fn only_what_is_not_at_its_default_is_written() {
    let mut inputs = Inputs::default();
    inputs.ai.status.mission_status = MissionStatus::Finished;
    inputs.vehicle.steer_angle = SteerAngle::clamped(-49);
    let line = Request::Step { dt_ms: 0, inputs }.to_string();
    assert_eq!(line, r#"{"op":"step","dt_ms":0,"mission_status":"FINISHED","steer_angle":-49}"#);
}

/// Inputs alone are an object, in which each stands once.
#[test]
fn inputs_are_read_as_they_are_written() {
    let mut inputs = Inputs::default();
    assert_eq!(InputsAsJson(inputs).to_string(), "{}");
    inputs.ai.status.mission_status = MissionStatus::Finished;
    inputs.vehicle.steer_angle = SteerAngle::clamped(-49);
    let line = InputsAsJson(inputs).to_string();
    assert_eq!(line, r#"{"mission_status":"FINISHED","steer_angle":-49}"#);
    assert_eq!(line.parse(), Ok(InputsAsJson(inputs)));
    let refused = |line: &str| line.parse::<InputsAsJson>().unwrap_err().to_string();
    assert!(refused(r#"{"go":true,"asms":true,"go":true}"#).contains("twice"));
    assert!(refused(r#"{"op":"step"}"#).contains("\"op\""));
    assert!(refused("7").contains("a JSON object"));
}

#[test]
fn inputs_that_measure_have_units() {
    let units: Vec<(&str, String)> =
        INPUTS.iter().map(|field| (field.key, (field.unit)())).filter(|(_, unit)| !unit.is_empty()).collect();
    let unit = |key: &str| units.iter().find(|(other, _)| *other == key).map(|(_, unit)| unit.as_str());
    assert_eq!((unit("steer_angle"), unit("go")), (Some("0.1 deg"), None));
    // Numbers have one, and nothing else does.
    let numbers = INPUTS.iter().filter(|field| matches!(field.domain, Domain::Number { .. }));
    assert_eq!(numbers.count(), units.len(), "{units:?}");
}
