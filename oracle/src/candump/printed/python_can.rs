//! A frame as python-can prints it: `print(message)`, `can.Printer`, and `can_logger` without a file.
//!
//! ```text
//! Timestamp: 1795209995.234358    ID:      520    S Rx                DL:  8    00 00 01 00 00 00 00 00     Channel: vcan0
//! ```
//!
//! Between `ID:` and `DL:` stand S or X (an identifier of 11 or 29 bits), Rx or Tx, E (error frame), R (remote frame), F (CAN FD), BS and EI.

use super::super::cursor::Cursor;
use super::super::error::Flaw;
use super::super::line;
use super::super::record::{Direction, FrameKind, MAX_DATA};
use super::super::record::{EXTENDED_MASK, MAX_CLASSIC, MAX_FD, STANDARD_MASK};
use super::super::time::NS_PER_SECOND;
use super::{Printed, Stamp};
use crate::text;

/// What such a line begins with.
pub(super) const MARK: &[u8] = b"Timestamp:";

const TIME: &str = "a time in seconds, such as 1795209995.234358";
const ID: &str = "ID: and a hexadecimal identifier";
const FLAGS: &str = "S or X, Rx or Tx, and flags such as E, R, F, BS, EI before DL:";
const LENGTH: &str = "DL: and the number of data bytes";
const BYTE: &str = "as many data bytes as DL: says, such as 00 1a";
/// The interface of a frame that names none.
const NO_CHANNEL: &str = "can";
const CHANNEL: &[u8] = b"Channel:";

/// Reads a line that begins with [`MARK`].
pub(super) fn read<'a>(mut cursor: Cursor<'a>, data: &mut [u8; MAX_DATA]) -> Result<Printed<'a>, Flaw> {
    cursor.skip(MARK.len());
    cursor.skip_blanks();
    let time_ns = take_time(&mut cursor)?;
    cursor.skip_blanks();
    let id = take_id(&mut cursor)?;
    let flags = take_flags(&mut cursor)?;
    let len = take_length(&mut cursor)?;
    let most = if flags.extended { EXTENDED_MASK } else { STANDARD_MASK };
    if id > most || len > if flags.fd { MAX_FD } else { MAX_CLASSIC } {
        return Err(cursor.flaw(if id > most { ID } else { LENGTH }));
    }
    let extended = flags.extended;
    let kind = match flags {
        PythonFlags { error: true, .. } => FrameKind::Error,
        PythonFlags { remote: true, .. } => {
            FrameKind::Remote { extended, len: u8::try_from(len).unwrap_or_default() }
        }
        PythonFlags { fd: true, bits, .. } => FrameKind::Fd { extended, flags: bits },
        PythonFlags { extended: true, .. } => FrameKind::Extended,
        _ => FrameKind::Standard,
    };
    let len = if flags.remote { 0 } else { len };
    take_bytes(&mut cursor, len, data)?;
    let interface = channel(cursor.rest()).unwrap_or(NO_CHANNEL);
    Ok(Printed {
        stamp: Stamp::Absolute(time_ns),
        interface,
        kind,
        id,
        len,
        direction: Some(flags.direction),
    })
}

#[derive(Clone, Copy)]
struct PythonFlags {
    extended: bool,
    direction: Direction,
    error: bool,
    remote: bool,
    fd: bool,
    /// Those of CAN FD, as candump writes them.
    bits: u8,
}

fn take_time(cursor: &mut Cursor<'_>) -> Result<i64, Flaw> {
    let rest = cursor.rest();
    let len = rest.iter().take_while(|byte| byte.is_ascii_digit() || **byte == b'.').count();
    let time_ns = text::time_ns(rest.get(..len).unwrap_or_default(), NS_PER_SECOND);
    let time_ns = time_ns.ok_or_else(|| cursor.flaw(TIME))?;
    cursor.skip(len);
    Ok(time_ns)
}

