//! A Parquet file: row groups, one after the other, and what the file says of itself.

use std::io;
use std::sync::Arc;

use ::parquet::basic::{Compression, Encoding};
use ::parquet::errors::{ParquetError, Result};
use ::parquet::file::metadata::KeyValue;
#[cfg(test)]
use ::parquet::file::metadata::RowGroupMetaData;
use ::parquet::file::properties::{EnabledStatistics, WriterProperties};
use ::parquet::file::writer::SerializedFileWriter;
use ::parquet::schema::types::{ColumnPath, Type};

use super::column::Cells;
use super::head::TIME;
use crate::out::Writer;
use crate::{Catalog, SinkError};

/// A file that is being written.
pub(super) struct TableFile<'a> {
    writer: SerializedFileWriter<Writer<'a>>,
}

impl<'a> TableFile<'a> {
    /// Begins a file with these columns.
    pub(super) fn new(writer: Writer<'a>, columns: &[&mut dyn Cells], keys: Vec<KeyValue>) -> Result<Self> {
        let fields = columns.iter().map(|column| column.field()).collect();
        let schema = Type::group_type_builder("adsdv").with_fields(fields).build()?;
        let time = ColumnPath::from(TIME);
        let properties = WriterProperties::builder()
            .set_compression(Compression::SNAPPY)
            // What is looked for by its message or time is found by those of a group; indexes of pages grow with the recording.
            .set_statistics_enabled(EnabledStatistics::Chunk)
            .set_offset_index_disabled(true)
            // Times hardly come twice, and go on in small steps.
            .set_column_dictionary_enabled(time.clone(), false)
            .set_column_encoding(time, Encoding::DELTA_BINARY_PACKED)
            .set_key_value_metadata(Some(keys))
            .build();
        Ok(Self { writer: SerializedFileWriter::new(writer, Arc::new(schema), Arc::new(properties))? })
    }

    /// Writes the cells of the columns as a row group. They are those with which the file began.
    pub(super) fn write(&mut self, columns: &mut [&mut dyn Cells]) -> Result<()> {
        let mut group = self.writer.next_row_group()?;
        for column in columns {
            if let Some(writer) = group.next_column()? {
                column.write(writer)?;
            }
        }
        group.close().map(drop)
    }

    /// How many rows each group has that was written.
    #[cfg(test)]
    pub(super) fn rows(&self) -> Vec<i64> {
        self.writer.flushed_row_groups().iter().map(RowGroupMetaData::num_rows).collect()
    }

    /// Writes the end of the file.
    pub(super) fn finish(&mut self) -> Result<()> {
        self.writer.finish().map(drop)
    }
}

/// What every file says of itself.
pub(super) fn keys(catalog: &Catalog, source: &str) -> Vec<KeyValue> {
    vec![
        key("version", env!("CARGO_PKG_VERSION")),
        key("edition", catalog.edition().version),
        key("source", source),
    ]
}

/// A key of this program with its value.
pub(super) fn key(name: &str, value: &str) -> KeyValue {
    KeyValue::new(format!("adsdv.{name}"), value.to_owned())
}

impl From<ParquetError> for SinkError {
    /// What the writer said, if it was that which failed.
    fn from(error: ParquetError) -> Self {
        Self(match error {
            ParquetError::External(error) => match error.downcast::<io::Error>() {
                Ok(error) => *error,
                Err(error) => io::Error::other(error),
            },
            error => io::Error::other(error),
        })
    }
}
