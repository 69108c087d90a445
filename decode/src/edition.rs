//! The messages of an edition, from its tables: nothing about them is written down here.

use adsdv_spec::Edition;
use adsdv_spec::messages::{Coding as RowCoding, MessageRow, SignalRow, Steps};

use crate::signal::Scaling;
use crate::{Coding, Message, Order, Origin, Place, Signal};

/// Every message of an edition: between the VCU and the AI Computer, and with the devices.
pub(crate) fn messages(edition: &Edition) -> Vec<Message> {
    edition.bus.rows().map(|row| message(&row)).collect()
}

fn message(row: &MessageRow) -> Message {
    Message {
        name: row.name.into(),
        id: row.id.into(),
        extended: false,
        len: row.len.into(),
        origin: Origin::Edition,
        signals: row.signals().filter_map(signal).collect(),
        doc: row.doc.into(),
    }
}

fn signal(row: SignalRow) -> Option<Signal> {
    let coding = match row.coding {
        RowCoding::Unsigned => Coding::Unsigned,
        RowCoding::Signed => Coding::Signed,
        RowCoding::Float => Coding::Float,
    };
    Some(Signal {
        name: row.name.into(),
        unit: row.unit.into(),
        place: Place::new(row.start.into(), row.width.into(), Order::Little, coding)?,
        scaling: match row.steps {
            Steps::Exact(scale) => Scaling::Steps(scale),
            Steps::Linear { factor, offset } => Scaling::of(factor, offset),
        },
        names: names(row.values),
        multiplexed: None,
        doc: row.doc.into(),
    })
}

fn names(values: &[(i32, &str)]) -> Box<[(i64, Box<str>)]> {
    values.iter().map(|&(raw, name)| (raw.into(), name.into())).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two frames of all bits, and of none; the test against cantools has random ones.
    #[test]
    fn every_signal_of_every_edition_reads_what_its_row_reads() {
        for edition in Edition::ALL {
            let messages = messages(edition);
            assert_eq!(messages.len(), edition.bus.messages.len() + edition.bus.devices.len());
            for (message, def) in messages.iter().zip(edition.bus.messages) {
                assert_eq!(message.signals.len(), def.signals.len());
                for (signal, row) in message.signals.iter().zip(def.signals) {
                    for data in [[0; 8], [0xFF; 8], [0xA5, 0x5A, 0xC3, 0x3C, 0x99, 0x66, 0x0F, 0xF0]] {
                        let bits = signal.place.bits(&data).expect("eight bytes are enough");
                        let raw = row.raw(&data).expect("eight bytes are enough");
                        assert_eq!(signal.place.raw(bits), raw.into());
                        assert_eq!(signal.value_name(bits), row.value_name(raw));
                        assert_eq!(signal.value(bits).to_f64().to_bits(), row.physical(raw).to_bits());
                    }
                }
            }
            for (message, def) in messages.iter().skip(edition.bus.messages.len()).zip(edition.bus.devices) {
                assert_eq!(message.signals.len(), def.signals.len());
                for (signal, row) in message.signals.iter().zip(def.signals) {
                    let data = [0xA5, 0x5A, 0xC3, 0x3C, 0x99, 0x66, 0x0F, 0xF0];
                    let value = signal.place.bits(&data).map(|bits| signal.value(bits).to_f64().to_bits());
                    assert_eq!(value, row.physical(&data).map(f64::to_bits), "{}", row.name);
                }
            }
        }
    }
}
