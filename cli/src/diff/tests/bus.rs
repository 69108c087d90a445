//! Messages, signals and reserved identifiers.

use std::ops::RangeInclusive;

use adsdv_spec::Reserved;
use adsdv_spec::messages::{Device, DeviceMessage, MessageDef, Node, ReadAs, SignalDef};

use super::super::change::Property;
use super::super::messages::{OF_A_MESSAGE, OF_A_SIGNAL};
use super::*;

/// The only change of a signal of 513h.
fn of_the_signal(change: impl FnOnce(&mut SignalDef)) -> Value {
    let json = changed(&with_signals(0x513, |signals| change(&mut signals[0])));
    let signals = &json["messages"]["changed"][0]["signals"];
    let changes = signals["changed"][0]["changes"].clone();
    let name = signals["changed"][0]["name"].clone();
    let signals = only_changed(&json!({ "name": name, "changes": changes }));
    let message = json!({ "id": 0x513, "name": "AI2VCU_Steer", "changes": [], "signals": signals });
    assert_eq!(json, json!({ "messages": only_changed(&message) }), "and nothing else");
    changes
}

/// The only change of 513h.
fn of_the_message(change: impl FnOnce(&mut MessageDef)) -> Value {
    let json = changed(&with_message(0x513, change));
    let message = &json["messages"]["changed"][0];
    let no_signals = json!({ "new": [], "gone": [], "changed": [] });
    let expected = json!({
        "id": 0x513, "name": message["name"], "changes": message["changes"], "signals": no_signals
    });
    assert_eq!(json, json!({ "messages": only_changed(&expected) }), "and nothing else");
    message["changes"].clone()
}

fn one(property: &str, from: &Value, to: &Value) -> Value {
    json!([{ "property": property, "from": from, "to": to }])
}

#[test]
fn each_property_of_a_message_is_compared() {
    let name = of_the_message(|message| message.name = "Wheel");
    assert_eq!(name, one("name", &json!("AI2VCU_Steer"), &json!("Wheel")));
    let sender = of_the_message(|message| message.sender = Node::Vcu);
    assert_eq!(sender, one("sender", &json!("AI"), &json!("VCU")));
    assert_eq!(of_the_message(|message| message.len = 7), one("length", &json!(2), &json!(7)));
    assert_eq!(of_the_message(|message| message.cycle_ms = 20), one("cycle_ms", &json!(10), &json!(20)));
    let section = of_the_message(|message| message.section = "2.9");
    assert_eq!(section, one("section", &json!("2.1"), &json!("2.9")));
    assert_eq!(of_the_message(|message| message.doc = "Else.")[0]["property"], "meaning");
}

#[test]
fn each_property_of_a_signal_is_compared() {
    let name = of_the_signal(|signal| signal.name = "Angle");
    assert_eq!(name, one("name", &json!("STEER_REQUEST"), &json!("Angle")));
    let bits = |start, width| json!({ "start": start, "width": width });
    assert_eq!(of_the_signal(|signal| signal.start = 1), one("bits", &bits(0, 16), &bits(1, 16)));
    assert_eq!(of_the_signal(|signal| signal.width = 15), one("bits", &bits(0, 16), &bits(0, 15)));
    let signed = of_the_signal(|signal| signal.signed = false);
    assert_eq!(signed, one("signed", &json!(true), &json!(false)));
    let scale = of_the_signal(|signal| signal.scale = adsdv_spec::messages::Scale::ONE);
    assert_eq!(scale, one("scale", &json!({ "num": 1, "den": 10 }), &json!({ "num": 1, "den": 1 })));
    assert_eq!(of_the_signal(|signal| signal.unit = "rad"), one("unit", &json!("deg"), &json!("rad")));
    let range = |min, max| json!({ "min": min, "max": max });
    assert_eq!(of_the_signal(|signal| signal.min = -1), one("range", &range(-210, 210), &range(-1, 210)));
    assert_eq!(of_the_signal(|signal| signal.max = 211), one("range", &range(-210, 210), &range(-210, 211)));
    let values = of_the_signal(|signal| signal.values = &[(1, "left")]);
    assert_eq!(values, one("values", &json!([]), &json!([{ "value": 1, "name": "left" }])));
    let read_as = of_the_signal(|signal| signal.read_as = Some(ReadAs { raw: 0, meaning: 1 }));
    assert_eq!(read_as, one("read_as", &Value::Null, &json!({ "raw": 0, "meaning": 1 })));
    assert_eq!(of_the_signal(|signal| signal.doc = "Else.")[0]["property"], "meaning");
}

