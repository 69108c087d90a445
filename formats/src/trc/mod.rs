//! PEAK TRC: the trace of PCAN-View and PCAN-Explorer, versions 1.0, 1.1, 1.2, 1.3, 2.0 and 2.1, and that of python-can.
//!
//! ```text
//! ;$FILEVERSION=1.1                                      ;$FILEVERSION=2.1
//! ;$STARTTIME=46351.5516444444                           ;$STARTTIME=46351.5516444444
//! ;---+--   ----+----  --+--  ----+---  +  -+ -- --      ;$COLUMNS=N,O,T,B,I,d,R,L,D
//!      1)      1841.7  Rx         0520  3  00 00 01            1   1841.700 DT  1     0520 Rx -  3    00 00 01
//!      2)      1842.2  Tx     18FF50E5  2  RTR                 2   1842.200 RR  1 18FF50E5 Tx -  2
//!      3)      1843.0  Warng  FFFFFFFF  4  00 00 00 08         3   1843.000 ST  1        - Rx -  4    00 00 00 08
//! ```
//!
//! It is described in "PEAK CAN TRC File Format" by PEAK-System, and read and written by `can/io/trc.py` of python-can.
//!
//! - The version says what stands in a line, and from 2.0 on `$COLUMNS`; without either it is version 1.0.
//! - The time is in milliseconds from `$STARTTIME`, days since 1899-12-30; from zero where that is missing, as in version 1.0.
//! - The interface is the number of the bus, and `1` where there is no column for it.
//! - An identifier of more than 4 digits is an extended one.
//! - An error frame has the identifier 0 and no data: what stands behind it is about the controller that saw it.
//!
//! Not read: states of the controller and the bus (`Warng`, `ST`, `EC`, and the identifier FFFFFFFF in version 1.0), events of the user
//! (`EV`), and the start time that version 1.0 has in a comment.

use adsdv_oracle::candump::{Direction, FrameKind};

use crate::text::{
    Cursor, Dialect, Flaw, Frame, MAX_CLASSIC, MAX_FD, Meaning, Word, days_ns, decimal, fd_len, hex,
    standard_or_extended, time_ns,
};

use columns::{Column, Columns};
use sort::Sort;

mod columns;
mod sort;

const VERSION: &str = "a version that is read: 1.0, 1.1, 1.2, 1.3, 2.0 or 2.1";
const START: &str = "days since 1899-12-30, such as 46351.5516444444";
const COLUMNS: &str =
    "columns such as N,O,T,B,I,d,R,L,D, the offset, type, identifier, length and data among them";
const NUMBER: &str =
    "the number of a frame, such as 1) or, from version 2.0 on, 1; the header says what stands behind it";
const OFFSET: &str = "a time in milliseconds, such as 1841.7, before the year 2262";
const BUS: &str = "the number of a bus, such as 1";
const ID: &str = "an identifier of 4 digits up to 07FF, or of 8 up to 1FFFFFFF";
const DIRECTION: &str = "Rx (received) or Tx (sent)";
const RESERVED: &str = "-, which stands for nothing";
const CODE: &str = "a length code, up to 15";
const LEN: &str = "the number of data bytes, up to 8, or 64 for CAN FD";
const DATA: &str = "a byte of data, such as 0A, as many as the length before them says";
const END: &str = "the end of the line: the length before the data says that there are no more";

const NS_PER_MILLISECOND: i64 = 1_000_000;

/// Whether a recording that begins so is one.
pub(crate) fn is(head: &[u8]) -> bool {
    head.trim_ascii_start().starts_with(b";")
}

/// Reads its lines.
pub(crate) struct Trc {
    columns: Columns,
    start_ns: i64,
}

impl Trc {
    pub(crate) const fn new() -> Self {
        Self { columns: Columns::V1_0, start_ns: 0 }
    }
}

impl Dialect for Trc {
    const SHORTER: &'static str =
        "a line of at most 8192 bytes, such as 1) 1841.7 Rx 0520 8 00 00 01 00 00 00 00 00";

    fn read(&mut self, line: &[u8], frame: &mut Frame) -> Result<Meaning, Flaw> {
        let mut cursor = Cursor::new(line);
        cursor.skip_blanks();
        if cursor.peek() == Some(b';') {
            return self.header(cursor).map(|()| Meaning::Other);
        }
        self.frame(cursor, frame)
    }
}

/// What has been read of a line so far.
struct Parts {
    sort: Sort,
    extended: bool,
    len: usize,
}

impl Trc {
    /// Reads a header, or a comment.
    fn header(&mut self, mut cursor: Cursor<'_>) -> Result<(), Flaw> {
        let key = cursor.up_to(|byte| byte == b'=');
        cursor.skip(1);
        cursor.skip_blanks();
        let value = Word { at: cursor.at(), text: cursor.rest().trim_ascii_end() };
        match key.text.trim_ascii_end() {
            b";$FILEVERSION" => {
                // A file may begin in the middle of another.
                *self = Self::new();
                self.columns = Columns::of_version(value.text).ok_or_else(|| value.flaw(VERSION))?;
            }
            b";$STARTTIME" => self.start_ns = days_ns(value.text).ok_or_else(|| value.flaw(START))?,
            b";$COLUMNS" => self.columns = Columns::named(value.text).ok_or_else(|| value.flaw(COLUMNS))?,
            _ => {}
        }
        Ok(())
    }

