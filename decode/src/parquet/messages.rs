//! A file for each message, with a column for each signal.

mod column_of;
mod named;

use std::io;

use ::parquet::errors::Result as ParquetResult;
use ::parquet::file::metadata::KeyValue;

use self::column_of::SignalColumn;
use self::named::Names;
use super::column::{self, Cells, Integers, Texts};
use super::file::{TableFile, key, keys};
use super::frames::FrameTable;
use super::head::{GROUP_ROWS, Recent, TIME};
use crate::out::Writer;
use crate::{Catalog, Frame, Message, Sink, SinkError};

/// The table of the frames that nothing knows.
const UNKNOWN: &str = "unknown_frames";
/// The column of interfaces.
const INTERFACE: &str = "interface";
/// So many cells of all tables together are in memory.
const MOST_CELLS: usize = 1 << 20;
/// What a cell weighs, about, where copies are counted as cells.
const CELL_BYTES: usize = 16;

/// Makes a file of this name.
pub(super) type Create<'a> = Box<dyn FnMut(&str) -> io::Result<Writer<'a>> + 'a>;

/// Writes a file for each message.
pub(super) struct MessageTables<'a> {
    catalog: &'a Catalog,
    create: Create<'a>,
    keys: Vec<KeyValue>,
    /// The names of the files, one for each message.
    names: Vec<String>,
    tables: Vec<Option<MessageTable<'a>>>,
    unknown: Option<FrameTable<'a>>,
    cells: usize,
    most_cells: usize,
}

impl<'a> MessageTables<'a> {
    pub(super) fn new(catalog: &'a Catalog, create: Create<'a>, source: &str) -> Self {
        // A file system may not tell capitals from small letters.
        let mut names = Names::without_case([UNKNOWN]);
        let names = catalog.messages().iter().map(|message| names.file(&message.name, &message.id_text()));
        Self {
            catalog,
            create,
            keys: keys(catalog, source),
            names: names.collect(),
            tables: catalog.messages().iter().map(|_| None).collect(),
            unknown: None,
            cells: 0,
            most_cells: MOST_CELLS,
        }
    }

    fn unknown(&mut self, frame: &Frame<'_>) -> Result<(), SinkError> {
        let table = match &mut self.unknown {
            Some(table) => table,
            none => {
                let writer = (self.create)(&format!("{UNKNOWN}.parquet"))?;
                none.insert(FrameTable::with(self.catalog, writer, self.keys.clone())?)
            }
        };
        table.frame(frame)
    }

    /// Writes the rows of the table that has the most.
    fn write_largest(&mut self) -> Result<(), SinkError> {
        let Some(largest) = self.tables.iter_mut().flatten().max_by_key(|table| table.cells) else {
            return Ok(());
        };
        self.cells = self.cells.saturating_sub(largest.cells);
        Ok(largest.write()?)
    }
}

impl Sink for MessageTables<'_> {
    fn frame(&mut self, frame: &Frame<'_>) -> Result<(), SinkError> {
        let Some((place, message)) = frame.message else { return self.unknown(frame) };
        let Some(table) = self.tables.get_mut(place) else { return Ok(()) };
        let table = match table {
            Some(table) => table,
            none => {
                let name = self.names.get(place).map(String::as_str).unwrap_or_default();
                let writer = (self.create)(&format!("{name}.parquet"))?;
                none.insert(MessageTable::new(message, writer, self.keys.clone())?)
            }
        };
        self.cells += table.frame(message, frame);
        if table.rows >= GROUP_ROWS {
            self.cells = self.cells.saturating_sub(table.cells);
            table.write()?;
        }
        if self.cells >= self.most_cells { self.write_largest() } else { Ok(()) }
    }

    fn finish(&mut self, lines: u64) -> Result<(), SinkError> {
        for table in self.tables.iter_mut().flatten() {
            table.finish()?;
        }
        if let Some(unknown) = &mut self.unknown {
            unknown.finish(lines)?;
        }
        Ok(())
    }
}

/// The file of one message.
struct MessageTable<'a> {
    file: TableFile<'a>,
    time: Integers,
    interface: Texts,
    last_interface: Recent,
    signals: Vec<SignalColumn>,
    rows: usize,
    cells: usize,
}

