//! The exported CAN database, read by another program, is the codec: what either encodes the other decodes.

use std::sync::LazyLock;

use adsdv_spec::Edition;
use adsdv_spec::export::Dbc;
use adsdv_spec::messages::{AnyMessage, Frame};
use adsdv_tests::bus::{self, BUS};
use can_dbc::{ByteOrder, MessageId, Signal, ValueType};
use proptest::prelude::{BoxedStrategy, Strategy, any};
use proptest::sample;

use crate::holds::{holds, regressions};

/// How many frames are tried; each of every message some dozens of times.
const CASES: u32 = 1000;

/// The export, read back.
static READ_BACK: LazyLock<can_dbc::Dbc> = LazyLock::new(|| {
    let text = Dbc(Edition::DEFAULT).to_string();
    can_dbc::Dbc::try_from(text.as_str()).unwrap_or_else(|error| panic!("not a CAN database: {error}"))
});

fn message(id: u16) -> &'static can_dbc::Message {
    let found = READ_BACK.messages.iter().find(|message| message.id == MessageId::Standard(id));
    found.unwrap_or_else(|| panic!("{id:03X} is in the database"))
}

/// The places of a signal's bits in the frame, the lowest bit first: byte, and bit in the byte.
///
/// The start bit of a little-endian signal is its lowest; that of a big-endian one is its highest, and the next lower ones
/// follow down the byte, and then from the top of the next byte.
fn places(signal: &Signal) -> Vec<(usize, usize)> {
    let (start, size) = (to_usize(signal.start_bit), to_usize(signal.size));
    match signal.byte_order {
        ByteOrder::LittleEndian => (start..start + size).map(|bit| (bit / 8, bit % 8)).collect(),
        ByteOrder::BigEndian => {
            let first = start / 8 * 8 + (7 - start % 8);
            (first..first + size).rev().map(|bit| (bit / 8, 7 - bit % 8)).collect()
        }
    }
}

fn to_usize(number: u64) -> usize {
    usize::try_from(number).expect("a place in a frame")
}

/// The raw value of a signal by the definition of the database.
fn raw_of(signal: &Signal, data: &[u8]) -> i64 {
    let places = places(signal);
    let bits = places.iter().map(|&(byte, bit)| i64::from(data[byte] >> bit & 1));
    let unsigned = bits.enumerate().fold(0, |raw, (place, bit)| raw | bit << place);
    let negative = signal.value_type == ValueType::Signed && unsigned >> (places.len() - 1) & 1 == 1;
    if negative { unsigned - (1 << places.len()) } else { unsigned }
}

/// Puts a raw value into the data by the definition of the database.
fn put(signal: &Signal, raw: i64, data: &mut [u8; 8]) {
    for (place, (byte, bit)) in places(signal).into_iter().enumerate() {
        data[byte] = data[byte] & !(1 << bit) | u8::from(raw >> place & 1 == 1) << bit;
    }
}

/// Every signal of a frame has the same value by the database and by the table.
fn decodes_alike(frame: &Frame) -> Result<(), String> {
    let def = BUS.message(frame.id).ok_or("no message of the table")?;
    let message = message(frame.id);
    if message.signals.len() != def.signals.len() || to_usize(message.size) != frame.data().len() {
        return Err(format!("{} has another length or number of signals", message.name));
    }
    for signal in &message.signals {
        let ours = def.signal(&signal.name).ok_or_else(|| format!("{} is not in the table", signal.name))?;
        let raw = raw_of(signal, frame.data());
        let by_table = ours.raw(frame.data()).map(i64::from);
        if by_table != Some(raw) {
            return Err(format!("{}: {raw} by the database, {by_table:?} by the table", signal.name));
        }
        // Both are a raw value times a scale; only the last binary digit may differ.
        #[allow(clippy::cast_precision_loss, reason = "raw values are small")]
        let physical = raw as f64 * signal.factor + signal.offset;
        let ours = ours.physical(i32::try_from(raw).map_err(|error| error.to_string())?);
        if (physical - ours).abs() > 1e-9 * physical.abs().max(1.0) {
            return Err(format!("{}: {physical} by the database, {ours} by the table", signal.name));
        }
    }
    Ok(())
}

/// Any frame of any message: every bit pattern, whether its values are allowed or not.
fn any_frame() -> impl Strategy<Value = Frame> {
    (sample::select(BUS.messages.to_vec()), any::<[u8; 8]>())
        .prop_map(|(def, data)| Frame::new(def.id, &data[..def.len.into()]).expect("a frame"))
}

/// Any raw value that the database allows for each signal of some message.
fn any_values() -> impl Strategy<Value = (u16, Vec<i64>)> {
    sample::select(BUS.messages.to_vec()).prop_flat_map(|def| {
        let values: Vec<_> = message(def.id).signals.iter().map(|signal| any_value(def.id, signal)).collect();
        values.prop_map(move |values| (def.id, values))
    })
}

fn any_value(id: u16, signal: &Signal) -> BoxedStrategy<i64> {
    let named = READ_BACK.value_descriptions_for_signal(MessageId::Standard(id), &signal.name);
    if let Some(named) = named.filter(|named| !named.is_empty()) {
        return sample::select(named.iter().map(|value| value.id).collect::<Vec<_>>()).boxed();
    }
    let raw = |bound: &dyn ToString| {
        let physical: f64 = bound.to_string().parse().expect("a number");
        #[allow(clippy::cast_possible_truncation, reason = "raw values are small whole numbers")]
        let raw = ((physical - signal.offset) / signal.factor).round() as i64;
        raw
    };
    (raw(&signal.min)..=raw(&signal.max)).boxed()
}

/// The data in which each signal has such a value, by the database.
fn encoded(id: u16, values: &[i64]) -> [u8; 8] {
    let mut data = [0; 8];
    let signals = &message(id).signals;
    signals.iter().zip(values).for_each(|(signal, &raw)| put(signal, raw, &mut data));
    data
}

#[test]
fn any_bits_decode_alike() {
    holds(CASES, regressions!("dbc"), &any_frame(), decodes_alike, ToString::to_string);
}

#[test]
fn what_the_codec_encodes_the_database_decodes() {
    let decodes = |message: &AnyMessage| {
        let frame = bus::encoded(*message);
        let again = BUS.decode(frame.id, frame.data());
        if (again == Ok(*message)) != BUS.holds(*message) {
            return Err(format!("the codec reads {again:?}"));
        }
        decodes_alike(&frame)
    };
    let any = any::<AnyMessage>()
        .prop_filter("a message of the edition", |message| BUS.message(message.id()).is_some());
    holds(CASES, regressions!("dbc"), &any, decodes, |message| {
        format!("{message:?}\n{}", bus::encoded(*message))
    });
}

#[test]
fn what_the_database_encodes_the_codec_decodes() {
    let decodes = |(id, values): &(u16, Vec<i64>)| {
        let data = encoded(*id, values);
        let data = &data[..to_usize(message(*id).size)];
        let read = BUS.decode(*id, data).map_err(|error| error.to_string())?;
        let written = bus::encoded(read);
        if written.data() != data {
            return Err(format!("the codec writes {written}"));
        }
        decodes_alike(&written)
    };
    holds(CASES, regressions!("dbc"), &any_values(), decodes, |(id, values)| {
        format!("{id:03X}, {values:?}: {:02X?}", encoded(*id, values))
    });
}
