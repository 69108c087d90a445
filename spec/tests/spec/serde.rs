//! What is serialised stays readable: every name is the one that people see, and what contradicts is refused.

use adsdv_spec::messages::{
    DecodeError, DirectionRequest, Frame, GivenValue, MissionStatus, Node, SteerAngle,
};
use adsdv_spec::{
    AiMessages, AsState, Assi, Atom, Atoms, Bus, Choice, Choices, Control, Edition, Fault, Faults, Inputs,
    Knowledge, Machine, Observation, Reaction, Reading, Readings, Taken, Thresholds, Timing, Truth,
    UnknownName,
};
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::{Value, from_value, json, to_value};
use std::fmt::Debug;

fn written(value: &impl Serialize) -> Value {
    to_value(value).expect("every value can be written")
}

/// What is written reads back the same, as JSON, whose keys are texts.
#[track_caller]
fn round_trip<T: Serialize + DeserializeOwned + PartialEq + Debug>(value: &T) {
    let text = serde_json::to_string(value).expect("every value can be written");
    let read: T = serde_json::from_str(&text).unwrap_or_else(|error| panic!("{text}: {error}"));
    assert_eq!(&read, value, "{text}");
}

/// The error that reading this gives.
#[track_caller]
fn refused<T: DeserializeOwned + Debug>(value: &Value) -> String {
    match T::deserialize(value) {
        Ok(read) => panic!("{value} is read as {read:?}"),
        Err(error) => error.to_string(),
    }
}

// Names

const BUS: Bus = Edition::V3_0.bus;

#[test]
fn the_names_of_atoms() {
    assert_eq!(
        written(&Atom::ALL),
        json!([
            "sdc-open",
            "ebs-timer-complete",
            "asms",
            "tsms",
            "ami-selected",
            "mission-selected",
            "mission-running",
            "mission-finished",
            "mission-finished-edge",
            "ebs-armed",
            "ebs-unavailable",
            "dwell-elapsed",
            "front-torque-zero",
            "rear-torque-zero",
            "brake-request-zero",
            "steer-request-zero",
            "steer-straight",
            "direction-neutral",
            "direction-neutral-edge",
            "go-on",
            "go-edge",
            "moving",
            "at-rest",
            "ai-handshake",
            "ai-messages-missed",
            "ai-comms-lost",
            "ai-estop",
            "bms-fault",
            "power-cycle-needed",
        ])
    );
}

#[test]
fn the_names_of_readings_and_choices() {
    assert_eq!(
        written(&Reading::ALL),
        json!([
            "mission-selected",
            "fault-trigger",
            "ready-priority",
            "finished-priority",
            "driving-priority",
            "go-edge",
            "go-signal",
            "handshake-active",
            "ai-estop",
            "comms-lost",
            "power-cycle",
            "message-watch",
            "torque-control",
            "bms-fault",
        ])
    );
    assert_eq!(
        written(&Choice::ALL),
        json!([
            "mission-selected=both",
            "mission-selected=ami",
            "mission-selected=status",
            "fault-trigger=level",
            "fault-trigger=edge",
            "ready-priority=emergency-brake",
            "ready-priority=as-off",
            "finished-priority=emergency-brake",
            "finished-priority=as-off",
            "driving-priority=emergency-brake",
            "driving-priority=as-finished",
            "go-edge=seen-low",
            "go-edge=edge",
            "go-signal=accepted",
            "go-signal=raw",
            "handshake-active=tsms",
            "handshake-active=always",
            "ai-estop=every-state",
            "ai-estop=driving",
            "comms-lost=every-state",
            "comms-lost=no-arrow",
            "comms-lost=driving",
            "power-cycle=latched",
            "power-cycle=not-latched",
            "message-watch=handshake",
            "message-watch=always",
            "torque-control=always",
            "torque-control=never",
            "bms-fault=sdc",
            "bms-fault=driving",
        ])
    );
}

#[test]
fn the_names_of_faults_are_their_flags() {
    assert_eq!(
        written(&Fault::ALL),
        json!([
            "AI_ESTOP_REQUEST",
            "HVIL_OPEN_FAULT",
            "HVIL_SHORT_FAULT",
            "EBS_FAULT",
            "OFFBOARD_CHARGER_FAULT",
            "AI_COMMS_LOST",
            "AUTONOMOUS_BRAKING_FAULT",
            "MISSION_STATUS_FAULT",
            "CHARGE_PROCEDURE_FAULT",
            "BMS_FAULT",
            "BRAKE_PLAUSIBILITY_FAULT",
        ])
    );
}

