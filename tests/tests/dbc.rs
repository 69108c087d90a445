//! The exported CAN database, read back by another program: it says what the table says, and what the original
//! database says but for the listed differences.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Display;
use std::path::Path;
use std::{fs, iter};

use adsdv_spec::export::Dbc;
use adsdv_spec::messages::{Coding, Decimal};
use adsdv_spec::{Bus, Edition};
use can_dbc::{AttributeValue, ByteOrder, MessageId, SignalExtendedValueType, ValueDescription, ValueType};

/// Each edition with the original of its database, as it lies beside the checkout; `None` of one that has none of its own.
static EDITIONS: [(Edition, Option<&str>); 3] = [
    (Edition::V3_0, Some("dbc/adsdv_2021_vcu_ai_interface_v1.dbc")),
    (Edition::V4_0, Some("v4/ADS-DV_v2.dbc")),
    (Edition::V2026, Some("v4/ADS-DV_2026_CAN1.dbc")),
];

/// A database as a list of facts, each the text of one attribute of a signal, or, under an empty signal name, of
/// the message itself.
type Facts = BTreeMap<Fact, String>;

#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Fact {
    id: u32,
    signal: String,
    attribute: &'static str,
}

fn fact(id: u32, signal: &str, attribute: &'static str, text: &dyn Display) -> (Fact, String) {
    (Fact { id, signal: signal.to_owned(), attribute }, text.to_string())
}

fn range(min: &dyn Display, max: &dyn Display) -> String {
    format!("[{min}|{max}]")
}

/// By number, whatever their order is in the database.
fn values<'a>(values: impl Iterator<Item = (i64, &'a str)>) -> String {
    let values: BTreeMap<_, _> = values.collect();
    values.into_iter().map(|(value, name)| format!("{value} \"{name}\"")).collect::<Vec<_>>().join(" ")
}

fn parse(text: &str) -> can_dbc::Dbc {
    can_dbc::Dbc::try_from(text).unwrap_or_else(|error| panic!("not a CAN database: {error}"))
}

fn exported(edition: &Edition) -> can_dbc::Dbc {
    parse(&Dbc(edition).to_string())
}

/// The pseudo message under which a database keeps signals that are in no frame.
const NO_FRAME: &str = "VECTOR__INDEPENDENT_SIG_MSG";

fn standard(id: MessageId) -> u32 {
    assert!(matches!(id, MessageId::Standard(_)), "{id:?} is not an 11-bit identifier");
    id.raw()
}

/// What a database says of layout and values.
fn facts_of(dbc: &can_dbc::Dbc) -> Facts {
    let mut facts = Facts::new();
    for message in dbc.messages.iter().filter(|message| message.name != NO_FRAME) {
        let id = standard(message.id);
        facts.extend([
            fact(id, "", "name", &message.name),
            fact(id, "", "length", &message.size),
            fact(id, "", "sender", &message.transmitter.as_deref().unwrap_or("none")),
        ]);
        for signal in &message.signals {
            assert_eq!(signal.byte_order, ByteOrder::LittleEndian, "{}", signal.name);
            let sign = if signal.value_type == ValueType::Signed { '-' } else { '+' };
            facts.extend([
                fact(id, &signal.name, "start", &signal.start_bit),
                fact(id, &signal.name, "width", &signal.size),
                fact(id, &signal.name, "sign", &sign),
                fact(id, &signal.name, "scale", &signal.factor),
                fact(id, &signal.name, "offset", &signal.offset),
                fact(id, &signal.name, "range", &range(&signal.min, &signal.max)),
                fact(id, &signal.name, "unit", &signal.unit),
            ]);
        }
    }
    for names in &dbc.value_descriptions {
        let ValueDescription::Signal { message_id, name, value_descriptions } = names else {
            panic!("value names without a signal: {names:?}");
        };
        let values = values(value_descriptions.iter().map(|value| (value.id, value.description.as_str())));
        facts.extend([fact(standard(*message_id), name, "values", &values)]);
    }
    for float in &dbc.signal_extended_value_type_list {
        assert_eq!(float.signal_extended_value_type, SignalExtendedValueType::IEEEfloat32Bit);
        facts.extend([fact(standard(float.message_id), &float.signal_name, "coding", &"float")]);
    }
    facts
}

