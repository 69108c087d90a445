//! Data of every length, and the bits that no signal uses.

use super::*;

//= D-33
#[test]
fn data_of_any_length_is_enough_from_the_last_signal_on() {
    let mut numbers = Random::with_seed(0x5EED_0003);
    for (bus, message) in messages() {
        let mut data = [0xFF; 64];
        for signal in message.signals {
            write(signal, &mut data, numbers.value(signal));
        }
        let needed = message.bytes_needed();
        let whole = decode(bus, message, &data[..8]).expect("every value is allowed");
        for given in 0..=64 {
            let decoded = decode(bus, message, &data[..given]);
            if given >= needed {
                assert_eq!(decoded, Ok(whole), "{} of {given} bytes", message.name);
            } else {
                let first = message.signals.iter().find(|signal| signal.bytes_needed() > given);
                let signal = first.expect("one does not fit").name;
                let expected =
                    DecodeError::TooShort { message: message.name, id: message.id, given, needed, signal };
                assert_eq!(decoded, Err(expected));
            }
        }
    }
}

//= D-34
#[test]
fn unused_bits_are_ignored_when_read_and_zero_when_written() {
    for (bus, message) in messages() {
        let clean = lowest(message);
        let decoded = decode(bus, message, &clean).expect("every value is allowed");
        assert_eq!(encode(bus, decoded).data, as_written(message, clean), "{}", message.name);
        let used = used_bits(message);
        for index in (0..64).filter(|index| !used.contains(index)) {
            let mut dirty = clean;
            set_bit(&mut dirty, index, true);
            assert_eq!(decode(bus, message, &dirty), Ok(decoded), "{} bit {index}", message.name);
        }
    }
}
