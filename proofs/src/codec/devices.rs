//! The messages between the VCU and its devices, which the CAN database of 2026 lists.
//!
//! The bounds of the loops: there are 33 messages, none with more than 7 signals; 8 bytes are put together to a word.

use adsdv_spec::messages::{
    Coding,
    Device::{self, Joystick, Opus, PcanGps, Res, Vcu},
    DeviceMessage, DeviceSignal,
};

use super::table::cut;
use crate::prelude::*;

/// What the database says of each message as a whole: the identifier, the sender, the number of bytes, and the bits that
/// belong to a signal, as a word in which byte 0 has the lowest.
const DATABASE: [(u16, Device, u8, u64); 33] = [
    (0x000, Vcu, 2, 0xFFFF),
    (0x080, Vcu, 0, 0x0),
    (0x081, Res, 8, 0x00FF_FFFF_FFFF),
    (0x084, Joystick, 8, 0x00FF_FFFF_FFFF),
    (0x123, Opus, 1, 0x3F),
    (0x181, Res, 8, 0x00FF_0000_0000_0007),
    (0x184, Joystick, 2, 0x9),
    (0x284, Joystick, 4, 0xFFFF_FFFF),
    (0x300, Vcu, 8, 0xFFFF_FFFF_FFFF_FFFF),
    (0x301, Vcu, 8, 0xFFFF_FFFF_FFFF_FFFF),
    (0x302, Vcu, 8, 0xFFFF_FFFF),
    (0x600, PcanGps, 8, 0x1FFF_FFFF_FFFF_FFFF),
    (0x610, PcanGps, 8, 0xFFFF_FFFF_FFFF_FFFF),
    (0x611, PcanGps, 4, 0xFFFF_FFFF),
    (0x620, PcanGps, 3, 0x00FF_FFFF),
    (0x621, PcanGps, 8, 0xFFFF_FFFF_FFFF_FFFF),
    (0x622, PcanGps, 7, 0x00FF_FFFF_FFFF_FFFF),
    (0x623, PcanGps, 7, 0x00FF_FFFF_FFFF_FFFF),
    (0x624, PcanGps, 4, 0xFFFF_FFFF),
    (0x625, PcanGps, 8, 0xFFFF_FFFF_FFFF_FFFF),
    (0x626, PcanGps, 4, 0xFFFF_FFFF),
    (0x627, PcanGps, 6, 0xFFFF_FFFF_FFFF),
    (0x628, PcanGps, 6, 0xFFFF_FFFF_FFFF),
    (0x630, PcanGps, 1, 0xFF),
    (0x640, PcanGps, 8, 0xFFFF_FFFF_FFFF_FFFF),
    (0x650, PcanGps, 1, 0x3),
    (0x651, PcanGps, 1, 0x1),
    (0x652, PcanGps, 1, 0x3),
    (0x653, PcanGps, 1, 0x7),
    (0x654, PcanGps, 1, 0x1),
    (0x655, PcanGps, 8, 0xFFFF_FFFF_FFFF_FFFF),
    (0x656, PcanGps, 1, 0x1),
    (0x657, PcanGps, 4, 0x0103_0303),
];

/// The messages of the devices, as the subject has them.
fn devices() -> &'static [DeviceMessage] {
    subject().machine_of_2026().edition().bus.devices
}

/// The bits of a signal in a frame, as a word.
fn bits(signal: &DeviceSignal) -> u64 {
    u64::from_le_bytes(signal.put([0; 8], -1))
}

/// **The messages of the devices are those of the database**: its 33 identifiers, each with its sender, its length and the bits
/// of its signals.
///
/// Requirements: MSG-115.
#[cfg_attr(kani, kani::proof, kani::unwind(35))]
pub fn the_messages_of_the_devices_are_those_of_the_database() {
    let devices = devices();
    assert!(devices.len() == DATABASE.len(), "as many messages");
    for (message, (id, sender, len, used)) in devices.iter().zip(DATABASE) {
        assert!(message.id == id, "the identifier");
        assert!(message.sender == sender, "the sender");
        assert!(message.len == len, "the length");
        let mut bits_used = 0;
        for signal in message.signals {
            bits_used |= bits(signal);
        }
        kani::cover!(bits_used.leading_zeros() == 0, "up to the last bit");
        assert!(bits_used == used, "the bits");
    }
}

/// **No two signals of a device share a bit, and each lies in its frame.** Of each signal the frame with all of its bits set
/// has as many set as the signal has, none that a signal before it has, and none behind the message.
///
/// Requirements: MSG-115, D-30.
#[cfg_attr(kani, kani::proof, kani::unwind(35))]
pub fn no_two_signals_of_a_device_share_a_bit() {
    for message in devices() {
        let mut before = 0;
        for signal in message.signals {
            let bits = bits(signal);
            kani::cover!(before != 0, "one more signal of the same message");
            assert!(bits & before == 0, "no bit in common");
            assert!(bits.count_ones() == signal.width.into(), "as many as the signal has");
            assert!(64 - bits.leading_zeros() <= 8 * u32::from(message.len), "in the frame");
            before |= bits;
        }
    }
}

/// **What is put into a signal of a device is what it holds, and no other bit changes**, with its sign if it has one. A signal
/// of one bit has none, whatever the database says: it is 0 or 1.
///
/// Requirements: MSG-115, D-30, D-70.
#[cfg_attr(kani, kani::proof, kani::unwind(35))]
pub fn what_is_put_into_a_signal_of_a_device_is_what_it_holds() {
    let data: [u8; 8] = kani::any();
    let any: i32 = kani::any();
    let negative = (any < 0) & (u64::from_le_bytes(data) != 0);
    kani::cover!(negative, "a negative number, and something beside it");
    for message in devices() {
        for signal in message.signals {
            // A float is as good as any other 32 bits.
            let signed = matches!(signal.coding, Coding::Signed);
            let raw = cut(any, signal.width, signed && signal.width > 1);
            let with = signal.put(data, raw);
            assert!(signal.raw(&with) == Some(raw), "it is read back");
            let others = !bits(signal);
            assert!(
                u64::from_le_bytes(with) & others == u64::from_le_bytes(data) & others,
                "every other bit is as it was"
            );
            let short = usize::from((signal.start + signal.width - 1) / 8);
            assert!(signal.raw(&with[..short]).is_none(), "nothing where its last byte is missing");
        }
    }
}

theorems![
    what_is_put_into_a_signal_of_a_device_is_what_it_holds;
    every the_messages_of_the_devices_are_those_of_the_database, no_two_signals_of_a_device_share_a_bit
];