/// What the table says of layout and values.
fn facts_of_table(bus: &Bus) -> Facts {
    let mut facts = Facts::new();
    for message in bus.messages {
        let id = u32::from(message.id);
        facts.extend([
            fact(id, "", "name", &message.name),
            fact(id, "", "length", &message.len),
            fact(id, "", "sender", &message.sender),
        ]);
        for signal in message.signals {
            let decimal = |raw| Decimal { raw, scale: signal.scale };
            facts.extend([
                fact(id, signal.name, "start", &signal.start),
                fact(id, signal.name, "width", &signal.width),
                fact(id, signal.name, "sign", &if signal.signed { '-' } else { '+' }),
                fact(id, signal.name, "scale", &signal.scale),
                fact(id, signal.name, "offset", &0),
                fact(id, signal.name, "range", &range(&decimal(signal.min), &decimal(signal.max))),
                fact(id, signal.name, "unit", &signal.unit),
            ]);
            if !signal.values.is_empty() {
                let names = values(signal.values.iter().map(|&(value, name)| (i64::from(value), name)));
                facts.extend([fact(id, signal.name, "values", &names)]);
            }
        }
    }
    for message in bus.devices {
        let id = u32::from(message.id);
        facts.extend([
            fact(id, "", "name", &message.name),
            fact(id, "", "length", &message.len),
            fact(id, "", "sender", &message.sender),
        ]);
        for signal in message.signals {
            facts.extend([
                fact(id, signal.name, "start", &signal.start),
                fact(id, signal.name, "width", &signal.width),
                fact(id, signal.name, "sign", &if signal.coding == Coding::Unsigned { '+' } else { '-' }),
                fact(id, signal.name, "scale", &signal.scale),
                fact(id, signal.name, "offset", &signal.offset),
                fact(id, signal.name, "range", &range(&signal.min, &signal.max)),
                fact(id, signal.name, "unit", &signal.unit),
            ]);
            if signal.coding == Coding::Float {
                facts.extend([fact(id, signal.name, "coding", &"float")]);
            }
            if !signal.values.is_empty() {
                let names = values(signal.values.iter().map(|&(value, name)| (i64::from(value), name)));
                facts.extend([fact(id, signal.name, "values", &names)]);
            }
        }
    }
    facts
}

/// Where two databases differ, as the rows that `DISCREPANCIES.md` lists; a fact that one of them does not have
/// is empty there.
fn differences(original: &Facts, ours: &Facts) -> Vec<String> {
    let text = |facts: &Facts, fact| facts.get(fact).cloned().unwrap_or_default();
    let only_ours = ours.keys().filter(|fact| !original.contains_key(fact));
    let mut rows: Vec<_> = original
        .keys()
        .chain(only_ours)
        .map(|fact| (fact, text(original, fact), text(ours, fact)))
        .filter(|(_, original, ours)| original != ours)
        .map(|(Fact { id, signal, attribute }, original, ours)| {
            format!("{id:03X},{signal},{attribute},{original},{ours}")
        })
        .collect();
    rows.sort();
    rows
}

/// The rows of the fenced block of comma-separated values below the heading of a database in `DISCREPANCIES.md`.
fn listed(markdown: &str, database: &str) -> Vec<String> {
    let heading = format!("### `{database}`");
    let mut block =
        markdown.lines().skip_while(|line| *line != heading).skip_while(|line| *line != "```csv").skip(1);
    assert_eq!(block.next(), Some("message_id_hex,signal,attribute,dbc,ours"), "the csv block of {database}");
    let mut rows: Vec<_> = block.take_while(|line| *line != "```").map(str::to_owned).collect();
    rows.sort();
    rows
}

#[test]
fn each_edition_has_its_original_or_none() {
    let versions: Vec<_> = Edition::ALL.iter().map(|edition| edition.version).collect();
    let listed = EDITIONS.each_ref().map(|(edition, _)| edition.version);
    assert_eq!(listed.as_slice(), versions, "`EDITIONS` of this file needs a line for each, in this order");
}

#[test]
fn export_says_what_the_table_says() {
    for (edition, _) in &EDITIONS {
        let dbc = exported(edition);
        assert_eq!(differences(&facts_of(&dbc), &facts_of_table(&edition.bus)), [""; 0]);

        let senders: Vec<_> = dbc.nodes.iter().map(|node| node.0.as_str()).collect();
        let beyond = edition.bus.devices.iter().map(|message| message.sender.name());
        let all: BTreeSet<_> = beyond.chain(["AI", "VCU"]).collect();
        assert_eq!(senders[..2], ["AI", "VCU"]);
        assert_eq!(senders.len(), all.len(), "{senders:?}");
        assert_eq!(BTreeSet::from_iter(senders), all);
        assert_eq!(dbc.version.0, edition.version);
    }
}

