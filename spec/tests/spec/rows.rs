//! The rows that all messages of an edition have in common.

use adsdv_spec::Edition;
use adsdv_spec::messages::{Coding, Steps};

#[test]
fn each_message_of_the_document_and_of_a_device_is_a_row_with_its_signals() {
    for edition in Edition::ALL {
        let bus = &edition.bus;
        let rows: Vec<_> = bus.rows().collect();
        assert_eq!(rows.len(), bus.messages.len() + bus.devices.len(), "{}", edition.version);
        let (documented, of_devices) = rows.split_at(bus.messages.len());
        for (row, message) in documented.iter().zip(bus.messages) {
            assert_eq!((row.name, row.id, row.len), (message.name, message.id, message.len));
            assert_eq!((row.from, row.cycle_ms), (message.sender.name(), Some(message.cycle_ms)));
            assert_eq!(row.doc, message.doc);
            let signals: Vec<_> = row.signals().collect();
            assert_eq!(signals.len(), message.signals.len());
            for (row, signal) in signals.iter().zip(message.signals) {
                assert_eq!((row.name, row.start, row.width), (signal.name, signal.start, signal.width));
                assert_eq!(row.coding == Coding::Signed, signal.signed, "{}", signal.name);
                assert_eq!(row.steps, Steps::Exact(signal.scale));
                assert_eq!((row.unit, row.values, row.doc), (signal.unit, signal.values, signal.doc));
            }
        }
        for (row, message) in of_devices.iter().zip(bus.devices) {
            assert_eq!((row.name, row.id, row.len), (message.name, message.id, message.len));
            assert_eq!((row.from, row.cycle_ms), (message.sender.name(), message.cycle_ms));
            assert_eq!(row.doc, message.sender.what());
            let signals: Vec<_> = row.signals().collect();
            assert_eq!(signals.len(), message.signals.len());
            for (row, signal) in signals.iter().zip(message.signals) {
                assert_eq!((row.name, row.start, row.width), (signal.name, signal.start, signal.width));
                assert_eq!((row.coding, row.unit, row.values), (signal.coding, signal.unit, signal.values));
                assert_eq!(row.steps, Steps::Linear { factor: signal.scale, offset: signal.offset });
            }
        }
    }
}
