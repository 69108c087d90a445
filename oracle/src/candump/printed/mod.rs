//! Lines that were printed for a person, and that people record or paste all the same: those of candump without `-L`, and those of
//! python-can.
//!
//! ```text
//!   vcan0  520   [8]  00 00 01 00 00 00 00 00                         candump vcan0 (screen)
//!  (000.010123)  vcan0  520   [8]  00 00 01 00 00 00 00 00            -t d, -t z: which of the two, Clock finds out
//!  (2026-11-25 12:00:00.010123)  vcan0  RX - -  520   [8]  00 00      -t A, and -x
//! Timestamp:        1.500000    ID:      520    S Rx                DL:  2    00 00     Channel: vcan0        (python_can)
//! ```
//!
//! In a log they may stand between those of `-L`. What a line says of the time, [`Clock`] makes a time of.

mod clock;
mod date;
mod python_can;
mod screen;

use memchr::memchr;

use super::cursor::Cursor;
use super::error::Flaw;
use super::record::{Direction, FrameKind, MAX_DATA};

pub(super) use clock::Clock;

/// What a line says of the time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Stamp {
    /// Nothing.
    None,
    /// A time since 1970, in nanoseconds.
    Absolute(i64),
    /// Nanoseconds since the first frame, or since the frame before: the line does not tell which.
    Since(i64),
}

/// What a line says, apart from the data bytes themselves.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Printed<'a> {
    pub(super) stamp: Stamp,
    pub(super) interface: &'a str,
    pub(super) kind: FrameKind,
    pub(super) id: u32,
    /// Number of data bytes.
    pub(super) len: usize,
    pub(super) direction: Option<Direction>,
}

/// Reads a line without its line feed, and puts the frame's data into `data`; `None` if it is of another sort.
pub(super) fn parse<'a>(line: &'a [u8], data: &mut [u8; MAX_DATA]) -> Option<Result<Printed<'a>, Flaw>> {
    let mut cursor = Cursor::new(line);
    cursor.skip_blanks();
    if cursor.rest().starts_with(python_can::MARK) {
        return Some(python_can::read(cursor, data));
    }
    // A '#' behind that may be a character of the data.
    let before = line.get(..memchr(b'[', line)?).unwrap_or_default();
    if memchr(b'#', before).is_some() {
        return None;
    }
    Some(screen::read(cursor, data))
}
