//! Frames: any identifier, any length, any bytes; and any message, written and read back.

use adsdv_spec::messages::{AnyMessage, DecodeError, Frame, MessageDef, SignalDef};
use adsdv_spec::{AiMessages, Inputs, Outputs};

use super::Bytes;
use crate::bus::{BUS, encoded};
use crate::world::Chance;

/// The choices that make these the identifier and the data.
pub fn as_data(id: u16, data: &[u8]) -> Vec<u8> {
    let place = BUS.messages.iter().position(|def| def.id == id).and_then(|place| u8::try_from(place).ok());
    [&[2, 1, place.unwrap_or(0)], data].concat()
}

/// The body.
pub fn body(bytes: &[u8]) {
    let mut bytes = Bytes::new(bytes);
    match bytes.below(4) {
        0 => any_message(&mut bytes),
        1 => any_outputs(&mut bytes),
        _ => {
            let id = if bytes.one_in(4) { bytes.any() } else { bytes.pick(BUS.messages).id };
            let data = bytes.rest();
            any_data(id, data);
        }
    }
}

/// Data is read or refused, and what is read is written again.
fn any_data(id: u16, data: &[u8]) {
    let def = BUS.message(id);
    match BUS.decode(id, data) {
        Ok(message) => {
            let def = def.expect("a message has an identifier of the table");
            assert_eq!((message.id(), def.id), (id, id));
            for signal in def.signals {
                let raw = signal.raw(data).expect("what was read is long enough for every signal");
                assert!(signal.allows(raw) && signal.check(raw).is_ok(), "{signal:?} is {raw}");
                shown(signal, raw);
            }
            same_again(message);
            let frame = encoded(message);
            for signal in def.signals {
                assert_eq!(signal.raw(data), signal.raw(frame.data()), "{signal:?}");
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
    received(id, data);
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
fn received(id: u16, data: &[u8]) {
    let mut ai = AiMessages::default();
    match ai.receive(BUS, id, data) {
        Ok(true) => assert!(BUS.decode(id, data).is_ok()),
        Ok(false) => assert_eq!(ai, AiMessages::default()),
        Err(_) => {
            assert_eq!(ai, AiMessages::default());
            assert!(BUS.decode(id, data).is_err());
        }
    }
}

/// A message is read as it was written; one that the edition cannot say is read as what it can.
fn same_again(message: AnyMessage) {
    let Some(def) = BUS.message(message.id()) else {
        return assert!(BUS.encode(message).is_none() && !BUS.holds(message), "{message:?}");
    };
    let frame = encoded(message);
    assert!(frame.is_valid() && frame.id == def.id && frame.data().len() == usize::from(def.len));
    let read = BUS.decode(frame.id, frame.data()).expect("what is written can be read");
    assert!(BUS.holds(read) && (read == message) == BUS.holds(message), "{message:?}");
}

fn any_message(bytes: &mut Bytes<'_>) {
    if let Ok(message) = bytes.0.arbitrary::<AnyMessage>() {
        same_again(message);
    }
}

/// What a VCU sends, whatever it sees and whatever its outputs are, can be read.
fn any_outputs(bytes: &mut Bytes<'_>) {
    let (Ok(outputs), Ok(inputs)) = (bytes.0.arbitrary::<Outputs>(), bytes.0.arbitrary::<Inputs>()) else {
        return;
    };
    let messages = outputs.messages(&inputs);
    for frame in messages.frames(BUS) {
        let message = BUS.decode(frame.id, frame.data());
        same_again(message.expect("the VCU sends what its messages allow"));
    }
    // The outputs may be of a later version, and show what this one does not have.
    let read = BUS.decode_as(encoded(messages.status).data());
    assert_eq!(read == Ok(messages.status), BUS.holds(messages.status), "{messages:?}");
}