/// Neither type can be taken apart here field by field, so that what serde knows of it tells.
#[test]
fn no_field_of_a_message_or_a_signal_is_left_out() {
    fn fields<T>(properties: &[Property<T>], others: &[&'static str]) -> Vec<&'static str> {
        let shown = properties.iter().flat_map(|property| property.fields.iter().copied());
        let mut fields: Vec<_> = shown.chain(others.iter().copied()).collect();
        fields.sort_unstable();
        fields
    }
    let keys = |thing: Value| {
        let mut keys: Vec<_> = thing.as_object().expect("an object").keys().cloned().collect();
        keys.sort_unstable();
        keys
    };
    let message = BEFORE.bus.messages[0];
    let of_a_message = keys(serde_json::to_value(message).expect("JSON"));
    assert_eq!(
        fields(OF_A_MESSAGE, &["id", "requirements", "signals"]),
        of_a_message,
        "compare each in messages.rs"
    );
    let of_a_signal = keys(serde_json::to_value(message.signals[0]).expect("JSON"));
    assert_eq!(fields(OF_A_SIGNAL, &["field", "requirements"]), of_a_signal, "compare each in messages.rs");
}

#[test]
fn a_message_is_new_or_gone_by_its_identifier() {
    let json = changed(&with_messages(|messages| messages.retain(|message| message.id != 0x513)));
    let gone = &json["messages"]["gone"];
    assert_eq!((&gone[0]["id"], &gone[0]["signals"][0]["name"]), (&json!(0x513), &json!("STEER_REQUEST")));
    assert_eq!(json, json!({ "messages": { "new": [], "gone": [gone[0]], "changed": [] } }));
    let json = changed(&with_message(0x513, |message| message.id = 0x533));
    assert_eq!(
        (&json["messages"]["new"][0]["id"], &json["messages"]["gone"][0]["id"]),
        (&json!(0x533), &json!(0x513))
    );
}

#[test]
fn a_signal_is_new_or_gone() {
    let signals = |json: &Value| json["messages"]["changed"][0]["signals"].clone();
    let without = changed(&with_signals(0x514, |signals| _ = signals.remove(0)));
    assert_eq!(signals(&without)["gone"][0]["name"], "HYD_PRESS_F_REQ_pct");
    assert!(is_empty(&signals(&without)["new"]) && is_empty(&signals(&without)["changed"]));
    let more = changed(&with_signals(0x514, |signals| {
        let more = signals[0];
        signals.push(more);
    }));
    assert_eq!(signals(&more)["new"][0]["name"], "HYD_PRESS_F_REQ_pct");
    assert!(is_empty(&signals(&more)["gone"]) && is_empty(&signals(&more)["changed"]));
}

/// The signal of 513h, changed in these ways before and after, as the names that are new, gone and changed.
fn matched(before: fn(&mut SignalDef), after: fn(&mut SignalDef)) -> [usize; 3] {
    let (before, after) =
        (with_signals(0x513, |s| before(&mut s[0])), with_signals(0x513, |s| after(&mut s[0])));
    let json = serde_json::to_value(Difference::between(&before, &after)).expect("JSON");
    let signals = &json["messages"]["changed"][0]["signals"];
    ["new", "gone", "changed"].map(|side| signals[side].as_array().map_or(0, Vec::len))
}

#[test]
fn a_signal_is_the_same_by_its_field_and_without_one_by_its_name_and_then_its_bits() {
    let moved_and_renamed: fn(&mut SignalDef) = |signal| (signal.start, signal.name) = (8, "Other");
    assert_eq!(matched(|_| (), moved_and_renamed), [0, 0, 1]);
    assert_eq!(matched(|_| (), |signal| signal.field = "other"), [1, 1, 0]);
    let bare: fn(&mut SignalDef) = |signal| signal.field = "";
    assert_eq!(matched(bare, |signal| (signal.start, signal.field) = (8, "")), [0, 0, 1]);
    assert_eq!(matched(bare, |signal| (signal.name, signal.field) = ("Other", "")), [0, 0, 1]);
    assert_eq!(matched(bare, |signal| (signal.name, signal.max) = ("Other", 5)), [0, 0, 1]);
    assert_eq!(
        matched(bare, |signal| (signal.name, signal.start, signal.field) = ("Other", 8, "")),
        [1, 1, 0]
    );
    assert_eq!(matched(|_| (), bare), [0, 0, 0], "what carries it is no difference of the interface");
}

/// Two signals without a field that changed names stay apart from one that kept its own.
#[test]
fn a_name_counts_before_the_bits() {
    let bare = |names: [&'static str; 2]| {
        with_signals(0x514, |signals| {
            for (signal, name) in signals.iter_mut().zip(names) {
                (signal.field, signal.name) = ("", name);
            }
        })
    };
    let difference = Difference::between(&bare(["a", "b"]), &bare(["b", "a"]));
    let json = serde_json::to_value(difference).expect("JSON");
    let changes = &json["messages"]["changed"][0]["signals"]["changed"];
    assert_eq!((&changes[0]["name"], &changes[0]["changes"][0]["property"]), (&json!("a"), &json!("bits")));
}

#[test]
fn reserved_identifiers_are_new_and_gone_however_the_ranges_are_cut() {
    let with = |ranges: &[RangeInclusive<u16>]| {
        let reserved = ranges.iter().map(|ids| Reserved { ids: ids.clone(), requirements: &[] });
        let mut edition = *BEFORE;
        edition.bus.reserved = reserved.collect::<Vec<_>>().leak();
        edition
    };
    let (one, cut, other) = (
        with(&[0x100..=0x104]),
        with(&[0x100..=0x101, 0x102..=0x104]),
        with(&[0x101..=0x102, 0x104..=0x106]),
    );
    assert!(!Difference::between(&one, &cut).differs);
    let json = serde_json::to_value(Difference::between(&one, &other)).expect("JSON");
    let range = |first, last| json!({ "first": first, "last": last });
    let expected =
        json!({ "new": [range(0x105, 0x106)], "gone": [range(0x100, 0x100), range(0x103, 0x103)] });
    assert_eq!(json["reserved"], expected);
}

#[test]
fn a_message_of_a_device_that_changes_is_new_and_gone() {
    let [first, .., last] = Edition::V2026.bus.devices else { panic!("devices") };
    let with = |devices: &[DeviceMessage]| {
        let mut edition = *BEFORE;
        edition.bus.devices = devices.to_vec().leak();
        edition
    };
    let json = |from: &[DeviceMessage], to: &[DeviceMessage]| {
        let json = serde_json::to_value(Difference::between(&with(from), &with(to))).expect("JSON");
        let ids = |side: &str| {
            let messages = json["devices"][side].as_array().cloned().unwrap_or_default();
            messages.iter().map(|message| message["id"].as_u64()).collect::<Vec<_>>()
        };
        (json["differs"].clone(), ids("new"), ids("gone"))
    };
    let id = |message: &DeviceMessage| Some(u64::from(message.id));
    assert_eq!(json(&[*first, *last], &[*first]), (json!(true), vec![], vec![id(last)]));
    assert_eq!(json(&[], &[*last]), (json!(true), vec![id(last)], vec![]));
    let signals = first.signals.split_first().map(|(_, others)| others).unwrap_or_default();
    for changed in [
        DeviceMessage { cycle_ms: None, ..*first },
        DeviceMessage { len: 8, ..*first },
        DeviceMessage { sender: Device::Res, ..*first },
        DeviceMessage { signals, ..*first },
    ] {
        assert_eq!(
            json(&[*first], &[changed]),
            (json!(true), vec![id(first)], vec![id(first)]),
            "{changed:?}"
        );
    }
    assert_eq!(json(&[*first, *last], &[*first, *last]), (json!(false), vec![], vec![]));
}

#[test]
fn a_cause_is_new_or_gone_by_its_number_and_renamed_with_its_signal() {
    let causes = |values| {
        changed(&with_signals(0x520, |signals| {
            let cause = signals.iter_mut().find(|signal| signal.field == "shutdown_cause");
            cause.expect("a signal").values = values;
        }))
    };
    let all = BEFORE.bus.signal_of("shutdown_cause").expect("a signal").values;
    let (last, rest) = all.split_last().expect("values");
    assert_eq!(causes(rest)["causes"], json!({ "new": [], "gone": [{ "value": last.0, "name": last.1 }] }));
    let mut renamed = all.to_vec();
    renamed[0].1 = "NOTHING";
    let json = causes(renamed.leak());
    assert_eq!(json.as_object().map(serde_json::Map::len), Some(1), "{json}");
    assert_eq!(json["messages"]["changed"][0]["signals"]["changed"][0]["changes"][0]["property"], "values");
}
