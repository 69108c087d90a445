//! The protocol: what is written is read back, its page tells all of it, and what is not in it is refused with reasons.

use std::collections::HashSet;

use adsdv_conform::protocol::{Answer, Domain, INPUTS, InputsAsJson, Protocol, Request, SHOWN, Shown};
use adsdv_spec::messages::{MessageDef, MissionStatus, SignalDef, SteerAngle};
use adsdv_spec::{Bus, Control, Edition, Inputs, Machine};

const PAGE: &str = include_str!("../PROTOCOL.md");

fn shown() -> Shown {
    let inputs = Inputs::default();
    let (_, outputs) = Machine::REFERENCE.step(&Control::INITIAL, &inputs, 10);
    Shown::of(Edition::DEFAULT, &outputs, &inputs)
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
    for protocol in Edition::ALL.iter().map(|edition| Protocol::of(edition)) {
        for (field, domain) in protocol.inputs() {
            for raw in values(domain) {
                let request = Request::Step { dt_ms: 10, inputs: with(field.key, raw) };
                let line = protocol.line(&request).to_string();
                assert_eq!(protocol.request(&line).as_ref(), Ok(&request), "{line}");
                assert_eq!((field.get)(&with(field.key, raw)), raw);
                // Names may be given as numbers.
                let number = format!("{{\"op\":\"step\",\"dt_ms\":10,\"{}\":{raw}}}", field.key);
                assert_eq!(protocol.request(&number), Ok(request), "{number}");
            }
        }
    }
    for field in INPUTS {
        for raw in [-100_000, 100_000] {
            assert!(!(field.set)(&mut Inputs::default(), raw), "{} = {raw}", field.key);
        }
    }
    assert_eq!(Request::Reset.to_string().parse(), Ok(Request::Reset));
    for edition in ["4.0", "\"2026\"", ""] {
        let hello = Request::Hello { edition: edition.to_owned() };
        assert_eq!(hello.to_string().parse(), Ok(hello));
    }
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
    let protocols: Vec<Protocol> = Edition::ALL.iter().map(|edition| Protocol::of(edition)).collect();
    let inputs = protocols.iter().flat_map(|protocol| protocol.inputs().map(|(_, domain)| domain));
    let outputs = protocols.iter().flat_map(|protocol| protocol.shown().map(|(_, domain)| domain));
    for domain in inputs.chain(outputs) {
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
    let (before, tables) = PAGE.split_once("## Inputs").unwrap();
    let (inputs, outputs) = tables.split_once("## Outputs").unwrap();
    let row = |part: &'static str, key: &str| {
        part.lines().find(|line| line.starts_with('|') && line.contains(&format!("`{key}`")))
    };
    let says = |row: &str, key: &str, domain: Domain| match domain {
        Domain::Flag => row.contains("`true`, `false`"),
        // AMI_STATE is said to be as the AMI.
        Domain::Names(_) if key == "ami_state" && row.contains("as `ami`") => true,
        Domain::Names(names) => names.iter().all(|(_, name)| row.contains(&format!("`{name}`"))),
        Domain::Number { min, max } => row.contains(&format!("{min} to {max}")),
    };
    for edition in Edition::ALL {
        let protocol = Protocol::of(edition);
        let all = protocol.inputs().map(|(field, domain)| (inputs, field.key, domain));
        for (part, key, domain) in
            all.chain(protocol.shown().map(|(field, domain)| (outputs, field.key, domain)))
        {
            let common = row(part, key).unwrap_or_else(|| panic!("{key} is not in the page"));
            // Where an edition has it otherwise, a table of these says so.
            let own = before.lines().find(|line| {
                let mut cells = line.split('|').skip(1);
                let is_key = cells.next().is_some_and(|keys| keys.contains(&format!("`{key}`")));
                is_key
                    && cells
                        .next()
                        .is_some_and(|editions| editions.split([' ', ',']).any(|one| one == edition.version))
            });
            assert!(says(own.unwrap_or(common), key, domain), "{} {key}: {common} {own:?}", edition.version);
            let has = |edition: &&&Edition| {
                let protocol = Protocol::of(edition);
                protocol.inputs().any(|(field, _)| field.key == key)
                    || protocol.shown().any(|(field, _)| field.key == key)
            };
            let having: Vec<&str> = Edition::ALL.iter().filter(has).map(|edition| edition.version).collect();
            // "2026", "4.0 and 2026", or as many with commas between them.
            let (last, others) = having.split_last().expect("an edition has it");
            let others = others.join(", ");
            let alone = if others.is_empty() { (*last).to_owned() } else { format!("{others} and {last}") };
            let alone = format!("| in {alone} alone");
            let of_some = having.len() < Edition::ALL.len();
            let expected = if of_some { format!("{alone:?}") } else { "no edition alone".to_owned() };
            assert_eq!(
                common.contains(&alone),
                of_some,
                "PROTOCOL.md, {key}: expected {expected} in {common}"
            );
            assert_eq!(
                common.contains(" alone"),
                of_some,
                "PROTOCOL.md, {key}: expected {expected} in {common}"
            );

            // How names count.
            if let Domain::Names(names) = domain {
                let own_count = own.is_some_and(|row| row.contains(" is 0"));
                let first = i32::from(matches!(key, "as_state" | "ebs") && !own_count);
                let faults = matches!(key, "op_state" | "ts_state" | "ebs_state");
                for (number, &(raw, name)) in (first..).zip(names) {
                    let counted = if faults && name.ends_with("_FAULT") { 15 } else { number };
                    assert_eq!(raw, counted, "{key}: {name}");
                }
            }
        }
    }

    let mut vcu = Machine::REFERENCE;
    let mut control = Control::INITIAL;
    let mut lines = PAGE.lines().filter(|line| line.starts_with(['>', '<']));
    while let (Some(question), Some(answer)) = (lines.next(), lines.next()) {
        let protocol = Protocol::of(vcu.edition());
        match protocol.request(&question[2..]).unwrap() {
            Request::Hello { edition } => {
                let known = Edition::find(&edition).expect("the page shows one that there is");
                assert_eq!(Answer::edition(&answer[2..]), Ok(Some(edition)));
                vcu = Machine::new(*known, known.readings);
            }
            Request::Reset => assert_eq!(&answer[2..], "{}"),
            request @ Request::Step { dt_ms, inputs } => {
                assert_eq!(protocol.line(&request).to_string(), question[2..], "in the edition's own words");
                let (after, outputs) = vcu.step(&control, &inputs, dt_ms);
                control = after;
                let answer = protocol.answer(&answer[2..]).unwrap();
                assert!(answer.agrees(&Shown::of(vcu.edition(), &outputs, &inputs)), "{answer:?}");
            }
        }
    }
    assert_ne!(control, Control::INITIAL);
}

