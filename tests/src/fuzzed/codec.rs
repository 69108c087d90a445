//! Frames on the bus of any edition: any identifier, any length, any bytes; and any message, written and read back.

use adsdv_spec::messages::{AnyMessage, DecodeError, Frame, MessageDef, SignalDef};
use adsdv_spec::{AiMessages, Bus, Edition, Inputs, Outputs};

use super::Bytes;
use crate::world::Chance;

/// The choices that make these the edition, the identifier and the data.
pub fn as_data(edition: &Edition, id: u16, data: &[u8]) -> Vec<u8> {
    let place = |place: Option<usize>| place.and_then(|place| u8::try_from(place).ok()).unwrap_or(0);
    let of = place(Edition::ALL.iter().position(|of| of.version == edition.version));
    let message = place(edition.bus.messages.iter().position(|def| def.id == id));
    [&[of, 2, 1, message], data].concat()
}

/// The body.
pub fn body(bytes: &[u8]) {
    let mut bytes = Bytes::new(bytes);
    let bus = &bytes.edition().bus;
    match bytes.below(4) {
        0 => any_message(bus, &mut bytes),
        1 => any_outputs(bus, &mut bytes),
        _ => {
            let id = if bytes.one_in(4) { bytes.any() } else { bytes.pick(bus.messages).id };
            let data = bytes.rest();
            any_data(bus, id, data);
        }
    }
}

/// Data is read or refused, and what is read is written again.
fn any_data(bus: &Bus, id: u16, data: &[u8]) {
    let def = bus.message(id);
    match bus.decode(id, data) {
        Ok(message) => {
            let def = def.expect("a message has an identifier of the table");
            assert_eq!((message.id(), def.id), (id, id));
            for signal in def.signals {
                let raw = signal.raw(data).expect("what was read is long enough for every signal");
                assert!(signal.allows(raw) && signal.check(raw).is_ok(), "{signal:?} is {raw}");
                shown(signal, raw);
            }
            same_again(bus, message);
            let frame = encoded(bus, message);
            for signal in def.signals {
                // Of two numbers that mean the same one is written.
                let meant = signal.raw(data).map(|raw| signal.meaning(raw));
                assert_eq!(meant, signal.raw(frame.data()), "{signal:?}");
            }
        }
        Err(error) => {
            assert!(!error.to_string().is_empty());
            refused_rightly(id, data, def, &error);
        }
    }
    let frame = Frame::new(id, data);
    assert_eq!(frame.is_some(), id <= 0x7FF && data.len() <= 8, "{id:X}h with {} bytes", data.len());
    if let Some(frame) = frame {
        assert!(frame.is_valid() && frame.data() == data);
        assert_eq!(frame.to_string().split_once('#').map(|(_, digits)| digits.len()), Some(2 * data.len()));
    }
    received(bus, id, data);
}

/// What is refused has no such identifier, is too short, or has a value that is not allowed.
fn refused_rightly(id: u16, data: &[u8], def: Option<&MessageDef>, error: &DecodeError) {
    match (error, def) {
        (DecodeError::UnknownId { id: given }, None) => assert_eq!(*given, id),
        (DecodeError::TooShort { given, needed, .. }, Some(def)) => {
            assert_eq!((*given, *needed), (data.len(), def.bytes_needed()));
            assert!(data.len() < def.bytes_needed());
        }
        (DecodeError::Value(error), Some(def)) => {
            let signal = def.signal(error.signal).expect("the signal is one of the message's");
            assert_eq!(signal.raw(data), Some(error.given));
            assert!(!signal.allows(error.given) && signal.check(error.given).is_err());
            shown(signal, error.given);
        }
        _ => panic!("{id:X}h with {data:?}: {error:?}"),
    }
}

/// A value is shown in some way, whether it is allowed or not, and is put where it was.
fn shown(signal: &'static SignalDef, raw: i32) {
    assert!(!signal.display(raw).to_string().is_empty());
    assert!(signal.physical(raw).is_finite());
    let data = signal.put([0; 8], raw);
    assert_eq!(signal.raw(&data), Some(raw), "{signal:?}");
}

/// The AI Computer's messages are what arrives; nothing else changes.
fn received(bus: &Bus, id: u16, data: &[u8]) {
    let mut ai = AiMessages::default();
    match ai.receive(bus, id, data) {
        Ok(true) => assert!(bus.decode(id, data).is_ok()),
        Ok(false) => assert_eq!(ai, AiMessages::default()),
        Err(_) => {
            assert_eq!(ai, AiMessages::default());
            assert!(bus.decode(id, data).is_err());
        }
    }
}

/// The frame of a message that the bus has.
fn encoded(bus: &Bus, message: impl Into<AnyMessage>) -> Frame {
    bus.encode(message).expect("the bus has it")
}

/// A message is read as it was written; one that the edition cannot say is read as what it can.
fn same_again(bus: &Bus, message: AnyMessage) {
    let Some(def) = bus.message(message.id()) else {
        return assert!(bus.encode(message).is_none() && !bus.holds(message), "{message:?}");
    };
    let frame = encoded(bus, message);
    assert!(frame.is_valid() && frame.id == def.id && frame.data().len() == usize::from(def.len));
    let read = bus.decode(frame.id, frame.data()).expect("what is written can be read");
    assert!(bus.holds(read) && (read == message) == bus.holds(message), "{message:?}");
}

fn any_message(bus: &Bus, bytes: &mut Bytes<'_>) {
    if let Ok(message) = bytes.0.arbitrary::<AnyMessage>() {
        same_again(bus, message);
    }
}

/// What a VCU sends, whatever it sees and whatever its outputs are, can be read.
fn any_outputs(bus: &Bus, bytes: &mut Bytes<'_>) {
    let (Ok(outputs), Ok(inputs)) = (bytes.0.arbitrary::<Outputs>(), bytes.0.arbitrary::<Inputs>()) else {
        return;
    };
    let messages = outputs.messages(&inputs);
    for frame in messages.frames(bus) {
        let message = bus.decode(frame.id, frame.data());
        same_again(bus, message.expect("the VCU sends what its messages allow"));
    }
    // The outputs may be of a later version, and show what this one does not have.
    let read = bus.decode_as(encoded(bus, messages.status).data());
    assert_eq!(read == Ok(messages.status), bus.holds(messages.status), "{messages:?}");
}
