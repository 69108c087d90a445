//! The JSON Schemas of what is written in JSON. Each says the type of a property in one word, as viewers want it.

use serde_json::{Map, Value as Json, json};

use crate::arrows::{GuardedArrow, condition_name};
use crate::{Message, Signal};

/// What is behind the name of a signal that has names for its values, for such a name.
const NAME: &str = "_name";

/// What of a condition is known.
pub(super) const fn word(known: Option<bool>) -> &'static str {
    match known {
        Some(true) => "true",
        Some(false) => "false",
        None => "unknown",
    }
}

/// Behind the name of each signal, where it has names for its values, the property that has such a name.
pub(super) fn name_property(message: &Message, signal: &Signal) -> Option<String> {
    if signal.names.is_empty() {
        return None;
    }
    let mut name = format!("{}{NAME}", signal.name);
    while message.signals.iter().any(|other| *other.name == *name) {
        name.push('_');
    }
    Some(name)
}

/// That of a message of the bus.
pub(super) fn of_message(message: &Message) -> Json {
    let mut properties = Map::new();
    for signal in &message.signals {
        let kind = if signal.is_whole() { "integer" } else { "number" };
        let unit = if signal.unit.is_empty() { String::new() } else { format!(" [{}]", signal.unit) };
        let says = format!("{}{unit}", signal.doc);
        properties.insert(signal.name.to_string(), json!({"type": kind, "description": says.trim()}));
        if let Some(name) = name_property(message, signal) {
            let names: Vec<_> = signal.names.iter().map(|(raw, name)| format!("{raw} {name}")).collect();
            let says = format!(
                "the name of {}, or its number where that has none: {}",
                signal.name,
                names.join(", ")
            );
            properties.insert(name, json!({"type": "string", "description": says}));
        }
    }
    object(&message.name, &message.doc, &properties)
}

/// That of the AS state.
pub(super) fn of_state() -> Json {
    let mut properties = Map::new();
    properties.insert("state".to_owned(), text("the AS state as the judge follows it, or unknown"));
    properties.insert("since".to_owned(), time("since when; not there while it is unknown"));
    object(
        "adsdv.AsState",
        "The state of the Autonomous System, when it changes and each second.",
        &properties,
    )
}

/// That of what blocks the arrows.
pub(super) fn of_blocked(arrows: &[GuardedArrow]) -> Json {
    let mut properties = Map::new();
    properties.insert("state".to_owned(), text("the AS state, or unknown"));
    for arrow in arrows {
        let mut of_arrow = Map::new();
        of_arrow.insert(
            "blocked".to_owned(),
            known("whether the guard fails, in the state where the arrow begins"),
        );
        of_arrow.insert("by".to_owned(), text("what makes the guard fail, as it would have to be"));
        for condition in &arrow.conditions {
            of_arrow.insert(condition_name(*condition), known("whether it is as the arrow needs it"));
        }
        properties.insert(arrow.name(), json!({"type": "object", "properties": of_arrow}));
    }
    let says = "What blocks the arrows of Figure 2, when it changes and each second.";
    object("adsdv.Blocked", says, &properties)
}

/// That of a finding: `foxglove.Log`, with more beside it.
pub(super) fn of_finding() -> Json {
    let mut properties = Map::new();
    let count = |says: &str| json!({"type": "integer", "minimum": 0, "description": says});
    for (name, schema) in [
        ("timestamp", time("when")),
        ("level", count("2 a note, 3 a warning, 4 a violation")),
        ("message", text("what was seen and expected, by which rule and section")),
        ("name", text("who is at fault: AI, VCU, LOG or OWN")),
        ("file", text("empty")),
        ("line", count("0")),
        ("rule", text("what was checked")),
        ("section", text("where it stands")),
        (
            "requirements",
            json!({"type": "array", "items": {"type": "string"}, "description": "those that it is against"}),
        ),
    ] {
        properties.insert(name.to_owned(), schema);
    }
    object("foxglove.Log", "What the judge finds.", &properties)
}

fn object(title: &str, says: &str, properties: &Map<String, Json>) -> Json {
    json!({"title": title, "description": says, "type": "object", "properties": properties})
}

fn text(says: &str) -> Json {
    json!({"type": "string", "description": says})
}

fn known(says: &str) -> Json {
    json!({"type": "string", "enum": [word(Some(true)), word(Some(false)), word(None)], "description": says})
}

fn time(says: &str) -> Json {
    let number = |most: u64| json!({"type": "integer", "minimum": 0, "maximum": most});
    let properties = json!({"sec": number(u32::MAX.into()), "nsec": number(999_999_999)});
    json!({"type": "object", "title": "time", "properties": properties, "description": says})
}

/// A time as such an object.
pub(super) fn time_value(time_ns: i64) -> Json {
    let time_ns = u64::try_from(time_ns).unwrap_or(0);
    json!({"sec": time_ns / 1_000_000_000, "nsec": time_ns % 1_000_000_000})
}