#[test]
fn export_comments_every_message_and_signal() {
    for (edition, _) in &EDITIONS {
        let dbc = exported(edition);
        for message in edition.bus.messages {
            let id = MessageId::Standard(message.id);
            assert_eq!(dbc.message_comment(id), Some(message.doc), "{}", message.name);
            for signal in message.signals {
                let comment =
                    dbc.signal_comment(id, signal.name).map(|comment| comment.replace("\\\"", "\""));
                assert_eq!(comment.as_deref(), Some(signal.doc), "{} {}", message.name, signal.name);
            }
        }
    }
}

#[test]
fn export_gives_every_message_its_cycle_time() {
    for (edition, _) in &EDITIONS {
        let dbc = exported(edition);
        for message in edition.bus.messages {
            // 500h is as slow as 502h since 2026.
            let is_before_2026 = ["3.0", "4.0"].contains(&edition.version);
            let slow = message.id == 0x502 || (message.id == 0x500 && !is_before_2026);
            let expected = if slow { 100 } else { 10 };
            assert_eq!(cycle(&dbc, message.id), Some(AttributeValue::Uint(expected)), "{}", message.name);
        }
        for message in edition.bus.devices {
            let expected = message.cycle_ms.map(|cycle| AttributeValue::Uint(cycle.into()));
            assert_eq!(cycle(&dbc, message.id), expected, "{}", message.name);
        }
    }
}

/// The cycle time that a database gives a message.
fn cycle(dbc: &can_dbc::Dbc, id: u16) -> Option<AttributeValue> {
    dbc.attribute_values_message
        .iter()
        .find(|value| value.name == "GenMsgCycleTime" && value.message_id == MessageId::Standard(id))
        .map(|value| value.value.clone())
}

/// An original, if it is there.
fn original(path: &str) -> Option<can_dbc::Dbc> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared").join(path);
    let Ok(bytes) = fs::read(&path) else {
        println!("skipped: the original database is not at {}", path.display());
        return None;
    };
    // Windows-1252, as the tools of a CAN bus write it. What the databases have of it (°, µ, ±) has the same number there as
    // in Unicode.
    assert!(bytes.iter().all(|byte| !(0x80..=0x9F).contains(byte)), "{}", path.display());
    Some(parse(&bytes.into_iter().map(char::from).collect::<String>()))
}

//= D-30, D-31
#[test]
fn export_differs_from_the_original_only_as_listed() {
    let discrepancies = Path::new(env!("CARGO_MANIFEST_DIR")).join("../spec/DISCREPANCIES.md");
    let discrepancies = fs::read_to_string(&discrepancies)
        .unwrap_or_else(|error| panic!("cannot read {}: {error}", discrepancies.display()));

    for (edition, path) in &EDITIONS {
        let Some(path) = path else { continue };
        let database = path.rsplit('/').next().expect("a path ends in a name");
        let listed = listed(&discrepancies, database);
        let Some(original) = original(path) else { continue };
        let differences = differences(&facts_of(&original), &facts_of(&exported(edition)));
        let missing = |from: &[String], row: &&String| !from.contains(row);
        let unlisted: Vec<_> = differences.iter().filter(|row| missing(&listed, row)).collect();
        let unfounded: Vec<_> = listed.iter().filter(|row| missing(&differences, row)).collect();
        assert!(
            iter::chain(&unlisted, &unfounded).next().is_none() && listed.len() == differences.len(),
            "the csv block of {database} in spec/DISCREPANCIES.md is not exact\nto be added: {unlisted:#?}\nto be removed: {unfounded:#?}"
        );
    }
}

/// Version 4.0 states its cycle times, and its database and that of 2026 have them, the latter but for one message.
//= MSG-95, MSG-96, MSG-110, MSG-113
#[test]
fn cycle_times_since_version_4_0_are_those_of_the_database() {
    let [_, later @ ..] = &EDITIONS;
    for (edition, path) in later {
        let Some(path) = path else { continue };
        let Some(original) = original(path) else { continue };
        for message in edition.bus.messages {
            let expected = Some(AttributeValue::Uint(u64::from(message.cycle_ms)));
            // The unit that measures it has no cycles in the database of 2026; the document asks for 10 ms.
            let unset = edition.version == "2026" && message.id == 0x501;
            let expected = if unset { None } else { expected };
            assert_eq!(cycle(&original, message.id), expected, "{}", message.name);
        }
        for message in edition.bus.devices {
            let expected = message.cycle_ms.map(|cycle| AttributeValue::Uint(cycle.into()));
            assert_eq!(cycle(&original, message.id), expected, "{}", message.name);
        }
    }
}
