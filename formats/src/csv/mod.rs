//! The CSV of python-can: one frame on each line, its data in base64.
//!
//! ```text
//! timestamp,arbitration_id,extended,remote,error,dlc,data
//! 1795209995.234358,0x520,0,0,0,8,AAABAAAAAAA=
//! ```
//!
//! It is described at `CSVWriter` in the documentation of python-can (`can/io/csv.py`). The time is in seconds since 1970, or wherever the
//! program that recorded counts from.
//!
//! There is no bus in it, so its interface is called `can`, and no direction. A frame of CAN FD is not marked: one of more than 8 bytes
//! can be nothing else and is handed out as that, without flags, and a shorter one as a classic frame.
//!
//! Not read: other columns, other separators and quotes, which python-can writes none of.

use adsdv_oracle::candump::FrameKind;

use crate::text::{
    Cursor, Dialect, Flaw, Frame, MAX_CLASSIC, MAX_FD, Meaning, decimal, decode_base64, hex,
    standard_or_extended, time_ns,
};

/// What such a file begins with.
const HEADER: &[u8] = b"timestamp,arbitration_id,extended,remote,error,dlc,data";

const LINE: &str = "a line such as 1795209995.234358,0x520,0,0,0,8,AAABAAAAAAA=";
const TIME: &str = "a time in seconds, such as 1795209995.234358, before the year 2262";
const ID: &str = "an identifier in hexadecimal, such as 0x520: up to 0x7FF, or 0x1FFFFFFF if it is extended";
const FLAG: &str = "0 or 1, for no or yes";
const REMOTE_OR_ERROR: &str = "0: a frame is not both a remote and an error frame";
const LEN: &str = "how many bytes of data the frame has, up to 8, or 64 for CAN FD";
const REMOTE_LEN: &str = "how many bytes of data the remote frame asks for, up to 8";
const ERROR_LEN: &str = "at most 8 bytes, which is what an error frame has";
const DATA: &str = "data in base64, of as many bytes as the length before it says";
const NO_DATA: &str = "the end of the line: a remote frame has no data";

/// Whether a recording that begins so is one.
pub(crate) fn is(head: &[u8]) -> bool {
    head.starts_with(HEADER)
}

/// Reads its lines.
pub(crate) struct Csv;

impl Dialect for Csv {
    const SHORTER: &'static str =
        "a line of at most 8192 bytes, such as 1795209995.234358,0x520,0,0,0,8,AAABAAAAAAA=";

    fn read(&mut self, line: &[u8], frame: &mut Frame) -> Result<Meaning, Flaw> {
        if line.trim_ascii() == HEADER {
            return Ok(Meaning::Other);
        }
        let mut cursor = Cursor::new(line);
        cursor.skip_blanks();
        let time = cursor.up_to(|byte| byte == b',');
        frame.time_ns = seconds(time.text).ok_or_else(|| time.flaw(TIME))?;
        let id = cursor.field(LINE)?;
        let extended = flag(&mut cursor)?;
        let number = hex(id.text.strip_prefix(b"0x").unwrap_or(id.text)).ok_or_else(|| id.flaw(ID))?;
        let data_kind = standard_or_extended(extended, number);
        let remote = flag(&mut cursor)?;
        let before_error = cursor;
        let error = flag(&mut cursor)?;
        let len = cursor.field(LINE)?;
        let count = decimal(len.text).and_then(|count| usize::try_from(count).ok());
        let (kind, most, expected) = match (remote, error) {
            (true, true) => return Err(Flaw { at: before_error.at() + 1, expected: REMOTE_OR_ERROR }),
            (true, false) => (FrameKind::Remote { extended, len: 0 }, MAX_CLASSIC, REMOTE_LEN),
            (false, true) => (FrameKind::Error, MAX_CLASSIC, ERROR_LEN),
            (false, false) => (data_kind.ok_or_else(|| id.flaw(ID))?, MAX_FD, LEN),
        };
        if number > kind.max_id() {
            return Err(id.flaw(ID));
        }
        let count = count.filter(|count| *count <= most).ok_or_else(|| len.flaw(expected))?;
        cursor.comma(LINE)?;
        let data = cursor.up_to(|_| false);
        let text = data.text.trim_ascii_end();
        (frame.kind, frame.id, frame.direction) = (kind, number, None);
        if let FrameKind::Remote { .. } = kind {
            let len = u8::try_from(count).map_err(|_| len.flaw(expected))?;
            frame.kind = FrameKind::Remote { extended, len };
            frame.set_len(0);
            return if text.is_empty() { Ok(Meaning::Frame) } else { Err(data.flaw(NO_DATA)) };
        }
        if decode_base64(text, frame.whole_room()) != Some(count) {
            return Err(data.flaw(DATA));
        }
        frame.set_len(count);
        if kind != FrameKind::Error && count > MAX_CLASSIC {
            frame.kind = FrameKind::Fd { extended, flags: 0 };
        }
        Ok(Meaning::Frame)
    }
}

#[inline]
fn flag(cursor: &mut Cursor<'_>) -> Result<bool, Flaw> {
    let field = cursor.field(LINE)?;
    match field.text {
        b"0" => Ok(false),
        b"1" => Ok(true),
        _ => Err(field.flaw(FLAG)),
    }
}

#[inline]
fn seconds(text: &[u8]) -> Option<i64> {
    time_ns(text, 1_000_000_000).or_else(|| with_exponent(text))
}

/// Python writes a time close to zero with an exponent: 5e-05.
#[cold]
fn with_exponent(text: &[u8]) -> Option<i64> {
    if !text.iter().all(|byte| byte.is_ascii_digit() || matches!(byte, b'.' | b'e' | b'+' | b'-')) {
        return None;
    }
    let seconds: f64 = str::from_utf8(text).ok()?.parse().ok()?;
    // Only these have an exponent that is not one of the year 2262 and later.
    #[allow(clippy::cast_possible_truncation)]
    (0.0..1e9).contains(&seconds).then(|| (seconds * 1e9).round() as i64)
}

#[cfg(test)]
mod tests;