#[test]
fn the_names_of_states_lights_and_truths() {
    assert_eq!(
        written(&AsState::ALL),
        json!(["AS_OFF", "AS_READY", "AS_DRIVING", "EMERGENCY_BRAKE", "AS_FINISHED"])
    );
    assert_eq!(
        written(&AsState::ALL.map(Assi::of)),
        json!(["off", "yellow-continuous", "yellow-flashing", "blue-flashing", "blue-continuous"])
    );
    for truth in [Truth::False, Truth::Unknown, Truth::True] {
        assert_eq!(written(&truth), json!(truth.name()));
    }
    for node in [Node::Ai, Node::Vcu] {
        assert_eq!(written(&node), json!(node.name()));
    }
}

#[test]
fn a_name_is_displayed_as_it_is_written_and_read_as_it_is_displayed() {
    fn check<T>(all: &[T])
    where
        T: Serialize + DeserializeOwned + PartialEq + Debug + std::fmt::Display,
        T: std::str::FromStr<Err = UnknownName>,
    {
        for one in all {
            round_trip(one);
            assert_eq!(written(one), json!(one.to_string()));
            assert_eq!(one.to_string().parse().as_ref(), Ok(one));
        }
    }
    check(Atom::ALL);
    check(Reading::ALL);
    check(Choice::ALL);
    check(Fault::ALL);
}

#[test]
fn a_name_that_is_none_is_refused_with_what_would_be_one() {
    let error = refused::<Atom>(&json!("ASMS"));
    assert!(error.starts_with("\"ASMS\": no such atom; expected one of sdc-open, "), "{error}");
    let error = refused::<Fault>(&json!("AiCommsFault"));
    assert!(error.contains("no such fault; expected one of AI_ESTOP_REQUEST, "), "{error}");
    let error = refused::<Choice>(&json!("mission-selected"));
    assert!(
        error.contains("expected reading=choice, such as fault-trigger=edge; readings: mission-sel"),
        "{error}"
    );
    let error = refused::<Choice>(&json!("mission=ami"));
    assert!(error.contains("no such reading; expected one of mission-selected, "), "{error}");
    let error = refused::<Choice>(&json!("fault-trigger=ami"));
    assert!(error.ends_with("no such choice of fault-trigger; expected one of level, edge"), "{error}");
    assert!(refused::<Atom>(&json!(3)).contains("the id of an atom"));
}

// Sets

#[test]
fn a_set_is_a_list_of_names() {
    let atoms = Atoms::of(&[Atom::Tsms, Atom::Asms]);
    assert_eq!(written(&atoms), json!(["asms", "tsms"]));
    assert_eq!(atoms.to_string(), "asms tsms");
    assert_eq!(from_value::<Atoms>(json!(["tsms", "asms"])).ok(), Some(atoms));
    assert_eq!(written(&Faults::of(&[Fault::BmsFault, Fault::EbsFault])), json!(["EBS_FAULT", "BMS_FAULT"]));
    assert_eq!(written(&Choices::of(&[Choice::MissionStatusOnly])), json!(["mission-selected=status"]));
    for set in [Atoms::NONE, Atoms::ALL, atoms] {
        round_trip(&set);
    }
    for set in [Faults::NONE, Faults::ALL, Faults::OPENING] {
        round_trip(&set);
    }
    for set in [Choices::NONE, Choices::ALL, Readings::DEFAULT.choices()] {
        round_trip(&set);
    }
}

#[test]
fn a_set_is_neither_bits_nor_a_list_with_a_name_twice() {
    assert!(refused::<Atoms>(&json!(5)).contains("a list with the name of each atom"));
    assert!(refused::<Choices>(&json!(5)).contains("a list with the name of each choice"));
    assert!(refused::<Atoms>(&json!(["asms", "tsms", "asms"])).contains("asms is in the list twice"));
    assert!(refused::<Faults>(&json!(["EBS_FAULT", "none"])).contains("no such fault"));
}

