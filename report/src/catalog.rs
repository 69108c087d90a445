//! The messages of an edition as the page decodes them: the rows of the edition's own tables, and nothing beside them.

use adsdv_spec::Edition;
use adsdv_spec::messages::{Coding, DeviceMessage, DeviceSignal, MessageDef, SignalDef};
use serde::Serialize;

/// A message, and how its frames are read.
#[derive(Serialize)]
pub(crate) struct MessageJson {
    pub(crate) id: u16,
    name: &'static str,
    /// `AI`, `VCU` or the name of a device.
    from: &'static str,
    cycle_ms: Option<u16>,
    len: u8,
    doc: &'static str,
    signals: Vec<SignalJson>,
}

/// Bits of a frame, in the byte order of this bus, and what they mean: raw steps times `num / den`, plus `offset`.
#[derive(Serialize)]
struct SignalJson {
    name: &'static str,
    start: u8,
    width: u8,
    /// `u`, `i` or `f`.
    coding: char,
    num: f64,
    den: f64,
    offset: f64,
    unit: &'static str,
    values: Vec<(i32, &'static str)>,
    #[serde(skip_serializing_if = "str::is_empty")]
    doc: &'static str,
}

/// The messages of an edition as the page of a report has them under `messages`: how their frames are read.
///
/// ```
/// use adsdv_report::catalog;
/// use adsdv_spec::Edition;
///
/// let messages = catalog(&Edition::V3_0);
/// assert_eq!(messages[0]["signals"][0]["start"], 0);
/// ```
pub fn catalog(edition: &Edition) -> serde_json::Value {
    // Nothing here can fail to be written: all keys are text, and all numbers finite.
    serde_json::to_value(messages(edition)).unwrap_or_default()
}

/// Every message of an edition.
pub(crate) fn messages(edition: &Edition) -> Vec<MessageJson> {
    let documented = edition.bus.messages.iter().map(|message| documented(message));
    documented.chain(edition.bus.devices.iter().map(of_device)).collect()
}

fn documented(message: &MessageDef) -> MessageJson {
    MessageJson {
        id: message.id,
        name: message.name,
        from: message.sender.name(),
        cycle_ms: Some(message.cycle_ms),
        len: message.len,
        doc: message.doc,
        signals: message.signals.iter().map(signal).collect(),
    }
}

fn signal(signal: &SignalDef) -> SignalJson {
    SignalJson {
        name: signal.name,
        start: signal.start,
        width: signal.width,
        coding: if signal.signed { 'i' } else { 'u' },
        num: signal.scale.num().into(),
        den: signal.scale.den().into(),
        offset: 0.0,
        unit: signal.unit,
        values: signal.values.to_vec(),
        doc: signal.doc,
    }
}

fn of_device(message: &DeviceMessage) -> MessageJson {
    MessageJson {
        id: message.id,
        name: message.name,
        from: message.sender.name(),
        cycle_ms: message.cycle_ms,
        len: message.len,
        doc: message.sender.what(),
        signals: message.signals.iter().map(device_signal).collect(),
    }
}

fn device_signal(signal: &DeviceSignal) -> SignalJson {
    SignalJson {
        name: signal.name,
        start: signal.start,
        width: signal.width,
        coding: match signal.coding {
            Coding::Unsigned => 'u',
            Coding::Signed => 'i',
            Coding::Float => 'f',
        },
        num: signal.scale,
        den: 1.0,
        offset: signal.offset,
        unit: signal.unit,
        values: signal.values.to_vec(),
        doc: "",
    }
}
