//! Vector ASC: the text that CANalyzer and CANoe log to, and that python-can, log2asc and many others write.
//!
//! ```text
//! date Wed Nov 25 01:14:22.123 pm 2026
//! base hex  timestamps absolute
//! internal events logged
//! // version 9.0.0
//! Begin Triggerblock Wed Nov 25 01:14:22.123 pm 2026
//!    0.000000 Start of measurement
//!    0.012345 1  520             Rx   d 8 00 00 01 00 00 00 00 00  Length = 230000 BitCount = 120 ID = 1312
//!    0.013000 1  18FF50E5x       Tx   r 8
//!    0.014000 2  ErrorFrame
//!    0.015000 CANFD   1 Rx  520  Name  1 0 8  8 00 00 01 00 00 00 00 00  102000  130  303000 0 0 0 0 0
//!    0.016000 1  Statistic: D 1 R 1 XD 0 XR 0 E 0 O 0 B 0.5%
//! End TriggerBlock
//! ```
//!
//! Vector describes it in "CAN log and trigger: ASCII log files", which comes with its programs; `can/io/asc.py` of python-can and the
//! [vector_asc](https://bitbucket.org/tobylorenz/vector_asc) library of Tobias Lorenz are in the open.
//!
//! - The time counts from the start of the measurement. That is the date of the first `Begin Triggerblock`, or of `date` where that is
//!   missing; without either, it is zero. `timestamps relative` are differences from the line before, whatever that is.
//! - The interface is the channel: `1`.
//! - A frame has an identifier as a number, or a symbolic name and the number behind the data: `ID = 1312`.
//! - A `CANFD` line is a classic frame where its flags say so: Vector's programs write all frames of a CAN FD channel like that.
//! - An error frame has the identifier 0 and no data: what stands behind it is about the controller that saw it.
//!
//! Not read: requests to send (`TxRq`; the frame that was sent has its own line), the values in statistics, chip states, triggers and
//! environment variables, J1939 and other protocols above CAN, other buses (LIN, FlexRay, Ethernet, CAN XL), and dates in languages other
//! than English and German.

use adsdv_oracle::candump::Direction;

use crate::text::{Cursor, Dialect, Flaw, Frame, Meaning, Word, date_ns, decimal, hex, time_ns};

mod classic;
mod fd;

const LINE: &str =
    "a line such as 0.012345 1 520 Rx d 8 00 00 01 00 00 00 00 00, a header, or a comment behind //";
const TIME: &str = "a time in seconds, such as 0.012345, before the year 2262";
const CHANNEL: &str = "the number of a channel, such as 1, and a frame, such as 520 Rx d 1 00";
const BASE: &str = "base hex or base dec";
const ID: &str = "an identifier, such as 520: up to 7FF, or up to 1FFFFFFF with an x behind it; or a name, and its number behind the data, such as ID = 1312";
const DIRECTION: &str = "Rx (received) or Tx (sent)";

const NS_PER_SECOND: i64 = 1_000_000_000;

/// Whether a recording that begins so is one.
pub(crate) fn is(head: &[u8]) -> bool {
    let mut cursor = Cursor::new(head.trim_ascii_start());
    let (first, second) = (cursor.word(), cursor.up_to(|byte| byte == b'\n'));
    let second = second.text.trim_ascii();
    let begins = |text: &str| {
        second.get(..text.len()).is_some_and(|begin| begin.eq_ignore_ascii_case(text.as_bytes()))
    };
    match first.text {
        b"//" => begins("version"),
        [b'0'..=b'9', ..] => {
            first.text.contains(&b'.') && time_ns(first.text, NS_PER_SECOND).is_some() && !second.is_empty()
        }
        _ if first.is("date") => {
            date_ns(second).is_some() || second.split(u8::is_ascii_whitespace).count() >= 5
        }
        _ if first.is("base") => begins("hex") || begins("dec"),
        _ if first.is("begin") => begins("triggerblock"),
        _ if first.is("no") => begins("internal events"),
        _ if first.is("internal") => begins("events"),
        _ => false,
    }
}

/// Reads its lines.
pub(crate) struct Asc {
    /// Numbers are decimal.
    decimal: bool,
    /// Times are differences.
    relative: bool,
    /// When the measurement started.
    start_ns: i64,
    /// It is known, or has been used.
    started: bool,
    /// The time of the line before, from the start.
    elapsed_ns: i64,
}

impl Asc {
    pub(crate) const fn new() -> Self {
        Self { decimal: false, relative: false, start_ns: 0, started: false, elapsed_ns: 0 }
    }
}

impl Dialect for Asc {
    const SHORTER: &'static str =
        "a line of at most 8192 bytes, such as 0.012345 1 520 Rx d 8 00 00 01 00 00 00 00 00";

