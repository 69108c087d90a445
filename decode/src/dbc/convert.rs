//! From what the parser gives to messages.

use std::collections::HashMap;
use std::ops::RangeInclusive;

use can_dbc::{
    ByteOrder, MessageId, MultiplexIndicator, SignalExtendedValueType, ValDescription, ValueDescription,
    ValueType,
};

use super::DbcError;
use super::lines::MessageLines;
use crate::place::MAX_BITS;
use crate::signal::{Multiplexed, Scaling};
use crate::{Coding, Message, Order, Origin, Place, Signal};

/// The largest identifiers.
const MAX_STANDARD: u64 = 0x7FF;
/// In a database this bit says that an identifier is extended.
const EXTENDED: u64 = 1 << 31;

/// A multiplexer, by its name, and the values by which it chooses.
type Chosen<'a> = (&'a str, Vec<RangeInclusive<u64>>);

/// What stands apart from the messages, found by message and signal.
pub(super) struct Tables<'a> {
    names: HashMap<(MessageId, &'a str), &'a [ValDescription]>,
    floats: HashMap<(MessageId, &'a str), SignalExtendedValueType>,
    multiplexers: HashMap<(MessageId, &'a str), Chosen<'a>>,
}

impl<'a> Tables<'a> {
    pub(super) fn of(parsed: &'a can_dbc::Dbc) -> Self {
        let names = parsed.value_descriptions.iter().filter_map(|values| match values {
            ValueDescription::Signal { message_id, name, value_descriptions } => {
                Some(((*message_id, name.as_str()), value_descriptions.as_slice()))
            }
            ValueDescription::EnvironmentVariable { .. } => None,
        });
        let floats = parsed.signal_extended_value_type_list.iter();
        let floats =
            floats.map(|of| ((of.message_id, of.signal_name.as_str()), of.signal_extended_value_type));
        let multiplexers = parsed.extended_multiplex.iter().map(|of| {
            let values = of.mappings.iter().map(|values| values.min_value..=values.max_value).collect();
            ((of.message_id, of.signal_name.as_str()), (of.multiplexor_signal_name.as_str(), values))
        });
        Self { names: names.collect(), floats: floats.collect(), multiplexers: multiplexers.collect() }
    }
}

/// A message, if every signal of it fits it.
pub(super) fn message(
    message: &can_dbc::Message,
    tables: &Tables<'_>,
    lines: &MessageLines<'_>,
) -> Result<Message, DbcError> {
    let name = clean(&message.name);
    // The parser cuts identifiers off.
    let written = lines.id.unwrap_or_else(|| message.id.raw().into());
    let (extended, id) = (written & EXTENDED != 0, written & !EXTENDED);
    let most = if extended { 0x1FFF_FFFF } else { MAX_STANDARD };
    let Some(id) = u32::try_from(id).ok().filter(|&id| u64::from(id) <= most) else {
        let hint = "an extended one has 2147483648 added";
        return Err(DbcError::at(
            lines.line,
            format!("{name} has the identifier {written}, and no frame has that; {hint}"),
        ));
    };
    let Some(len) = usize::try_from(message.size).ok().filter(|&len| len <= MAX_BITS as usize / 8) else {
        let size = message.size;
        return Err(DbcError::at(lines.line, format!("{name} has {size} bytes, and a frame has at most 64")));
    };
    let signals = &message.signals;
    let places: HashMap<&str, usize> = signals.iter().map(|signal| signal.name.as_str()).zip(0..).collect();
    let convert = |signal: &can_dbc::Signal| -> Result<Signal, DbcError> {
        let refuse = |what: String| DbcError::at(lines.of_signal(&signal.name), what);
        let key = (message.id, signal.name.as_str());
        let place =
            place(signal, tables.floats.get(&key).copied()).filter(|place| place.bytes_needed() <= len);
        let Some(place) = place else {
            let (start, size) = (signal.start_bit, signal.size);
            return Err(refuse(format!(
                "{} has {size} bits from bit {start} on, and {name} has {len} bytes; a float has 32 bits or 64",
                clean(&signal.name)
            )));
        };
        let multiplexed =
            multiplexed(signal, signals, &places, tables.multiplexers.get(&key)).map_err(refuse)?;
        Ok(Signal {
            name: clean(&signal.name),
            unit: clean(&signal.unit),
            place,
            scaling: Scaling::of(signal.factor, signal.offset),
            names: names(tables.names.get(&key).copied().unwrap_or_default()),
            multiplexed,
            doc: "".into(),
        })
    };
    Ok(Message {
        signals: signals.iter().map(convert).collect::<Result<_, _>>()?,
        name,
        id,
        extended,
        len,
        origin: Origin::Database(0),
        doc: "".into(),
    })
}

fn place(signal: &can_dbc::Signal, float: Option<SignalExtendedValueType>) -> Option<Place> {
    let order = match signal.byte_order {
        ByteOrder::LittleEndian => Order::Little,
        ByteOrder::BigEndian => Order::Big,
    };
    let integer = match signal.value_type {
        ValueType::Signed => Coding::Signed,
        ValueType::Unsigned => Coding::Unsigned,
    };
    let (coding, right) = match float {
        Some(SignalExtendedValueType::IEEEfloat32Bit) => (Coding::Float, signal.size == 32),
        Some(SignalExtendedValueType::IEEEdouble64bit) => (Coding::Float, signal.size == 64),
        Some(SignalExtendedValueType::SignedOrUnsignedInteger) | None => (integer, true),
    };
    let (start, width) = (u32::try_from(signal.start_bit).ok()?, u32::try_from(signal.size).ok()?);
    Place::new(start, width, order, coding).filter(|_| right)
}

/// By what a signal is chosen: what is said of it apart from the message, or else the only multiplexer that there is.
fn multiplexed(
    signal: &can_dbc::Signal,
    signals: &[can_dbc::Signal],
    places: &HashMap<&str, usize>,
    apart: Option<&Chosen<'_>>,
) -> Result<Option<Multiplexed>, String> {
    if let Some((by, values)) = apart {
        let missing = || format!("{} is multiplexed by {by}, which the message does not have", signal.name);
        let by = places.get(by).copied().ok_or_else(missing)?;
        return Ok(Some(Multiplexed { by, values: values.as_slice().into() }));
    }
    let value = match signal.multiplexer_indicator {
        MultiplexIndicator::Plain | MultiplexIndicator::Multiplexor => return Ok(None),
        MultiplexIndicator::MultiplexedSignal(value)
        | MultiplexIndicator::MultiplexorAndMultiplexedSignal(value) => value,
    };
    let is_multiplexer =
        |other: &can_dbc::Signal| other.multiplexer_indicator == MultiplexIndicator::Multiplexor;
    match signals.iter().position(is_multiplexer) {
        Some(by) => Ok(Some(Multiplexed { by, values: [value..=value].into() })),
        None => Err(format!("{} is multiplexed, and the message has no multiplexer (M)", signal.name)),
    }
}

/// The names of values, each value once: the last name counts.
fn names(values: &[ValDescription]) -> Box<[(i64, Box<str>)]> {
    let names: std::collections::BTreeMap<i64, Box<str>> =
        values.iter().map(|value| (value.id, clean(&value.description))).collect();
    names.into_iter().collect()
}

/// A name without what moves a terminal's cursor: it comes from a file of anybody's.
fn clean(name: &str) -> Box<str> {
    name.chars().map(|letter| if letter.is_control() { '\u{FFFD}' } else { letter }).collect()
}
