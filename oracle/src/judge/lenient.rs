//! Reading as much of a frame as can be read: signals that are not allowed are set aside, the rest is kept.

use adsdv_spec::Bus;
use adsdv_spec::messages::{Message, SignalDef};

/// A message of which some signals may have had values that are not allowed.
pub(super) struct Lenient<M> {
    /// The message, with an allowed value in place of each that was not.
    pub(super) message: M,
    /// The signals whose values were not allowed, one bit each in the order of the table.
    pub(super) bad: u32,
}

/// Reads data that is long enough for every signal.
pub(super) fn decode<M: Message>(bus: &Bus, data: [u8; 8]) -> Lenient<M> {
    match bus.decode_as(&data) {
        Ok(message) => Lenient { message, bad: 0 },
        Err(_) => mend(bus, data),
    }
}

#[cold]
fn mend<M: Message>(bus: &Bus, mut data: [u8; 8]) -> Lenient<M> {
    let mut bad = 0;
    for (index, signal) in bus.message(M::ID).map_or(&[][..], |def| def.signals).iter().enumerate() {
        if signal.raw(&data).is_some_and(|raw| !signal.allows(raw)) {
            bad |= 1 << index;
            data = signal.put(data, signal.min);
        }
    }
    Lenient { message: bus.decode_as(&data).unwrap_or_default(), bad }
}

/// Whether a value that is not allowed is the start value 0 of the CAN database, which the signal's enumeration does not have.
pub(super) fn is_start_value(signal: &SignalDef, raw: i32) -> bool {
    raw == 0 && !signal.values.is_empty()
}
