//! What is written is read, and what is read was written: every bit pattern of every signal.

use super::*;

//= D-19
#[test]
fn every_bit_pattern_of_every_signal_is_a_value_or_an_error() {
    for (bus, message) in messages() {
        for signal in message.signals {
            let mut data = lowest(message);
            for pattern in 0..1 << signal.width {
                write(signal, &mut data, pattern);
                let raw = read(signal, &data);
                assert_eq!(signal.raw(&data), Some(raw), "{}", signal.name);
                assert_eq!(signal.allows(raw), allowed(signal, raw), "{} {raw}", signal.name);
                match decode(bus, message, &data) {
                    Ok(decoded) => {
                        assert!(allowed(signal, raw), "{} takes {raw}", signal.name);
                        assert_eq!(
                            encode(bus, decoded).data,
                            as_written(message, data),
                            "{} {raw}",
                            signal.name
                        );
                    }
                    Err(DecodeError::Value(error)) => {
                        assert!(!allowed(signal, raw), "{} refuses {raw}", signal.name);
                        assert_eq!((error.message, error.id), (message.name, message.id));
                        assert_eq!((error.signal, error.given, error.def), (signal.name, raw, signal));
                    }
                    Err(other) => panic!("{}: {other}", signal.name),
                }
            }
        }
    }
}

#[test]
fn values_survive_together() {
    let mut numbers = Random::with_seed(0x5EED_0001);
    for (bus, message) in messages() {
        for _ in 0..2_000 {
            let mut data = [0; 8];
            for signal in message.signals {
                write(signal, &mut data, numbers.value(signal));
            }
            let decoded = decode(bus, message, &data).expect("every value is allowed");
            let frame = encode(bus, decoded);
            assert_eq!(
                (frame.id, frame.len, frame.data),
                (message.id, message.len, as_written(message, data)),
                "{}",
                message.name
            );
            assert_eq!(decoded.id(), message.id);
            assert_eq!(decode(bus, message, frame.data()), Ok(decoded));
        }
    }
}

#[test]
fn any_bytes_are_a_message_or_an_error_that_is_true() {
    let mut numbers = Random::with_seed(0x5EED_0002);
    for (bus, message) in messages() {
        for _ in 0..5_000 {
            // Each AND clears half of the bits, so that enumerations are often allowed.
            let data = (numbers.next() & numbers.next() & numbers.next()).to_le_bytes();
            match decode(bus, message, &data) {
                Ok(decoded) => {
                    let encoded = encode(bus, decoded).data;
                    let used = used_bits(message);
                    let data = as_written(message, data);
                    for index in 0..64 {
                        let expected = used.contains(&index) && bit(&data, index);
                        assert_eq!(bit(&encoded, index), expected, "{} bit {index}", message.name);
                    }
                    assert_eq!(decode(bus, message, &encoded), Ok(decoded));
                }
                Err(error) => {
                    let first = message.signals.iter().find(|signal| !allowed(signal, read(signal, &data)));
                    let first = first.expect("some signal must be refused");
                    assert!(error.to_string().contains(first.name), "{error}");
                }
            }
        }
    }
}

#[test]
fn a_signal_is_put_among_bits_that_stay() {
    let mut numbers = Random::with_seed(0x5EED_0005);
    for signal in messages().flat_map(|(_, message)| message.signals) {
        for _ in 0..200 {
            // Values that are not allowed and do not fit, too.
            let (data, raw) = (
                numbers.next().to_le_bytes(),
                i32::from_le_bytes(numbers.next().to_le_bytes()[..4].try_into().expect("four bytes")),
            );
            let mut expected = data;
            write(signal, &mut expected, raw);
            assert_eq!(signal.put(data, raw), expected, "{} {raw} in {data:?}", signal.name);
        }
    }
}