fn take_id(cursor: &mut Cursor<'_>) -> Result<u32, Flaw> {
    if !cursor.rest().starts_with(b"ID:") {
        return Err(cursor.flaw(ID));
    }
    cursor.skip(3);
    cursor.skip_blanks();
    let digits = cursor.rest().iter().take_while(|byte| text::hex_digit(**byte).is_some()).count();
    if !(1..=8).contains(&digits) {
        return Err(cursor.flaw(ID));
    }
    let bytes = cursor.rest().iter().take(digits).filter_map(|byte| text::hex_digit(*byte));
    let id = bytes.fold(0, |number, digit| number << 4 | u32::from(digit));
    cursor.skip(digits);
    cursor.skip_blanks();
    Ok(id)
}

fn take_flags(cursor: &mut Cursor<'_>) -> Result<PythonFlags, Flaw> {
    let extended = match cursor.peek() {
        Some(b'S') => false,
        Some(b'X') => true,
        _ => return Err(cursor.flaw(FLAGS)),
    };
    cursor.skip(1);
    cursor.skip_blanks();
    let direction = match cursor.rest() {
        [b'R', b'x', ..] => Direction::Rx,
        [b'T', b'x', ..] => Direction::Tx,
        _ => return Err(cursor.flaw(FLAGS)),
    };
    cursor.skip(2);
    let mut flags = PythonFlags { extended, direction, error: false, remote: false, fd: false, bits: 0 };
    loop {
        cursor.skip_blanks();
        match cursor.rest() {
            [b'D', b'L', b':', ..] => return Ok(flags),
            [b'E', b'I', ..] => flags.bits |= 2,
            [b'B', b'S', ..] => flags.bits |= 1,
            [b'E', ..] => flags.error = true,
            [b'R', ..] => flags.remote = true,
            [b'F', ..] => flags.fd = true,
            _ => return Err(cursor.flaw(FLAGS)),
        }
        let len = cursor.rest().iter().take_while(|byte| byte.is_ascii_uppercase()).count();
        cursor.skip(len);
    }
}

fn take_length(cursor: &mut Cursor<'_>) -> Result<usize, Flaw> {
    cursor.skip(3);
    cursor.skip_blanks();
    let digits = cursor.rest().iter().take_while(|byte| byte.is_ascii_digit()).count();
    let text = cursor.rest().get(..digits).and_then(|digits| str::from_utf8(digits).ok());
    let len = text.and_then(|digits| digits.parse().ok()).filter(|_| digits <= 2);
    let len = len.ok_or_else(|| cursor.flaw(LENGTH))?;
    cursor.skip(digits);
    Ok(len)
}

fn take_bytes(cursor: &mut Cursor<'_>, len: usize, data: &mut [u8; MAX_DATA]) -> Result<(), Flaw> {
    for byte in data.iter_mut().take(len) {
        let gap = cursor.skip_blanks();
        let [high, low, ..] = *cursor.rest() else { return Err(cursor.flaw(BYTE)) };
        match (text::hex_digit(high), text::hex_digit(low)) {
            (Some(high), Some(low)) if gap => *byte = high << 4 | low,
            _ => return Err(cursor.flaw(BYTE)),
        }
        cursor.skip(2);
    }
    Ok(())
}

/// The channel at the end of a line, if it can name an interface.
fn channel(rest: &[u8]) -> Option<&str> {
    // The data may hold any characters; the channel is last.
    let at = rest.windows(CHANNEL.len()).rposition(|text| text == CHANNEL)?;
    let name = str::from_utf8(rest.get(at + CHANNEL.len()..)?).ok()?.trim();
    let name = name.split_ascii_whitespace().next()?;
    line::is_interface(name).then_some(name)
}

#[cfg(test)]
mod tests {
    use super::super::parse;
    use super::*;