    /// Reads a frame, or an event.
    fn frame(&self, mut cursor: Cursor<'_>, frame: &mut Frame) -> Result<Meaning, Flaw> {
        let mut parts = Parts { sort: Sort::Data, extended: false, len: 0 };
        frame.direction = None;
        if !self.columns.bus {
            frame.set_interface(Word { text: b"1", at: 0 }, BUS)?;
        }
        for column in self.columns.iter() {
            if column == Column::Type {
                let word = cursor.word();
                (parts.sort, frame.direction) = Sort::of(word)?;
                match parts.sort {
                    Sort::Event => return Ok(Meaning::Other),
                    Sort::Error => return self.error(cursor, frame),
                    _ => {}
                }
            } else if column == Column::Id && !self.columns.typed && is_status(cursor) {
                return Ok(Meaning::Other);
            } else {
                self.take(column, &mut cursor, &mut parts, frame)?;
            }
        }
        if !cursor.is_at_end() {
            return Err(cursor.flaw(END));
        }
        let Parts { sort, extended, len } = parts;
        frame.kind = match sort {
            Sort::Remote => FrameKind::Remote { extended, len: u8::try_from(len).unwrap_or(8) },
            Sort::Fd(flags) => FrameKind::Fd { extended, flags },
            _ if extended => FrameKind::Extended,
            _ => FrameKind::Standard,
        };
        Ok(Meaning::Frame)
    }

    /// Takes one column.
    #[inline]
    fn take(
        &self,
        column: Column,
        cursor: &mut Cursor<'_>,
        parts: &mut Parts,
        frame: &mut Frame,
    ) -> Result<(), Flaw> {
        if column == Column::Data {
            return data(cursor, parts, frame);
        }
        let word = cursor.word();
        match column {
            Column::Number => {
                let number = word.text.strip_suffix(b")").unwrap_or(word.text);
                // It is not used, so that its digits need not be added up.
                let is_number = !number.is_empty() && number.iter().all(u8::is_ascii_digit);
                if is_number { Ok(()) } else { Err(word.flaw(NUMBER)) }
            }
            Column::Offset => {
                let offset = time_ns(word.text, NS_PER_MILLISECOND);
                let time = offset.and_then(|offset| self.start_ns.checked_add(offset));
                frame.time_ns = time.ok_or_else(|| word.flaw(OFFSET))?;
                Ok(())
            }
            Column::Bus => bus(word, frame),
            Column::Id => {
                let extended = word.text.len() > 4;
                let id = hex(word.text).filter(|id| standard_or_extended(extended, *id).is_some());
                frame.id = id.ok_or_else(|| word.flaw(ID))?;
                parts.extended = extended;
                Ok(())
            }
            Column::Direction => {
                frame.direction = Some(direction(word).ok_or_else(|| word.flaw(DIRECTION))?);
                Ok(())
            }
            Column::Reserved => {
                if word.text == b"-" {
                    Ok(())
                } else {
                    Err(word.flaw(RESERVED))
                }
            }
            Column::Code => {
                let code = decimal(word.text).filter(|code| *code <= 15).ok_or_else(|| word.flaw(CODE))?;
                let len = fd_len(code).unwrap_or(MAX_FD);
                parts.len = if parts.sort.is_fd() { len } else { len.min(MAX_CLASSIC) };
                Ok(())
            }
            Column::Len => {
                let most = if parts.sort.is_fd() { MAX_FD } else { MAX_CLASSIC };
                let len = decimal(word.text).and_then(|len| usize::try_from(len).ok());
                parts.len = len.filter(|len| *len <= most).ok_or_else(|| word.flaw(LEN))?;
                Ok(())
            }
            Column::Type | Column::Data | Column::Other => Ok(()),
        }
    }

    /// An error frame, whose other columns may be empty.
    fn error(&self, mut cursor: Cursor<'_>, frame: &mut Frame) -> Result<Meaning, Flaw> {
        let mut rest = cursor;
        let word = cursor.word();
        if self.columns.follows(Column::Type, Column::Bus) {
            bus(word, frame)?;
        }
        let mut found = None;
        while found.is_none() && !rest.is_at_end() {
            found = direction(rest.word());
        }
        frame.set_error(found);
        Ok(Meaning::Frame)
    }
}

/// Whether it is no frame but the state of the bus, which version 1.0 gives this identifier.
fn is_status(mut cursor: Cursor<'_>) -> bool {
    cursor.word().text == b"FFFFFFFF"
}

fn bus(word: Word<'_>, frame: &mut Frame) -> Result<(), Flaw> {
    decimal(word.text).ok_or_else(|| word.flaw(BUS))?;
    frame.set_interface(word, BUS)
}

fn direction(word: Word<'_>) -> Option<Direction> {
    match word.text {
        b"Rx" => Some(Direction::Rx),
        b"Tx" => Some(Direction::Tx),
        _ => None,
    }
}

/// Takes the data, or what says that there are none.
#[inline]
fn data(cursor: &mut Cursor<'_>, parts: &mut Parts, frame: &mut Frame) -> Result<(), Flaw> {
    let mut behind = *cursor;
    behind.skip_blanks();
    if behind.peek() == Some(b'R') && parts.sort == Sort::Data && behind.word().text == b"RTR" {
        *cursor = behind;
        parts.sort = Sort::Remote;
    }
    let len = if parts.sort == Sort::Remote { 0 } else { parts.len };
    cursor.take_hex(frame.room(len), DATA)
}

#[cfg(test)]
mod tests;
