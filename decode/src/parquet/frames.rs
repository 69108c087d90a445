//! A row for each frame.

use ::parquet::data_type::ByteArray;
use ::parquet::errors::Result as ParquetResult;
use ::parquet::file::metadata::KeyValue;
use adsdv_oracle::candump::{Direction, FrameKind};

use super::column::{self, Bools, Cells, Smalls, Texts};
use super::file::{TableFile, keys};
use super::head::HeadColumns;
use crate::line::is_extended;
use crate::out::Writer;
use crate::{Catalog, Frame, Sink, SinkError};

/// Writes [`crate::Table::Frames`].
pub(super) struct FrameTable<'a> {
    file: TableFile<'a>,
    columns: FrameColumns,
    names: Vec<ByteArray>,
    directions: [ByteArray; 2],
}

struct FrameColumns {
    head: HeadColumns,
    extended: Bools,
    direction: Texts,
    length: Smalls,
    flags: Smalls,
    message: Texts,
    data: Texts,
}

impl FrameColumns {
    fn new() -> ParquetResult<Self> {
        Ok(Self {
            head: HeadColumns::new()?,
            extended: column::bools("extended")?,
            direction: column::texts("direction")?,
            length: column::smalls("length")?,
            flags: column::smalls("flags")?,
            message: column::texts("message")?,
            data: column::bytes("data")?,
        })
    }

    fn all(&mut self) -> [&mut dyn Cells; 10] {
        let HeadColumns { time, interface, id, kind, .. } = &mut self.head;
        let Self { extended, direction, length, flags, message, data, .. } = self;
        [time, interface, id, extended, kind, direction, length, flags, message, data]
    }
}

impl<'a> FrameTable<'a> {
    pub(super) fn new(catalog: &Catalog, writer: Writer<'a>, source: &str) -> Result<Self, SinkError> {
        Self::with(catalog, writer, keys(catalog, source))
    }

    pub(super) fn with(
        catalog: &Catalog,
        writer: Writer<'a>,
        keys: Vec<KeyValue>,
    ) -> Result<Self, SinkError> {
        let mut columns = FrameColumns::new()?;
        let file = TableFile::new(writer, &columns.all(), keys)?;
        let names = catalog.messages().iter().map(|message| column::text(&message.name)).collect();
        Ok(Self { file, columns, names, directions: ["rx", "tx"].map(column::text) })
    }

    fn write(&mut self) -> Result<(), SinkError> {
        if self.columns.head.next_group() {
            self.file.write(&mut self.columns.all())?;
        }
        Ok(())
    }
}

impl Sink for FrameTable<'_> {
    fn frame(&mut self, frame: &Frame<'_>) -> Result<(), SinkError> {
        let record = frame.record;
        let FrameColumns { head, extended, direction, length, flags, message, data } = &mut self.columns;
        head.frame(record);
        head.push();
        extended.push(is_extended(record.kind));
        let [rx, tx] = &self.directions;
        direction.push(record.direction.map(|direction| match direction {
            Direction::Rx => rx.clone(),
            Direction::Tx => tx.clone(),
        }));
        length.push(match record.kind {
            FrameKind::Remote { len, .. } => i32::from(len),
            _ => i32::try_from(record.data.len()).unwrap_or(i32::MAX),
        });
        flags.push(match record.kind {
            FrameKind::Fd { flags, .. } => Some(i32::from(flags)),
            _ => None,
        });
        message.push(frame.message.and_then(|(place, _)| self.names.get(place).cloned()));
        data.push(head.copy(record.data));
        if self.columns.head.is_enough() { self.write() } else { Ok(()) }
    }

    fn finish(&mut self, _lines: u64) -> Result<(), SinkError> {
        self.write()?;
        Ok(self.file.finish()?)
    }
}
