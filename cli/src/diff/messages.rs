//! Messages, the same by their identifier, and their signals, the same by the field that carries them.

use adsdv_spec::messages::{Decimal, MessageDef, ReadAs, SignalDef};
use serde::Serialize;
use serde_json::{Map, Value, json};

use super::change::{Change, Pairs, Parts, Property, Sides, changes, outline};

/// A message that only one of the editions has.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct MessageOutline {
    pub(super) id: u16,
    #[serde(flatten)]
    properties: Map<String, Value>,
    pub(super) signals: Vec<SignalOutline>,
    #[serde(skip)]
    pub(super) name: &'static str,
    #[serde(skip)]
    pub(super) words: String,
}

/// A signal that only one of the editions has.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct SignalOutline {
    #[serde(flatten)]
    properties: Map<String, Value>,
    #[serde(skip)]
    pub(super) name: &'static str,
    #[serde(skip)]
    pub(super) words: String,
}

/// What differs of a message.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct MessageChange {
    pub(super) id: u16,
    /// The name in the edition after.
    pub(super) name: &'static str,
    pub(super) changes: Vec<Change>,
    pub(super) signals: Parts<SignalOutline, SignalChange>,
}

/// What differs of a signal.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct SignalChange {
    /// The name in the edition after.
    pub(super) name: &'static str,
    pub(super) changes: Vec<Change>,
}

/// By what messages are compared, but for the identifier, by which they are the same, and the signals.
pub(super) const OF_A_MESSAGE: &[Property<MessageDef>] = &[
    Property { name: "name", fields: &["name"], value: |m| json!(m.name), words: |m, _| m.name.to_owned() },
    Property {
        name: "sender",
        fields: &["sender"],
        value: |m| json!(m.sender.name()),
        words: |m, _| m.sender.to_string(),
    },
    Property {
        name: "length",
        fields: &["len"],
        value: |m| json!(m.len),
        words: |m, _| crate::layout::counted(m.len.into(), "byte"),
    },
    Property {
        name: "cycle_ms",
        fields: &["cycle_ms"],
        value: |m| json!(m.cycle_ms),
        words: |m, _| format!("every {} ms", m.cycle_ms),
    },
    Property {
        name: "section",
        fields: &["section"],
        value: |m| json!(m.section),
        words: |m, _| m.section.to_owned(),
    },
    Property { name: "meaning", fields: &["doc"], value: |m| json!(m.doc), words: |m, _| m.doc.to_owned() },
];

/// By what signals are compared, but for the field, by which they are the same.
pub(super) const OF_A_SIGNAL: &[Property<SignalDef>] = &[
    Property { name: "name", fields: &["name"], value: |s| json!(s.name), words: |s, _| s.name.to_owned() },
    Property {
        name: "bits",
        fields: &["start", "width"],
        value: |s| json!({ "start": s.start, "width": s.width }),
        words: |s, _| bits(s),
    },
    Property {
        name: "signed",
        fields: &["signed"],
        value: |s| json!(s.signed),
        words: |s, _| if s.signed { "signed" } else { "unsigned" }.to_owned(),
    },
    Property {
        name: "scale",
        fields: &["scale"],
        value: |s| json!({ "num": s.scale.num(), "den": s.scale.den() }),
        words: |s, _| s.scale.to_string(),
    },
    Property { name: "unit", fields: &["unit"], value: |s| json!(s.unit), words: |s, _| s.unit.to_owned() },
    Property {
        name: "range",
        fields: &["min", "max"],
        value: |s| json!({ "min": s.min, "max": s.max }),
        words: |s, _| range(s),
    },
    Property {
        name: "values",
        fields: &["values"],
        value: |s| s.values.iter().map(|(value, name)| json!({ "value": value, "name": name })).collect(),
        words: |s, other| values(s, other.map(|other| other.values).unwrap_or_default()),
    },
    Property {
        name: "read_as",
        fields: &["read_as"],
        value: |s| s.read_as.map_or(Value::Null, |read| json!({ "raw": read.raw, "meaning": read.meaning })),
        words: |s, _| s.read_as.map(|read| read_as(s, read)).unwrap_or_default(),
    },
    Property { name: "meaning", fields: &["doc"], value: |s| json!(s.doc), words: |s, _| s.doc.to_owned() },
];