#[test]
fn readings_are_a_map() {
    let readings = Readings::DEFAULT.with(Choice::FaultEdge);
    assert_eq!(from_value::<Readings>(json!({"fault-trigger": "edge"})).ok(), Some(readings));
    assert_eq!(written(&readings)["fault-trigger"], "edge");
    assert_eq!(written(&readings)["comms-lost"], "every-state");
    for answers in Choices::ALL.combinations(&[Reading::MissionSelected, Reading::FaultTrigger]) {
        round_trip(&answers);
    }
    assert!(
        refused::<Readings>(&json!({"fault-trigger": "ami"})).contains("no such choice of fault-trigger")
    );
    assert!(refused::<Readings>(&json!({"trigger": "edge"})).contains("no such reading"));
    for twice in ["level", "edge"] {
        let text = format!(r#"{{"fault-trigger": "edge", "go-edge": "edge", "fault-trigger": "{twice}"}}"#);
        let error = serde_json::from_str::<Readings>(&text).expect_err("answered twice").to_string();
        assert!(error.contains("fault-trigger is answered twice"), "{error}");
    }
    for (value, expected) in [
        (json!(["edge"]), "expected a map of reading to choice, such as {\"fault-trigger\": \"edge\"}"),
        (json!({"fault-trigger": true}), "expected a choice of the reading fault-trigger"),
    ] {
        let error = refused::<Readings>(&value);
        assert!(error.ends_with(expected), "{error}");
    }
}

// Values

#[test]
fn knowledge_does_not_contradict_itself() {
    let known = Knowledge::NOTHING.set(Atom::Asms, Truth::True).set(Atom::Tsms, Truth::False);
    assert_eq!(written(&known), json!({"on": ["asms"], "off": ["tsms"]}));
    for knowledge in [known, Knowledge::NOTHING, Knowledge::exact(Atoms::of(&[Atom::GoOn]))] {
        round_trip(&knowledge);
    }
    let error = refused::<Knowledge>(&json!({"on": ["asms", "tsms"], "off": ["go-on", "tsms"]}));
    assert!(error.contains("both on and off: tsms;"), "{error}");
    assert!(refused::<Knowledge>(&json!({"on": [], "of": []})).contains("unknown field"));
}

#[test]
fn a_frame_is_one_that_can_be_on_the_bus() {
    let frame = Frame::new(0x513, &[1, 2]).expect("a frame");
    assert_eq!(written(&frame), json!({"id": 0x513, "len": 2, "data": [1, 2, 0, 0, 0, 0, 0, 0]}));
    for frame in [frame, Frame::default(), Frame::new(0x7FF, &[0xFF; 8]).expect("a frame")] {
        assert!(frame.is_valid());
        round_trip(&frame);
    }
    let with = |id: u16, len: u8, data: [u8; 8]| json!({"id": id, "len": len, "data": data});
    assert!(refused::<Frame>(&with(0x800, 0, [0; 8])).contains("11 bits"));
    assert!(refused::<Frame>(&with(0x513, 9, [0; 8])).contains("0 to 8"));
    assert!(refused::<Frame>(&with(0x7FF, 9, [0; 8])).contains("0 to 8"));
    assert!(refused::<Frame>(&with(0x513, 2, [1, 2, 3, 0, 0, 0, 0, 0])).contains("zero from len on"));
    assert!(refused::<Frame>(&json!({"id": 0, "len": 0, "data": [0, 0]})).contains("length"));
}

#[test]
fn inputs_list_only_what_differs_from_the_default() {
    let mut expected = Inputs::default();
    expected.ai.status.mission_status = MissionStatus::Selected;
    let given = json!({"ai": {"status": {"mission_status": "SELECTED"}}});
    assert_eq!(from_value::<Inputs>(given).ok(), Some(expected));
    expected.ai.status.direction_request = DirectionRequest::Forward;
    expected.vehicle.steer_angle = SteerAngle::clamped(-12);
    round_trip(&expected);
    assert_eq!(from_value::<AiMessages>(json!({})).ok(), Some(AiMessages::default()));
}

#[test]
fn a_field_that_is_none_is_refused() {
    for given in [
        json!({"asm": true}),
        json!({"sdc": {"estop": true}}),
        json!({"reports": {"ebs": true}}),
        json!({"ai": {"Status": {}}}),
        json!({"ai": {"status": {"mission": "SELECTED"}}}),
        json!({"vehicle": {"steer": 0}}),
        json!({"vehicle": {"wheel_speeds": {"fl": 0}}}),
    ] {
        let error = refused::<Inputs>(&given);
        assert!(error.contains("unknown field"), "{given}: {error}");
    }
    let mut timing = written(&Edition::V3_0.rules.timing);
    timing["dwell"] = json!(5);
    assert!(refused::<Timing>(&timing).contains("unknown field"));
    assert!(refused::<Thresholds>(&json!({"wheel_speed": 1251, "straight": 50})).contains("1251 rpm"));
}

#[test]
fn what_a_step_takes_and_gives_round_trips() {
    let vcu = Machine::REFERENCE;
    let inputs = Inputs { asms: true, tsms: true, go: true, ..Inputs::default() };
    let (control, outputs) = vcu.step(&Control::INITIAL, &inputs, 10);
    let observation = inputs.observe(&Edition::V3_0.rules.thresholds);
    let taken = Some(Taken { row: 1, term: 2 });
    let reaction = Reaction { taken, ..vcu.react(&Control::INITIAL, observation, 10) };
    round_trip(&control);
    round_trip(&outputs);
    round_trip(&outputs.actuation(&inputs));
    round_trip(&outputs.messages(&inputs));
    round_trip(&observation);
    round_trip(&reaction);
    round_trip(&Observation::default());
    round_trip(&Edition::V3_0.rules.timing);
    round_trip(&Edition::V3_0.rules.thresholds);
    for frame in outputs.messages(&inputs).frames(&BUS) {
        round_trip(&frame);
        round_trip(&BUS.decode(frame.id, frame.data()).expect("what the VCU sends"));
    }
}

// What can only be written

#[test]
fn the_table_is_a_list_of_arrows() {
    let table = written(&Edition::V3_0.rules.table);
    assert_eq!(table.as_array().map(Vec::len), Some(Edition::V3_0.rules.table.rows().len()));
    assert_eq!(
        table[2],
        json!({
            "from": "AS_READY",
            "to": "AS_OFF",
            "section": "3.6",
            "cites": {"requirements": ["SM-10", "RTO-1"], "conditions": [], "order": ["D-22"]},
            "terms": [{
                "on": [],
                "off": ["asms"],
                "readings": [],
                "fault": null,
                "section": "3.6",
                "cites": {"requirements": [], "conditions": [], "order": []},
            }],
        })
    );
    assert_eq!(table[1]["terms"][1]["fault"], "AI_COMMS_LOST");
    assert_eq!(table[1]["terms"][1]["readings"], json!(["comms-lost=every-state"]));
    let edition = written(&Edition::V3_0);
    assert_eq!(edition["version"], "3.0");
    assert_eq!(edition["rules"]["table"], table);
    assert_eq!(edition["rules"]["timing"]["ebs_timer_ms"], 15000);
    assert_eq!(edition["rules"]["thresholds"], json!({"wheel_speed": 10, "straight": 50, "missed_ms": null}));
    assert_eq!(
        edition["rules"]["priorities"][0],
        json!({"choice": "ready-priority=as-off", "from": "AS_READY", "first": "AS_OFF"})
    );
}

#[test]
fn the_messages_are_written_with_their_signals() {
    let messages = written(&BUS)["messages"].clone();
    let status = messages.as_array().and_then(|all| all.iter().find(|one| one["id"] == 0x520));
    let status = status.expect("520h");
    assert_eq!((&status["name"], &status["sender"]), (&json!("VCU2AI_Status"), &json!("VCU")));
    let state = status["signals"].as_array().and_then(|all| all.iter().find(|one| one["name"] == "AS_STATE"));
    let state = state.expect("a signal of 520h");
    assert_eq!(state["values"][0], json!([1, "AS_OFF"]));
    assert_eq!(state["scale"], json!({"num": 1, "den": 1}));
}

#[test]
fn an_error_is_its_fields() {
    assert_eq!(written(&DecodeError::UnknownId { id: 0x527 }), json!({"unknown-id": {"id": 0x527}}));
    let short = BUS.decode(0x513, &[0]).expect_err("too short");
    assert_eq!(
        written(&short),
        json!({"too-short": {
            "message": "AI2VCU_Steer",
            "id": 0x513,
            "given": 1,
            "needed": 2,
            "signal": "STEER_REQUEST_deg",
        }})
    );
    let value = written(&BUS.decode(0x513, &[0xF1, 0]).expect_err("too far"));
    assert_eq!(value["value"]["given"], 241);
    assert_eq!(value["value"]["def"]["max"], 240);
    let error = SteerAngle::from_raw(301).expect_err("too far");
    assert_eq!(written(&error)["given"], json!({"raw": 301}));
    assert_eq!(written(&error)["unit"], "deg");
    assert_eq!(written(&GivenValue::Physical(0.5)), json!({"physical": 0.5}));
    assert_eq!(written(&UnknownName::ChoiceOf(Reading::GoEdge)), json!({"choice-of": "go-edge"}));
}