    type PythonRead = (i64, String, FrameKind, u32, Vec<u8>, Option<Direction>);
    type PythonCase = (&'static str, &'static str, FrameKind, u32, &'static [u8], Option<Direction>);

    fn read(line: &str) -> Result<PythonRead, Flaw> {
        let mut data = [0; MAX_DATA];
        let Printed { stamp, interface, kind, id, len, direction } =
            parse(line.as_bytes(), &mut data).expect("it is python-can's")?;
        let Stamp::Absolute(time_ns) = stamp else { panic!("{stamp:?}") };
        Ok((time_ns, interface.to_owned(), kind, id, data[..len].to_vec(), direction))
    }

    #[test]
    fn what_python_can_prints_is_read() {
        use FrameKind::{Error, Extended, Fd, Remote, Standard};
        let (rx, tx) = (Some(Direction::Rx), Some(Direction::Tx));
        let begin = "Timestamp:        1.500000    ID:";
        let cases: [PythonCase; 6] = [
            (
                "      520    S Rx                DL:  2    00 fF     Channel: vcan0",
                "vcan0",
                Standard,
                0x520,
                &[0, 0xFF],
                rx,
            ),
            (
                " 18ff50e5    X Tx                DL:  1    61                       'a'",
                "can",
                Extended,
                0x18FF_50E5,
                &[0x61],
                tx,
            ),
            (
                "      123    S Rx   R            DL:  3                                Channel: 0",
                "0",
                Remote { extended: false, len: 3 },
                0x123,
                &[],
                rx,
            ),
            (
                " 00000004    X Rx E              DL:  2    00 01                       Channel: can 0",
                "can",
                Error,
                4,
                &[0, 1],
                rx,
            ),
            (
                "      123    S Rx     F BS       DL:  1    07    Channel: x",
                "x",
                Fd { extended: false, flags: 1 },
                0x123,
                &[7],
                rx,
            ),
            (
                "      123    X Rx     F    EI    DL:  0",
                "can",
                Fd { extended: true, flags: 2 },
                0x123,
                &[],
                rx,
            ),
        ];
        for (line, interface, kind, id, data, direction) in cases {
            let expected = (1_500_000_000, interface.to_owned(), kind, id, data.to_vec(), direction);
            assert_eq!(read(&format!("{begin}{line}")), Ok(expected), "{line}");
        }
        let clock = read("Timestamp: 1795209995.234358    ID:      520    S Rx                DL:  0");
        assert_eq!(clock.map(|read| read.0), Ok(1_795_209_995_234_358_000));
    }

    #[test]
    fn other_lines_are_refused_where_they_go_wrong() {
        let cases = [
            ("Timestamp: x", 11, TIME),
            ("Timestamp: 99999999999999999999 ID: 1 S Rx DL: 0", 11, TIME),
            ("Timestamp: 1.5 D", 15, ID),
            ("Timestamp: 1.5 ID: x", 19, ID),
            ("Timestamp: 1.5 ID: 123456789 S Rx DL: 0", 19, ID),
            ("Timestamp: 1.5 ID: 800 S Rx DL: 0", 33, ID),
            ("Timestamp: 1.5 ID: 520 Y", 23, FLAGS),
            ("Timestamp: 1.5 ID: 520 S no", 25, FLAGS),
            ("Timestamp: 1.5 ID: 520 S Rx q", 28, FLAGS),
            ("Timestamp: 1.5 ID: 520 S Rx DL: x", 32, LENGTH),
            ("Timestamp: 1.5 ID: 520 S Rx DL: 9 00 00 00 00 00 00 00 00 00", 33, LENGTH),
            ("Timestamp: 1.5 ID: 520 S Rx DL: 2 00", 36, BYTE),
            ("Timestamp: 1.5 ID: 520 S Rx DL: 1 0x", 34, BYTE),
        ];
        for (line, at, expected) in cases {
            assert_eq!(read(line), Err(Flaw { at, expected }), "{line}");
        }
    }
}
