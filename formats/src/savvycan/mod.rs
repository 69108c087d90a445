//! The CSV of SavvyCAN, which it writes unless it is asked for another format: one frame on each line.
//!
//! ```text
//! Time Stamp,ID,Extended,Dir,Bus,LEN,D1,D2,D3,D4,D5,D6,D7,D8
//! 166064000,00000520,false,Rx,0,8,00,00,01,00,00,00,00,00,
//! ```
//!
//! - The time is in microseconds, since the adapter began or since 1970.
//! - The interface is the number of the bus, which counts from 0.
//! - Older files have no column `Dir`, and their frames no direction.
//! - What fills a line up behind the data, empty columns or `00` up to D8, is no data.
//! - A frame of CAN FD is not marked: one of more than 8 bytes can be nothing else and is handed out as that, without flags, and a shorter
//!   one as a classic frame.
//!
//! Not read: other columns, other separators and quotes. Remote and error frames are not marked either: they are read as the data frames
//! that they look like.

use adsdv_oracle::candump::{Direction, FrameKind};

use crate::text::{
    Cursor, Dialect, Flaw, Frame, MAX_CLASSIC, MAX_FD, Meaning, decimal, hex, hex_byte, standard_or_extended,
};

const LINE: &str = "a line such as 166064000,00000520,false,Rx,0,8,00,00,01,00,00,00,00,00, with as many columns as its header names";
const TIME: &str = "a time in microseconds, such as 166064000, before the year 2262";
const ID: &str = "an identifier in hexadecimal, such as 00000520: up to 7FF, or 1FFFFFFF if it is extended";
const EXTENDED: &str = "true or false: whether the identifier is an extended one";
const DIRECTION: &str = "Rx (received) or Tx (sent)";
const BUS: &str = "the number of a bus, such as 0";
const LEN: &str = "how many bytes of data the frame has, up to 8, or 64 for CAN FD";
const DATA: &str = "a byte of data, such as 0A, as many as the length before them says";
const END: &str = "the end of the data: there are more bytes than the length before them says";

const NS_PER_MICROSECOND: i64 = 1_000;

/// Whether a recording that begins so is one.
pub(crate) fn is(head: &[u8]) -> bool {
    header(Cursor::new(head).up_to(|byte| byte == b'\n').text).is_some()
}

/// Reads its lines.
pub(crate) struct SavvyCan {
    /// There is a column `Dir`.
    directed: bool,
}

impl SavvyCan {
    pub(crate) const fn new() -> Self {
        Self { directed: true }
    }
}

/// Whether the columns of a header have a direction among them; `None` if it is no header.
fn header(line: &[u8]) -> Option<bool> {
    let mut cursor = Cursor::new(line);
    let first = cursor.up_to(|byte| byte == b',').trimmed();
    let mut next_is = |name| cursor.field(LINE).is_ok_and(|field| field.trimmed().is(name));
    if !(first.is("Time Stamp") && next_is("ID") && next_is("Extended")) {
        return None;
    }
    let before = cursor;
    let directed = cursor.field(LINE).is_ok_and(|field| field.trimmed().is("Dir"));
    if !directed {
        cursor = before;
    }
    let mut next_is = |name| cursor.field(LINE).is_ok_and(|field| field.trimmed().is(name));
    (next_is("Bus") && next_is("LEN")).then_some(directed)
}

impl Dialect for SavvyCan {
    const SHORTER: &'static str =
        "a line of at most 8192 bytes, such as 166064000,00000520,false,Rx,0,8,00,00,01,00,00,00,00,00,";

    fn read(&mut self, line: &[u8], frame: &mut Frame) -> Result<Meaning, Flaw> {
        let mut cursor = Cursor::new(line);
        let time = cursor.up_to(|byte| byte == b',').trimmed();
        let Some(time_ns) = nanoseconds(time.text) else {
            // A file may begin in the middle of another.
            self.directed = header(line).ok_or_else(|| time.flaw(TIME))?;
            return Ok(Meaning::Other);
        };
        let id = cursor.field(LINE)?.trimmed();
        let extended = cursor.field(LINE)?.trimmed();
        let number = hex(id.text).ok_or_else(|| id.flaw(ID))?;
        let is_extended = extended.is("true");
        if !is_extended && !extended.is("false") {
            return Err(extended.flaw(EXTENDED));
        }
        let kind = standard_or_extended(is_extended, number).ok_or_else(|| id.flaw(ID))?;
        let direction = if self.directed { Some(direction(&mut cursor)?) } else { None };
        let bus = cursor.field(LINE)?.trimmed();
        decimal(bus.text).ok_or_else(|| bus.flaw(BUS))?;
        frame.set_interface(bus, BUS)?;
        let len = cursor.field(LINE)?.trimmed();
        let count = decimal(len.text).and_then(|count| usize::try_from(count).ok());
        let count = count.filter(|count| *count <= MAX_FD).ok_or_else(|| len.flaw(LEN))?;
        take_data(&mut cursor, frame.room(count))?;
        pass_filling(cursor, count)?;
        (frame.time_ns, frame.id, frame.direction) = (time_ns, number, direction);
        let fd = FrameKind::Fd { extended: is_extended, flags: 0 };
        frame.kind = if count > MAX_CLASSIC { fd } else { kind };
        Ok(Meaning::Frame)
    }
}

#[inline]
fn nanoseconds(text: &[u8]) -> Option<i64> {
    i64::try_from(decimal(text)?).ok()?.checked_mul(NS_PER_MICROSECOND)
}

#[inline]
fn direction(cursor: &mut Cursor<'_>) -> Result<Direction, Flaw> {
    let field = cursor.field(LINE)?.trimmed();
    match (field.is("Rx"), field.is("Tx")) {
        (true, _) => Ok(Direction::Rx),
        (_, true) => Ok(Direction::Tx),
        _ => Err(field.flaw(DIRECTION)),
    }
}

#[inline]
fn take_data(cursor: &mut Cursor<'_>, place: &mut [u8]) -> Result<(), Flaw> {
    for byte in place {
        // As they are nearly always.
        if let [b',', high, low, b',', ..] = *cursor.rest()
            && let Some(value) = hex_byte(high, low)
        {
            *byte = value;
            cursor.skip(3);
            continue;
        }
        let field = cursor.field(DATA)?.trimmed();
        let value = hex(field.text).and_then(|value| u8::try_from(value).ok());
        *byte = value.ok_or_else(|| field.flaw(DATA))?;
    }
    Ok(())
}

/// Passes the columns behind the data, which say nothing.
#[inline]
fn pass_filling(mut cursor: Cursor<'_>, data: usize) -> Result<(), Flaw> {
    let mut columns = data;
    while !cursor.is_at_end() {
        let field = cursor.field(END)?.trimmed();
        columns += 1;
        let is_zero = columns <= MAX_CLASSIC && hex(field.text) == Some(0);
        if !field.text.is_empty() && !is_zero {
            return Err(field.flaw(END));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests;
