//! What the VCU and its devices tell each other: messages that are new, and those that are gone. One that is not the same is both.

use adsdv_spec::messages::{Coding, DeviceMessage, DeviceSignal};
use serde::Serialize;
use serde_json::{Value, json};

use super::change::Sides;

/// A message of a device that only one of the editions has like this.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct DeviceOutline {
    pub(super) id: u16,
    pub(super) name: &'static str,
    sender: &'static str,
    length: u8,
    cycle_ms: Option<u16>,
    signals: Vec<Value>,
    #[serde(skip)]
    pub(super) words: String,
}

pub(super) fn compare(from: &[DeviceMessage], to: &[DeviceMessage]) -> Sides<DeviceOutline> {
    let outlines = |all: &[DeviceMessage]| all.iter().map(DeviceOutline::of).collect::<Vec<_>>();
    Sides::of(&outlines(from), &outlines(to))
}

impl DeviceOutline {
    fn of(message: &DeviceMessage) -> Self {
        // Without `..`, so that a further field has to be compared before this compiles.
        let DeviceMessage { name, id, sender, len, cycle_ms, signals } = *message;
        let length = crate::layout::counted(len.into(), "byte");
        let cycle = cycle_ms.map_or_else(|| "no cycle".to_owned(), |cycle_ms| format!("every {cycle_ms} ms"));
        let names: Vec<_> = signals.iter().map(|signal| signal.name).collect();
        let names = if names.is_empty() { "no signals".to_owned() } else { names.join(", ") };
        Self {
            id,
            name,
            sender: sender.name(),
            length: len,
            cycle_ms,
            signals: signals.iter().map(signal).collect(),
            words: format!("from {sender}, {length}, {cycle}: {names}"),
        }
    }
}

fn signal(signal: &DeviceSignal) -> Value {
    let DeviceSignal { name, start, width, coding, scale, offset, unit, min, max, values } = *signal;
    let coding = match coding {
        Coding::Unsigned => "unsigned",
        Coding::Signed => "signed",
        Coding::Float => "float",
    };
    let values: Vec<_> = values.iter().map(|(value, name)| json!({ "value": value, "name": name })).collect();
    json!({
        "name": name,
        "bits": { "start": start, "width": width },
        "coding": coding,
        "scale": scale,
        "offset": offset,
        "unit": unit,
        "min": min,
        "max": max,
        "values": values,
    })
}
