//! Logs of CAN traffic as `candump -L` (can-utils) writes them: one frame on each line.
//!
//! ```text
//! (1795209995.234358) vcan0 520#0000010000000000
//!  seconds             bus  id  data
//! ```
//!
//! A [`Reader`] streams such a log from anything that can be read, in bounded memory and without an
//! allocation for each line, and hands out one [`Entry`] after the other: a [`Record`], which is a frame that
//! was read, a [`Dropped`], which tells of frames that were lost, or a [`LineError`], which is a line that could not be read. A broken line costs itself and nothing
//! else: the reader says what it found and what it expected, and goes on with the next line.
//!
//! Lines that candump or python-can printed for a person are read as well (`printed`): they are what people paste.
//!
//! Everything that can-utils may put on a line is read, whether this interface uses it or not: extended
//! identifiers, remote and error frames, CAN FD and CAN XL, the direction mark of `candump -x`, several
//! buses. What a record means is for the judge to say, not for the reader.
//!
//! [`write_frame`], [`write_record`] and [`write_dropped`] are the way back.
//!
//! ```
//! use adsdv_oracle::candump::{Entry, Reader};
//!
//! let log = "(1.000000) vcan0 520#0000010000000000\nrubbish\n(1.010000) vcan0 520#0000010000000000\n";
//! let mut reader = Reader::new(log.as_bytes());
//! let (mut frames, mut broken) = (0, Vec::new());
//! while let Some(entry) = reader.next_record()? {
//!     match entry {
//!         Entry::Frame(record) => frames += usize::from(record.id == 0x520),
//!         Entry::Dropped(_) => {}
//!         Entry::Broken(error) => broken.push(error.to_string()),
//!     }
//! }
//! assert_eq!(frames, 2);
//! assert_eq!(broken, [r#"line 2, column 1: found "rubbish", expected a time such as (1436509052.249713)"#]);
//! # Ok::<(), adsdv_oracle::candump::ReadError>(())
//! ```

mod cursor;
mod dropped;
mod entries;
mod error;
mod frame;
mod hex;
mod line;
mod printed;
mod reader;
mod record;
mod said;
#[cfg(test)]
mod tests;
mod time;
mod unit;
mod usual;
mod writer;

pub use dropped::Dropped;
pub use entries::{Entries, Entry};
pub use error::{Excerpt, LineError, ReadError};
pub use reader::Reader;
pub use record::{Direction, FrameKind, Record};
pub use unit::Unit;
pub use writer::{write_dropped, write_frame, write_record};

/// The longest line that is read, in bytes; a longer one is reported as broken.
///
/// The longest that can-utils can print is a CAN XL frame with 2048 bytes of data separated by dots, a little
/// over 6 kB. A limit is needed so that a file without line ends does not fill the memory.
pub const MAX_LINE: usize = 8 * 1024;
