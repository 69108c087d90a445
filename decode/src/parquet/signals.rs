//! A row for each signal of each frame.

use ::parquet::data_type::ByteArray;
use ::parquet::errors::Result as ParquetResult;

use super::column::{self, Cells, Decimals, Doubles, Texts};
use super::file::{TableFile, keys};
use super::head::HeadColumns;
use crate::out::Writer;
use crate::{Catalog, Frame, Message, Signal, Sink, SinkError, Value};

/// Writes [`crate::Table::Signals`].
pub(super) struct SignalTable<'a> {
    file: TableFile<'a>,
    columns: SignalColumns,
    messages: Vec<MessageCells>,
}

struct SignalColumns {
    head: HeadColumns,
    message: Texts,
    signal: Texts,
    value: Doubles,
    exact: Decimals,
    name: Texts,
    unit: Texts,
    data: Texts,
}

/// What of a message's rows does not depend on the frame.
struct MessageCells {
    name: ByteArray,
    signals: Vec<SignalCells>,
}

struct SignalCells {
    name: ByteArray,
    unit: Option<ByteArray>,
    /// The names of its values, in their order.
    names: Vec<ByteArray>,
}

impl SignalColumns {
    fn new() -> ParquetResult<Self> {
        Ok(Self {
            head: HeadColumns::new()?,
            message: column::texts("message")?,
            signal: column::texts("signal")?,
            value: column::doubles("value")?,
            exact: column::decimals("exact")?,
            name: column::texts("name")?,
            unit: column::texts("unit")?,
            data: column::bytes("data")?,
        })
    }

    fn all(&mut self) -> [&mut dyn Cells; 11] {
        let HeadColumns { time, interface, id, kind, .. } = &mut self.head;
        let Self { message, signal, value, exact, name, unit, data, .. } = self;
        [time, interface, id, kind, message, signal, value, exact, name, unit, data]
    }

    #[inline]
    fn signal(&mut self, message: &ByteArray, cells: &SignalCells, signal: &Signal, bits: u64) {
        let value = signal.value(bits);
        self.head.push();
        self.message.push(message.clone());
        self.signal.push(cells.name.clone());
        self.value.push(value.to_f64());
        self.exact.push(beyond_floats(value).map(column::decimal));
        self.name.push(signal.name_place(bits).and_then(|place| cells.names.get(place).cloned()));
        self.unit.push(cells.unit.clone());
        self.data.push(None);
    }

    fn frame_without_signal(&mut self, message: Option<&ByteArray>, data: &[u8]) {
        let data = self.head.copy(data);
        self.head.push();
        self.message.push(message.cloned());
        self.signal.push(None);
        self.value.push(None);
        self.exact.push(None);
        self.name.push(None);
        self.unit.push(None);
        self.data.push(data);
    }
}

/// A whole number that no double is.
fn beyond_floats(value: Value) -> Option<i128> {
    const EXACT: u128 = 1 << f64::MANTISSA_DIGITS;
    let Value::Whole(number) = value else { return None };
    #[expect(clippy::cast_possible_truncation, reason = "a float of a whole number is one")]
    let is_float = || value.to_f64() as i128 == number;
    (number.unsigned_abs() > EXACT && !is_float()).then_some(number)
}

impl MessageCells {
    fn of(message: &Message) -> Self {
        let signals = message.signals.iter().map(|signal| SignalCells {
            name: column::text(&signal.name),
            unit: (!signal.unit.is_empty()).then(|| column::text(&signal.unit)),
            names: names(signal),
        });
        Self { name: column::text(&message.name), signals: signals.collect() }
    }
}

/// The names of a signal's values, in their order.
pub(super) fn names(signal: &Signal) -> Vec<ByteArray> {
    signal.names.iter().map(|(_, name)| column::text(name)).collect()
}

impl<'a> SignalTable<'a> {
    pub(super) fn new(catalog: &Catalog, writer: Writer<'a>, source: &str) -> Result<Self, SinkError> {
        let mut columns = SignalColumns::new()?;
        let file = TableFile::new(writer, &columns.all(), keys(catalog, source))?;
        Ok(Self { file, columns, messages: catalog.messages().iter().map(MessageCells::of).collect() })
    }

    fn write(&mut self) -> Result<(), SinkError> {
        if self.columns.head.next_group() {
            self.file.write(&mut self.columns.all())?;
        }
        Ok(())
    }
}

impl Sink for SignalTable<'_> {
    fn frame(&mut self, frame: &Frame<'_>) -> Result<(), SinkError> {
        let (record, columns) = (frame.record, &mut self.columns);
        columns.head.frame(record);
        let cells = frame.message.and_then(|(place, _)| self.messages.get(place));
        let mut empty = true;
        if let (Some((_, message)), Some(cells)) = (frame.message, cells) {
            for (signal, of_signal) in message.signals.iter().zip(&cells.signals) {
                let Some(bits) = signal.place.bits(record.data).filter(|_| message.has(signal, record.data))
                else {
                    continue;
                };
                empty = false;
                columns.signal(&cells.name, of_signal, signal, bits);
            }
        }
        if empty {
            columns.frame_without_signal(cells.map(|cells| &cells.name), record.data);
        }
        if columns.head.is_enough() { self.write() } else { Ok(()) }
    }

    fn finish(&mut self, _lines: u64) -> Result<(), SinkError> {
        self.write()?;
        Ok(self.file.finish()?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_is_exact_beside_its_double_where_that_is_another() {
        let beyond = |number: i128| beyond_floats(Value::Whole(number));
        let limit = 1 << 53;
        for float in [0, -1, limit, -limit, limit + 2, 1 << 63] {
            assert_eq!(beyond(float), None, "{float}");
        }
        for number in [limit + 1, -limit - 1, i128::from(u64::MAX), 3 * i128::from(u64::MAX)] {
            assert_eq!(beyond(number), Some(number));
        }
        assert_eq!(beyond_floats(Value::Real(f64::MAX)), None);
    }
}
