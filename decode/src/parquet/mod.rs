//! Parquet, for DuckDB, pandas and polars: tables, in the columns of which each value has its type.
//!
//! ```text
//! Table::Signals   signals.rs    a row for each signal of each frame
//! Table::Frames    frames.rs     a row for each frame
//! parquet_messages messages.rs   a file for each message, with a row for each of its frames and a column for each signal
//!                     |
//!                  head.rs       the columns that every frame fills
//!                  column.rs     the cells of a column, until there are enough of them
//!                  file.rs       a file: row groups, and what it says of itself
//! ```
//!
//! Written by the crate `parquet`, of the feature of that name. The rows of a group are in memory until it is written, and a group has a
//! bounded number of them; beside these grows only the index at the end of the file, by some kilobytes for each group. The file is written
//! from its beginning to its end, so that it may go into a pipe.
//!
//! A time is a timestamp in nanoseconds as the recording has it. It is not marked as UTC, since not every recording has such times, and since
//! DuckDB would cut those to microseconds. Every column may have nulls.
//!
//! A file says of itself, in its key-value metadata: `adsdv.version`, `adsdv.edition`, `adsdv.source`, which is the name of the recording, and
//! one of a message `adsdv.message`, `adsdv.id` and `adsdv.units`, a JSON object with the units of its columns.

#[cfg(feature = "parquet")]
mod column;
#[cfg(feature = "parquet")]
mod file;
#[cfg(feature = "parquet")]
mod frames;
#[cfg(feature = "parquet")]
mod head;
#[cfg(feature = "parquet")]
mod messages;
#[cfg(feature = "parquet")]
mod signals;

use std::io::{self, Write};

use crate::{BeginError, Catalog, Sink};

/// What a row of one Parquet file is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Table {
    /// A signal of a frame. The columns are
    ///
    /// - `time`: when, a timestamp in nanoseconds;
    /// - `interface`: the CAN interface;
    /// - `id`: the identifier in hexadecimal digits, three of them, or eight of an extended one;
    /// - `kind`: `CAN`, `CAN FD`, `CAN XL frame`, `remote frame` or `error frame`;
    /// - `message`, `signal`: their names;
    /// - `value`: the value in its unit, a double;
    /// - `exact`: the value as a decimal of 38 digits, where it is a whole number that no double is; null elsewhere;
    /// - `name`: the name of the value, where it has one;
    /// - `unit`: the unit, null where there is none;
    /// - `data`: the bytes of a frame that nothing knows, or that is too short for every signal of its message. It has one row, without a
    ///   signal. Null elsewhere.
    Signals,
    /// A frame. The columns are `time`, `interface`, `id`, `kind` and `message` as those of a signal, the latter null for what nothing
    /// knows, and
    ///
    /// - `extended`: whether the identifier has 29 bits;
    /// - `direction`: `rx` or `tx`, null where the recording does not say;
    /// - `length`: the number of data bytes; of a remote frame, that of those asked for;
    /// - `flags`: of CAN FD, 1 for the bit rate switch, 2 for the error state; null for other frames;
    /// - `data`: the data bytes.
    Frames,
}

/// A Parquet file. `source` is the name of the recording.
///
/// # Errors
///
/// Fails without the feature `parquet`, and if the writer fails.
#[cfg_attr(
    not(feature = "parquet"),
    expect(unused_variables, clippy::needless_pass_by_value, reason = "there is nothing to do with them")
)]
pub fn parquet<'a>(
    table: Table,
    catalog: &'a Catalog,
    writer: impl Write + Send + 'a,
    source: &str,
) -> Result<Box<dyn Sink + 'a>, BeginError> {
    #[cfg(feature = "parquet")]
    return Ok(match table {
        Table::Signals => Box::new(signals::SignalTable::new(catalog, Box::new(writer), source)?),
        Table::Frames => Box::new(frames::FrameTable::new(catalog, Box::new(writer), source)?),
    });
    #[cfg(not(feature = "parquet"))]
    Err(NOT_BUILT)
}

/// A Parquet file for each message that comes, made by `create` of a name such as `VCU2AI_Steer.parquet`. `source` is the name of the
/// recording.
///
/// The columns are `time` and `interface`, as in [`Table::Signals`], and one for each signal: a boolean for a bit, an integer of 64 bits
/// or a decimal for whole numbers, a double for all others; null where the frame has no such signal. A signal of which values have
/// names has those in a second column, `_name` behind its own name.
///
/// Frames of no message are in `unknown_frames.parquet`, a table of [`Table::Frames`]. Where two messages have the same name, the
/// identifier is behind that of the second.
///
/// # Errors
///
/// Fails without the feature `parquet`.
#[cfg_attr(not(feature = "parquet"), expect(unused_variables, reason = "there is nothing to do with them"))]
pub fn parquet_messages<'a, W: Write + Send + 'a>(
    catalog: &'a Catalog,
    create: impl FnMut(&str) -> io::Result<W> + 'a,
    source: &str,
) -> Result<Box<dyn Sink + 'a>, BeginError> {
    #[cfg(feature = "parquet")]
    return Ok(Box::new(messages::MessageTables::new(catalog, boxed(create), source)));
    #[cfg(not(feature = "parquet"))]
    Err(NOT_BUILT)
}

/// The same with any kind of file behind a pointer.
#[cfg(feature = "parquet")]
fn boxed<'a, W: Write + Send + 'a>(
    mut create: impl FnMut(&str) -> io::Result<W> + 'a,
) -> messages::Create<'a> {
    Box::new(move |name| Ok(Box::new(create(name)?)))
}

#[cfg(not(feature = "parquet"))]
const NOT_BUILT: BeginError = BeginError::NotBuilt(crate::NotBuilt { format: "Parquet", feature: "parquet" });