impl<'a> MessageTable<'a> {
    fn new(message: &Message, writer: Writer<'a>, mut keys: Vec<KeyValue>) -> ParquetResult<Self> {
        let mut names = Names::with_case([TIME, INTERFACE]);
        let mut units = serde_json::Map::new();
        let mut signals = Vec::new();
        // A signal has its own name, wherever that can be, before what is made of names.
        let own: Vec<_> = message.signals.iter().map(|signal| names.column(&signal.name)).collect();
        for (signal, name) in message.signals.iter().zip(own) {
            signals.push(SignalColumn::new(signal, &name, &mut names)?);
            if !signal.unit.is_empty() {
                units.insert(name, signal.unit.to_string().into());
            }
        }
        keys.push(key("message", &message.name));
        keys.push(key("id", &message.id_text()));
        keys.push(key("units", &serde_json::Value::Object(units).to_string()));
        let (mut time, mut interface) = (column::times(TIME)?, column::texts(INTERFACE)?);
        let file = TableFile::new(writer, &all(&mut time, &mut interface, &mut signals), keys)?;
        Ok(Self { file, time, interface, last_interface: Recent::new(), signals, rows: 0, cells: 0 })
    }

    /// A row. Tells how many cells that are.
    fn frame(&mut self, message: &Message, frame: &Frame<'_>) -> usize {
        let record = frame.record;
        let copied = self.last_interface.set(record.interface.as_bytes());
        self.time.push(record.time_ns);
        self.interface.push(self.last_interface.cell());
        for (signal, column) in message.signals.iter().zip(&mut self.signals) {
            let bits = signal.place.bits(record.data).filter(|_| message.has(signal, record.data));
            column.push(signal, bits);
        }
        let cells = 2 + self.signals.len() + copied / CELL_BYTES;
        self.rows += 1;
        self.cells += cells;
        cells
    }

    fn write(&mut self) -> ParquetResult<()> {
        self.cells = 0;
        if std::mem::take(&mut self.rows) == 0 {
            return Ok(());
        }
        self.file.write(&mut all(&mut self.time, &mut self.interface, &mut self.signals))
    }

    fn finish(&mut self) -> ParquetResult<()> {
        self.write()?;
        self.file.finish()
    }
}

/// Every column of a message's table.
fn all<'a>(
    time: &'a mut Integers,
    interface: &'a mut Texts,
    signals: &'a mut [SignalColumn],
) -> Vec<&'a mut dyn Cells> {
    let head: [&mut dyn Cells; 2] = [time, interface];
    head.into_iter().chain(signals.iter_mut().flat_map(SignalColumn::all)).collect()
}

#[cfg(test)]
mod tests {
    use adsdv_oracle::candump::{FrameKind, Record};
    use adsdv_spec::Edition;

    use super::*;

    /// However many tables there are: what is in memory is that of all of them together.
    #[test]
    fn the_largest_table_is_written_when_all_have_many_cells() {
        let catalog = Catalog::of(&Edition::V2026);
        let mut tables = MessageTables::new(&catalog, Box::new(|_| Ok(Box::new(Vec::new()))), "run.log");
        tables.most_cells = 1000;
        let (mut most, mut rows) = (0, 0);
        for _ in 0..100 {
            for (place, message) in catalog.messages().iter().enumerate() {
                let (kind, data) = (FrameKind::Standard, &[0; 8][..]);
                let (id, interface) = (message.id, "can0");
                let record = Record {
                    line: 1,
                    time_ns: 0,
                    interface,
                    kind,
                    id,
                    data,
                    direction: None,
                    terminated: true,
                };
                tables.frame(&Frame { record: &record, message: Some((place, message)) }).expect("a vector");
                let cells: usize = tables.tables.iter().flatten().map(|table| table.cells).sum();
                assert_eq!(cells, tables.cells, "the sum is kept");
                most = most.max(cells);
                rows += 1;
            }
        }
        assert!((900..1000).contains(&most), "{most}");
        let written = |table: &MessageTable<'_>| {
            let groups = table.file.rows();
            (groups.iter().sum::<i64>(), groups.len())
        };
        tables.tables.iter_mut().flatten().for_each(|table| table.write().expect("a vector"));
        let groups: Vec<_> = tables.tables.iter().flatten().map(written).collect();
        assert_eq!(groups.iter().map(|(rows, _)| rows).sum::<i64>(), rows);
        assert!(groups.iter().any(|(_, groups)| *groups > 2), "{groups:?}");
    }

    /// An interface of each row costs what it takes.
    #[test]
    fn long_interfaces_are_more_cells() {
        let catalog = Catalog::of(&Edition::V2026);
        let mut tables = MessageTables::new(&catalog, Box::new(|_| Ok(Box::new(Vec::new()))), "run.log");
        let message = catalog.messages().first().map(|message| (0, message));
        let mut cells = || {
            for interface in ["a".repeat(8000), "b".repeat(8000)] {
                let (kind, data, id) = (FrameKind::Standard, &[0; 8][..], 0);
                let record = Record {
                    line: 1,
                    time_ns: 0,
                    interface: &interface,
                    kind,
                    id,
                    data,
                    direction: None,
                    terminated: true,
                };
                tables.frame(&Frame { record: &record, message }).expect("a vector");
            }
            tables.cells
        };
        assert!(cells() > 2 * 8000 / CELL_BYTES);
    }
}