    fn read(&mut self, line: &[u8], frame: &mut Frame) -> Result<Meaning, Flaw> {
        let mut cursor = Cursor::new(line);
        let first = cursor.word();
        match first.text {
            [b'0'..=b'9', ..] => self.timed(first, cursor, frame),
            [b'/', b'/', ..] => Ok(Meaning::Other),
            _ => self.header(first, cursor),
        }
    }
}

impl Asc {
    /// Reads a line that begins with a time.
    fn timed(&mut self, time: Word<'_>, mut cursor: Cursor<'_>, frame: &mut Frame) -> Result<Meaning, Flaw> {
        let elapsed = time_ns(time.text, NS_PER_SECOND).ok_or_else(|| time.flaw(TIME))?;
        let elapsed = if self.relative { self.elapsed_ns.checked_add(elapsed) } else { Some(elapsed) };
        let at = elapsed.and_then(|elapsed| Some((elapsed, self.start_ns.checked_add(elapsed)?)));
        (self.elapsed_ns, frame.time_ns) = at.ok_or_else(|| time.flaw(TIME))?;
        self.started = true;
        let second = cursor.word();
        match second.text {
            [b'0'..=b'9', ..] => {
                decimal(second.text).ok_or_else(|| second.flaw(CHANNEL))?;
                self.classic(second, cursor, frame)
            }
            b"CANFD" => self.fd(cursor, frame),
            // What is written there is an open list: everything that a measurement can be told of. Some name their channels.
            [byte, ..] if byte.is_ascii_alphabetic() || *byte == b'_' => {
                if classic::is_frame(cursor) {
                    self.classic(second, cursor, frame)
                } else {
                    Ok(Meaning::Other)
                }
            }
            _ => Err(second.flaw(CHANNEL)),
        }
    }

    /// Reads a line that begins with anything else.
    fn header(&mut self, first: Word<'_>, mut cursor: Cursor<'_>) -> Result<Meaning, Flaw> {
        if first.is("date") {
            // A measurement begins, the first of the file or one behind another.
            *self = Self { start_ns: date_ns(cursor.rest()).unwrap_or(0), ..Self::new() };
            return Ok(Meaning::Other);
        }
        let second = cursor.word();
        if first.is("base") {
            self.decimal = match (second.is("hex"), second.is("dec")) {
                (true, _) => false,
                (_, true) => true,
                _ => return Err(second.flaw(BASE)),
            };
            self.relative = cursor.word().is("timestamps") && cursor.word().is("relative");
            return Ok(Meaning::Other);
        }
        if first.is("begin") && second.is("triggerblock") {
            // The header of python-can has the time at which it converted a log, and this line that of the first frame. Further blocks
            // of a measurement count on from its start.
            if !self.started
                && let Some(start_ns) = date_ns(cursor.rest())
            {
                (self.start_ns, self.started) = (start_ns, true);
            }
            return Ok(Meaning::Other);
        }
        let known = first.is("no") && second.is("internal")
            || first.is("internal") && second.is("events")
            || first.is("end") && second.is("triggerblock")
            || first.is("previous") && second.is("log");
        if known { Ok(Meaning::Other) } else { Err(first.flaw(LINE)) }
    }

    /// An identifier of one of its kinds: extended or not, and its number.
    #[inline]
    fn identifier(&self, word: Word<'_>) -> Option<(bool, u32)> {
        let (extended, digits) = match word.text {
            [digits @ .., b'x' | b'X'] => (true, digits),
            digits => (false, digits),
        };
        let id = if self.decimal { decimal(digits)?.try_into().ok()? } else { hex(digits)? };
        crate::text::standard_or_extended(extended, id).map(|_| (extended, id))
    }

    /// A number in the base of the file.
    #[inline]
    fn number(&self, text: &[u8]) -> Option<u64> {
        if self.decimal { decimal(text) } else { hex(text).map(u64::from) }
    }

    /// Takes that many bytes of data.
    #[inline]
    fn data(&self, cursor: &mut Cursor<'_>, len: usize, frame: &mut Frame) -> Result<(), Flaw> {
        const HEX: &str = "a byte of data, such as 0A, as many as the length before them says";
        const DECIMAL: &str = "a byte of data in decimal, up to 255, as many as the length before them says";
        let room = frame.room(len);
        if self.decimal { cursor.take_decimal(room, DECIMAL) } else { cursor.take_hex(room, HEX) }
    }
}

/// The direction of a frame; `None` for a request to send one.
#[inline]
fn direction(word: Word<'_>) -> Result<Option<Direction>, Flaw> {
    match word.text {
        b"Rx" => Ok(Some(Direction::Rx)),
        b"Tx" => Ok(Some(Direction::Tx)),
        _ if word.is("rx") => Ok(Some(Direction::Rx)),
        _ if word.is("tx") => Ok(Some(Direction::Tx)),
        _ if word.is("txrq") => Ok(None),
        _ => Err(word.flaw(DIRECTION)),
    }
}

#[cfg(test)]
mod tests;
