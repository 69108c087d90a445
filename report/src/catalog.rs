//! The messages of an edition as the page decodes them: the rows of the edition's own tables, and nothing beside them.

use adsdv_spec::Edition;
use adsdv_spec::messages::{Coding, MessageRow, SignalRow, Steps};
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
    edition.bus.rows().map(|row| message(&row)).collect()
}

fn message(row: &MessageRow) -> MessageJson {
    MessageJson {
        id: row.id,
        name: row.name,
        from: row.from,
        cycle_ms: row.cycle_ms,
        len: row.len,
        doc: row.doc,
        signals: row.signals().map(signal).collect(),
    }
}

fn signal(row: SignalRow) -> SignalJson {
    let (num, den, offset) = match row.steps {
        Steps::Exact(scale) => (scale.num().into(), scale.den().into(), 0.0),
        Steps::Linear { factor, offset } => (factor, 1.0, offset),
    };
    SignalJson {
        name: row.name,
        start: row.start,
        width: row.width,
        coding: match row.coding {
            Coding::Unsigned => 'u',
            Coding::Signed => 'i',
            Coding::Float => 'f',
        },
        num,
        den,
        offset,
        unit: row.unit,
        values: row.values.to_vec(),
        doc: row.doc,
    }
}