/// What an edition does not have is neither written nor understood, and is no key that is expected.
#[test]
fn what_an_edition_does_not_have_is_an_unknown_key_there() {
    let (older, newer) = (Protocol::of(&Edition::V3_0), Protocol::of(&Edition::V4_0));
    let key = "drive_r_silence_ms";
    let step = Request::Step { dt_ms: 10, inputs: with(key, 100) };
    assert_eq!(newer.line(&step).to_string(), r#"{"op":"step","dt_ms":10,"drive_r_silence_ms":100}"#);
    assert_eq!(older.line(&step).to_string(), r#"{"op":"step","dt_ms":10}"#);
    assert_eq!(step.to_string(), older.line(&step).to_string());
    let refused = older.request(&newer.line(&step).to_string()).unwrap_err().to_string();
    assert!(refused.starts_with("there is no key \"drive_r_silence_ms\""), "{refused}");
    assert_eq!(refused.matches(key).count(), 1, "{refused}");

    let flag = r#"{"as_state":"AS_OFF","brake_plausibility_fault":true}"#;
    assert!(newer.answer(flag).is_ok());
    let refused = older.answer(flag).unwrap_err().to_string();
    assert_eq!(refused.matches("brake_plausibility_fault").count(), 1, "{refused}");
    for edition in Edition::ALL {
        let protocol = Protocol::of(edition);
        let inputs = Inputs::default();
        let (_, outputs) = Machine::new(**edition, edition.readings).step(&Control::INITIAL, &inputs, 10);
        let shown = Shown::of(edition, &outputs, &inputs);
        let keys: Vec<&str> = protocol.shown().map(|(field, _)| field.key).collect();
        assert_eq!(shown.iter().map(|(field, _)| field.key).collect::<Vec<_>>(), keys);
        assert_eq!(Answer::from(shown).keys().collect::<Vec<_>>(), keys);
        // The flags are the signals of 520h, and its signals are the flags.
        for field in SHOWN.iter().filter(|field| field.fault.is_some()) {
            let signal = edition.bus.message(0x520).and_then(|status| status.signal_of(field.key));
            assert_eq!(keys.contains(&field.key), signal.is_some(), "{} {}", edition.version, field.key);
        }
    }
}

/// Those whose 520h has neither AS_INIT nor the states of the vehicle, which came with the database of 2026.
const BEFORE_2026: [Edition; 2] = [Edition::V3_0, Edition::V4_0];

/// What the database of 2026 added to 520h is an output since then.
#[test]
fn the_states_of_the_vehicle_are_outputs_where_520h_has_them() {
    for edition in Edition::ALL {
        let has = !BEFORE_2026.contains(edition);
        let protocol = Protocol::of(edition);
        for (key, name, raw) in
            [("op_state", "OP_CHARGE", 3), ("ts_state", "TS_FAULT", 15), ("ebs_state", "EBS_ARMED", 2)]
        {
            let line = format!(r#"{{"as_state":"AS_OFF","{key}":"{name}"}}"#);
            let answer = protocol.answer(&line);
            assert_eq!(answer.is_ok(), has, "{} {line}", edition.version);
            let value = answer.ok().and_then(|answer| answer.get(key)?.raw);
            assert_eq!(value, has.then_some(raw));
        }
    }
    let answer = Protocol::of(&Edition::V2026).answer(r#"{"as_state":"AS_OFF","op_state":255}"#).unwrap();
    assert!(is_foreign(&answer, "op_state"));
}

/// Whether an answer has a value that the field does not have.
fn is_foreign(answer: &Answer, key: &str) -> bool {
    let value = answer.get(key).expect("it says something of it");
    !value.raw.is_some_and(|raw| value.domain.has(raw))
}

/// AS_INIT of 2026 counts as AS_OFF, by its name and by its number; no other edition knows it.
#[test]
fn as_init_is_read_as_as_off() {
    let inputs = Inputs::default();
    for edition in Edition::ALL {
        let (_, outputs) = Machine::new(**edition, edition.readings).step(&Control::INITIAL, &inputs, 10);
        let shown = Shown::of(edition, &outputs, &inputs);
        assert!(shown.to_string().starts_with(r#"{"as_state":"AS_OFF""#), "{shown}");
        for line in [r#"{"as_state":"AS_INIT"}"#, r#"{"as_state":0}"#] {
            let answer = Protocol::of(edition).answer(line);
            let reads = !BEFORE_2026.contains(edition);
            assert_eq!(answer.is_ok_and(|answer| answer.agrees(&shown)), reads, "{} {line}", edition.version);
        }
    }
}

/// An edition spells names as its document does, and understands those of the first one.
#[test]
fn names_are_the_edition_s_own_or_those_of_the_first() {
    let newer = Protocol::of(&Edition::V4_0);
    for cause in ["AI_COMMS_FAULT", "AI COMMS FAULT"] {
        let answer = newer.answer(&format!(r#"{{"as_state":"AS_OFF","shutdown_cause":"{cause}"}}"#)).unwrap();
        assert_eq!(answer.get("shutdown_cause").unwrap().to_string(), "AI_COMMS_FAULT");
    }
    let answer = newer.answer(r#"{"as_state":"AS_OFF","shutdown_cause":11}"#).unwrap();
    assert_eq!(answer.get("shutdown_cause").unwrap().to_string(), "BRAKE_PLAUSIBILITY_FAULT");
    let older = Protocol::of(&Edition::V3_0);
    for cause in ["AI_COMMS_FAULT", "AI COMMS FAULT"] {
        let answer = older.answer(&format!(r#"{{"as_state":"AS_OFF","shutdown_cause":"{cause}"}}"#)).unwrap();
        assert_eq!(answer.get("shutdown_cause").unwrap().to_string(), "AI COMMS FAULT");
    }
    for cause in [r#""BRAKE_PLAUSIBILITY_FAULT""#, "11"] {
        let answer = older.answer(&format!(r#"{{"as_state":"AS_OFF","shutdown_cause":{cause}}}"#)).unwrap();
        assert!(is_foreign(&answer, "shutdown_cause"), "{cause}");
    }
    for mission in ["TRACK DRIVE", "TRACK_DRIVE"] {
        let step = newer.request(&format!(r#"{{"op":"step","dt_ms":10,"ami":"{mission}"}}"#)).unwrap();
        assert_eq!(newer.line(&step).to_string(), r#"{"op":"step","dt_ms":10,"ami":"TRACK DRIVE"}"#);
        assert_eq!(older.line(&step).to_string(), r#"{"op":"step","dt_ms":10,"ami":"TRACK_DRIVE"}"#);
    }
    // A range is its own alone.
    assert!(is_foreign(&newer.answer(r#"{"as_state":"AS_OFF","steer":240}"#).unwrap(), "steer"));
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
        (r#"{"op":"hello"}"#, "no \"edition\"", "a version"),
        (r#"{"op":"hello","edition":4}"#, "4", "\"3.0\""),
        (r#"{"op":"hello","edition":"4.0","edition":"4.0"}"#, "twice", "once"),
        (r#"{"op":"hello","edition":"4.0","op":"hello"}"#, "twice", "once"),
        (r#"{"op":"hello","edition":"4.0","go":true}"#, "\"go\"", "op, edition"),
        (r#"{"op":"step"}"#, "no \"dt_ms\"", "milliseconds"),
        (r#"{"op":"step","dt_ms":-1}"#, "-1", "a whole number from 0"),
        (r#"{"op":"step","dt_ms":1.5}"#, "1.5, which has a point", "a whole number from 0"),
        (r#"{"op":"step","dt_ms":10.0}"#, "10.0, which has a point", "a whole number from 0"),
        (
            r#"{"op":"step","dt_ms":99999999999999999999}"#,
            "1e20, which is too large",
            "a whole number from 0",
        ),
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

/// Each edition has its own ranges and names, in what is asked and in what is answered.
#[test]
fn a_line_is_read_as_its_edition_has_it() {
    let mut message: MessageDef = *Edition::V3_0.bus.message(0x513).expect("AI2VCU_Steer");
    let mut signal: SignalDef = message.signals[0];
    (signal.min, signal.max) = (-300, 300);
    message.signals = Vec::leak(vec![signal]);
    let message: &MessageDef = Box::leak(Box::new(message));
    let others = Edition::V3_0.bus.messages.iter().copied().filter(|other| other.id != message.id);
    let messages: &[&MessageDef] = Vec::leak(others.chain([message]).collect());
    let bus = Bus { messages, ..Edition::V3_0.bus };
    let wider = Protocol::of(&Edition { version: "test", bus, ..Edition::V3_0 });
    let usual = Protocol::of(&Edition::V3_0);
    let request = r#"{"op":"step","dt_ms":1,"steer_request":-300}"#;
    let answer = r#"{"as_state":"AS_DRIVING","steer":-300}"#;
    assert!(wider.request(request).is_ok() && wider.answer(answer).is_ok());
    let said = usual.request(request).expect_err("3.0 has no such angle").to_string();
    assert!(said.contains("-300") && said.contains("-240 to 240"), "{said}");
    let is_foreign_to = |protocol: &Protocol| is_foreign(&protocol.answer(answer).unwrap(), "steer");
    assert_eq!([&wider, &usual].map(is_foreign_to), [false, true]);
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
        (r#"{"as_state":true}"#, "true", "\"AS_READY\""),
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
