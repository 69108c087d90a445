//! The exported CAN database of any edition, read by another program, is the codec: what either encodes the other decodes.

use std::fmt;
use std::sync::LazyLock;

use adsdv_spec::export::Dbc;
use adsdv_spec::messages::{AnyMessage, Frame};
use adsdv_spec::{Bus, Edition};
use can_dbc::{ByteOrder, MessageId, Signal, ValueType};
use proptest::prelude::{BoxedStrategy, Strategy, any};
use proptest::sample;

use crate::holds::{holds, regressions};

/// How many frames are tried; each of every message of every edition a dozen times and more.
const CASES: u32 = 1000;

/// The export of an edition, read back.
struct ReadBack {
    edition: &'static Edition,
    database: can_dbc::Dbc,
}

/// Briefly, for the file of what has failed.
impl fmt::Debug for ReadBack {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "edition {}", self.edition.version)
    }
}

static READ_BACK: LazyLock<Vec<ReadBack>> = LazyLock::new(|| {
    let read_back = |&edition: &&'static Edition| {
        let text = Dbc(edition).to_string();
        let database = can_dbc::Dbc::try_from(text.as_str());
        let database = database.unwrap_or_else(|error| panic!("{}: no database: {error}", edition.version));
        ReadBack { edition, database }
    };
    Edition::ALL.iter().map(read_back).collect()
});

/// That of any edition.
fn any_edition() -> impl Strategy<Value = &'static ReadBack> {
    sample::select(READ_BACK.iter().collect::<Vec<_>>())
}

impl ReadBack {
    fn bus(&self) -> &'static Bus {
        &self.edition.bus
    }

    fn message(&self, id: u16) -> &can_dbc::Message {
        let found = self.database.messages.iter().find(|message| message.id == MessageId::Standard(id));
        found.unwrap_or_else(|| panic!("{id:03X} is in the database of {}", self.edition.version))
    }

    fn encoded(&self, message: AnyMessage) -> Frame {
        self.bus().encode(message).expect("a message of the edition")
    }
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
fn decodes_alike(of: &ReadBack, frame: &Frame) -> Result<(), String> {
    let def = of.bus().message(frame.id).ok_or("no message of the table")?;
    let message = of.message(frame.id);
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

/// Any frame of any message of an edition: every bit pattern, whether its values are allowed or not.
fn any_frame() -> impl Strategy<Value = (&'static ReadBack, Frame)> {
    any_edition().prop_flat_map(|of| {
        (sample::select(of.bus().messages.to_vec()), any::<[u8; 8]>())
            .prop_map(move |(def, data)| (of, Frame::new(def.id, &data[..def.len.into()]).expect("a frame")))
    })
}

/// Any message that an edition has.
fn any_message() -> impl Strategy<Value = (&'static ReadBack, AnyMessage)> {
    (any_edition(), any::<AnyMessage>())
        .prop_filter("a message of the edition", |(of, message)| of.bus().message(message.id()).is_some())
}

/// Any raw value that the database allows for each signal of some message.
fn any_values() -> impl Strategy<Value = (&'static ReadBack, u16, Vec<i64>)> {
    let of_message = |of: &'static ReadBack, id: u16| {
        let values: Vec<_> = of.message(id).signals.iter().map(|signal| any_value(of, id, signal)).collect();
        values.prop_map(move |values| (of, id, values))
    };
    any_edition().prop_flat_map(move |of| {
        sample::select(of.bus().messages.to_vec()).prop_flat_map(move |def| of_message(of, def.id))
    })
}

fn any_value(of: &ReadBack, id: u16, signal: &Signal) -> BoxedStrategy<i64> {
    let named = of.database.value_descriptions_for_signal(MessageId::Standard(id), &signal.name);
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
fn data_of(of: &ReadBack, id: u16, values: &[i64]) -> [u8; 8] {
    let mut data = [0; 8];
    let signals = &of.message(id).signals;
    signals.iter().zip(values).for_each(|(signal, &raw)| put(signal, raw, &mut data));
    data
}

fn tell(of: &ReadBack, what: impl fmt::Display) -> String {
    format!("edition {}: {what}", of.edition.version)
}

#[test]
fn any_bits_decode_alike() {
    holds(
        CASES,
        regressions!("dbc"),
        &any_frame(),
        |(of, frame)| decodes_alike(of, frame),
        |(of, frame)| tell(of, frame),
    );
}

#[test]
fn what_the_codec_encodes_the_database_decodes() {
    let decodes = |(of, message): &(&ReadBack, AnyMessage)| {
        let frame = of.encoded(*message);
        let again = of.bus().decode(frame.id, frame.data());
        if (again == Ok(*message)) != of.bus().holds(*message) {
            return Err(format!("the codec reads {again:?}"));
        }
        decodes_alike(of, &frame)
    };
    holds(CASES, regressions!("dbc"), &any_message(), decodes, |(of, message)| {
        tell(of, format_args!("{message:?}\n{}", of.encoded(*message)))
    });
}

#[test]
fn what_the_database_encodes_the_codec_decodes() {
    let decodes = |(of, id, values): &(&ReadBack, u16, Vec<i64>)| {
        let data = data_of(of, *id, values);
        let data = &data[..to_usize(of.message(*id).size)];
        let read = of.bus().decode(*id, data).map_err(|error| error.to_string())?;
        let written = of.encoded(read);
        // Of two numbers that mean the same the codec writes one: AS_INIT of 2026 is read as AS_OFF.
        let def = of.bus().message(*id).ok_or("no message of the table")?;
        let meant = def.signals.iter().fold([0; 8], |meant, signal| {
            let raw = signal.raw(data).map_or(0, |raw| signal.meaning(raw));
            signal.put(meant, raw)
        });
        if written.data() != &meant[..data.len()] {
            return Err(format!("the codec writes {written}"));
        }
        decodes_alike(of, &written)
    };
    holds(CASES, regressions!("dbc"), &any_values(), decodes, |(of, id, values)| {
        tell(of, format_args!("{id:03X}, {values:?}: {:02X?}", data_of(of, *id, values)))
    });
}