/// By what two rows are the same signal, the first that tells: their field; where one of them has none, their name, and then
/// their bits.
const SAME_SIGNAL: &[fn(&SignalDef, &SignalDef) -> bool] = &[
    |one, other| !one.field.is_empty() && one.field == other.field,
    |one, other| one_has_no_field(one, other) && one.name == other.name,
    |one, other| one_has_no_field(one, other) && (one.start, one.width) == (other.start, other.width),
];

fn one_has_no_field(one: &SignalDef, other: &SignalDef) -> bool {
    one.field.is_empty() || other.field.is_empty()
}

/// The messages that are new, gone or changed.
pub(super) fn compare(from: &[&MessageDef], to: &[&MessageDef]) -> Parts<MessageOutline, MessageChange> {
    let pairs = Pairs::of(from, to, &[|one, other| one.id == other.id]);
    let outlines = |all: &[&&MessageDef]| all.iter().map(|message| MessageOutline::of(message)).collect();
    Parts {
        sides: Sides { new: outlines(&pairs.new), gone: outlines(&pairs.gone) },
        changed: pairs.both.iter().filter_map(|(from, to)| MessageChange::between(from, to)).collect(),
    }
}

impl MessageOutline {
    fn of(message: &MessageDef) -> Self {
        let MessageDef { id, name, sender, section, signals, .. } = *message;
        let length = crate::layout::counted(message.len.into(), "byte");
        Self {
            id,
            properties: outline(OF_A_MESSAGE, message),
            signals: signals.iter().map(SignalOutline::of).collect(),
            name,
            words: format!("from {sender}, {length}, every {} ms, section {section}", message.cycle_ms),
        }
    }
}

impl MessageChange {
    fn between(from: &MessageDef, to: &MessageDef) -> Option<Self> {
        let pairs = Pairs::of(from.signals, to.signals, SAME_SIGNAL);
        let outlines = |all: &[&SignalDef]| all.iter().map(|signal| SignalOutline::of(signal)).collect();
        let signals = Parts {
            sides: Sides { new: outlines(&pairs.new), gone: outlines(&pairs.gone) },
            changed: pairs.both.iter().filter_map(|(from, to)| SignalChange::between(from, to)).collect(),
        };
        let changes = changes(OF_A_MESSAGE, from, to);
        let differs = !changes.is_empty() || !signals.is_empty();
        differs.then_some(Self { id: to.id, name: to.name, changes, signals })
    }
}

impl SignalOutline {
    fn of(signal: &SignalDef) -> Self {
        let meaning = if signal.values.is_empty() { range(signal) } else { values(signal, &[]) };
        Self {
            properties: outline(OF_A_SIGNAL, signal),
            name: signal.name,
            words: format!("{}, {meaning}", bits(signal)),
        }
    }
}

impl SignalChange {
    fn between(from: &SignalDef, to: &SignalDef) -> Option<Self> {
        let changes = changes(OF_A_SIGNAL, from, to);
        (!changes.is_empty()).then_some(Self { name: to.name, changes })
    }
}

fn bits(signal: &SignalDef) -> String {
    match (signal.start, signal.width) {
        (start, 1) => format!("bit {start}"),
        (start, width) => {
            format!("bits {start} to {}", (u16::from(start) + u16::from(width)).saturating_sub(1))
        }
    }
}

fn read_as(signal: &SignalDef, ReadAs { raw, meaning }: ReadAs) -> String {
    format!("{raw} = {} is read as {meaning} = {}", signal.display(raw), signal.display(meaning))
}

fn range(signal: &SignalDef) -> String {
    let number = |raw| Decimal { raw, scale: signal.scale };
    let space = if signal.unit.is_empty() { "" } else { " " };
    format!("{} to {}{space}{}", number(signal.min), number(signal.max), signal.unit)
}

/// The named values that are not among these others.
fn values(signal: &SignalDef, others: &[(i32, &str)]) -> String {
    let own = signal.values.iter().filter(|value| !others.contains(value));
    own.map(|(value, name)| format!("{value} = {name}")).collect::<Vec<_>>().join(", ")
}
