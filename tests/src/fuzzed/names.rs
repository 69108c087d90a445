//! Names: everything that is read from a command line, and every type that is read from JSON.

use std::fmt::{Debug, Display};
use std::str::FromStr;

use adsdv_can::scenario::Scenario;
use adsdv_spec::messages::{AnyMessage, AsState, Frame, Node};
use adsdv_spec::{
    Actuation, AiMessages, Assi, Atom, Atoms, Choice, Choices, Control, Edition, Fault, Faults, Handshake,
    Inputs, Knowledge, Observation, Outputs, Reaction, Reading, Readings, Taken, Thresholds, Timing, Truth,
    UnknownName, VcuMessages,
};

use serde::Serialize;
use serde::de::DeserializeOwned;

/// The body.
pub fn body(bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    for name in text.lines() {
        named::<Atom>(name);
        named::<Fault>(name);
        named::<Reading>(name);
        named::<Choice>(name);
        if let Some(sample) = Scenario::sample(name) {
            assert!(sample.parse::<Scenario>().is_ok(), "{name} is a scenario");
        }
    }
    json(bytes);
}

/// What is read from a name has that name; what is not says what there is.
fn named<T: FromStr<Err = UnknownName> + Display + PartialEq + Debug>(name: &str) {
    match name.parse::<T>() {
        Ok(one) => assert_eq!(one.to_string(), name),
        Err(unknown) => {
            let message = unknown.to_string();
            assert!(!message.is_empty() && !message.contains(|c: char| c.is_control()), "{message:?}");
        }
    }
}

/// Whatever is read from JSON is written, and reads the same.
fn json(bytes: &[u8]) {
    same_again::<Inputs>(bytes);
    same_again::<AiMessages>(bytes);
    same_again::<Observation>(bytes);
    same_again::<Control>(bytes);
    same_again::<Handshake>(bytes);
    same_again::<Outputs>(bytes);
    same_again::<Actuation>(bytes);
    same_again::<VcuMessages>(bytes);
    same_again::<Reaction>(bytes);
    same_again::<Taken>(bytes);
    same_again::<Readings>(bytes);
    same_again::<Choices>(bytes);
    same_again::<Atoms>(bytes);
    same_again::<Faults>(bytes);
    same_again::<Knowledge>(bytes);
    same_again::<Truth>(bytes);
    same_again::<Timing>(bytes);
    same_again::<Thresholds>(bytes);
    same_again::<AnyMessage>(bytes);
    same_again::<AsState>(bytes);
    same_again::<Assi>(bytes);
    same_again::<Node>(bytes);
    same_again::<Atom>(bytes);
    same_again::<Choice>(bytes);
    same_again::<Frame>(bytes);
    if let Ok(frame) = serde_json::from_slice::<Frame>(bytes) {
        assert!(frame.is_valid(), "{frame:?}");
    }
    if let Ok(message) = serde_json::from_slice::<AnyMessage>(bytes) {
        for Edition { version, bus, .. } in Edition::ALL.iter().filter(|edition| edition.bus.holds(message)) {
            let frame = bus.encode(message).expect("what it holds has a frame");
            assert_eq!(bus.decode(frame.id, frame.data()), Ok(message), "{version}");
        }
    }
}

fn same_again<T: Serialize + DeserializeOwned + PartialEq + Debug>(bytes: &[u8]) {
    if let Ok(read) = serde_json::from_slice::<T>(bytes) {
        let written = serde_json::to_string(&read).expect("what was read can be written");
        let again: T = serde_json::from_str(&written).unwrap_or_else(|error| panic!("{written}: {error}"));
        assert_eq!(again, read, "{written}");
    }
}
