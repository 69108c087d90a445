//! A frame as candump prints it on a screen: columns with blanks between them, and the bytes apart.

use super::super::cursor::Cursor;
use super::super::error::Flaw;
use super::super::line;
use super::super::record::{Direction, FrameKind, MAX_DATA};
use super::super::record::{ERROR_FLAG, EXTENDED_MASK, MAX_CLASSIC, MAX_FD, STANDARD_MASK};
use super::super::time;
use super::{Printed, Stamp, date};
use crate::text::hex_digit;

const EXAMPLE: &str = "a line such as vcan0  520   [8]  00 00 01 00 00 00 00 00";
const IDENTIFIER: &str = "an identifier of 3 or 8 hexadecimal digits";
const LENGTH: &str = "the number of data bytes, such as [8]";
const BYTE: &str = "as many data bytes as the length says, such as 00 1A";
const DIRECTION: &str = "the flags behind RX or TX, such as - -";

/// Times with so many digits of seconds are those of a clock; others are of the recording.
const CLOCK_DIGITS: usize = 9;

/// Reads a line from its first column on.
pub(super) fn read<'a>(mut cursor: Cursor<'a>, data: &mut [u8; MAX_DATA]) -> Result<Printed<'a>, Flaw> {
    let stamp = take_stamp(&mut cursor)?;
    cursor.skip_blanks();
    let interface = line::take_interface(&mut cursor)?;
    gap(&mut cursor, EXAMPLE)?;
    let direction = take_direction(&mut cursor)?;
    let (id, extended) = take_identifier(&mut cursor)?;
    let (len, digits) = take_length(&mut cursor)?;
    let (kind, id) = match id & !EXTENDED_MASK {
        0 if cursor.rest().starts_with(b"remote request") => {
            let len = u8::try_from(len.min(MAX_CLASSIC)).unwrap_or_default();
            return Ok(Printed {
                stamp,
                interface,
                kind: FrameKind::Remote { extended, len },
                id,
                len: 0,
                direction,
            });
        }
        // candump writes one digit for CAN, and two for CAN FD.
        0 if digits > 1 || len > MAX_CLASSIC => (FrameKind::Fd { extended, flags: 0 }, id),
        0 if extended => (FrameKind::Extended, id),
        0 => (FrameKind::Standard, id),
        _ => (FrameKind::Error, id & EXTENDED_MASK),
    };
    take_bytes(&mut cursor, len, data)?;
    Ok(Printed { stamp, interface, kind, id, len, direction })
}

/// Takes the time, if there is one.
fn take_stamp(cursor: &mut Cursor<'_>) -> Result<Stamp, Flaw> {
    if cursor.peek() != Some(b'(') {
        return Ok(Stamp::None);
    }
    if let Some(time_ns) = date::take(cursor) {
        return Ok(Stamp::Absolute(time_ns));
    }
    let digits = cursor.rest().iter().skip(1).take_while(|byte| byte.is_ascii_digit()).count();
    let time_ns = time::take(cursor)?;
    Ok(if digits >= CLOCK_DIGITS { Stamp::Absolute(time_ns) } else { Stamp::Since(time_ns) })
}

fn gap(cursor: &mut Cursor<'_>, expected: &'static str) -> Result<(), Flaw> {
    if cursor.skip_blanks() { Ok(()) } else { Err(cursor.flaw(expected)) }
}

/// Takes `RX - -` or `TX B E`, as `candump -x` writes it, if it is there.
fn take_direction(cursor: &mut Cursor<'_>) -> Result<Option<Direction>, Flaw> {
    let direction = match cursor.rest() {
        [b'R', b'X', b' ', ..] => Direction::Rx,
        [b'T', b'X', b' ', ..] => Direction::Tx,
        _ => return Ok(None),
    };
    cursor.skip(2);
    for _ in 0..2 {
        gap(cursor, DIRECTION)?;
        if !matches!(cursor.peek(), Some(b'-' | b'B' | b'E')) {
            return Err(cursor.flaw(DIRECTION));
        }
        cursor.skip(1);
    }
    gap(cursor, IDENTIFIER)?;
    Ok(Some(direction))
}

/// Takes the identifier, and whether it has 29 bits.
fn take_identifier(cursor: &mut Cursor<'_>) -> Result<(u32, bool), Flaw> {
    let digits = cursor.rest().iter().take_while(|byte| hex_digit(**byte).is_some()).count();
    let number = |cursor: &Cursor<'_>| {
        let digits = cursor.rest().iter().take(digits).filter_map(|byte| hex_digit(*byte));
        digits.fold(0, |number, digit| number << 4 | u32::from(digit))
    };
    let (id, extended) = match digits {
        3 => (number(cursor), false),
        8 => (number(cursor), true),
        _ => return Err(cursor.flaw(IDENTIFIER)),
    };
    if !extended && id > STANDARD_MASK || id > EXTENDED_MASK | ERROR_FLAG {
        return Err(cursor.flaw(IDENTIFIER));
    }
    cursor.skip(digits);
    gap(cursor, LENGTH)?;
    Ok((id, extended))
}

/// Takes `[8]`, and what it says; how many digits it has as well.
fn take_length(cursor: &mut Cursor<'_>) -> Result<(usize, usize), Flaw> {
    let start = *cursor;
    if !cursor.skip_if(b'[') {
        return Err(cursor.flaw(LENGTH));
    }
    let digits = cursor.rest().iter().take_while(|byte| byte.is_ascii_digit()).count();
    let text = cursor.rest().get(..digits).and_then(|digits| str::from_utf8(digits).ok());
    let len = text.and_then(|digits| digits.parse().ok()).filter(|len| *len <= MAX_FD && digits <= 2);
    cursor.skip(digits);
    let len = len.filter(|_| cursor.skip_if(b']')).ok_or_else(|| start.flaw(LENGTH))?;
    cursor.skip_blanks();
    Ok((len, digits))
}

/// Takes so many bytes, with blanks between them. What follows is for the eye: characters, ERRORFRAME.
fn take_bytes(cursor: &mut Cursor<'_>, len: usize, data: &mut [u8; MAX_DATA]) -> Result<(), Flaw> {
    for (place, byte) in data.iter_mut().take(len).enumerate() {
        if place > 0 {
            gap(cursor, BYTE)?;
        }
        let [high, low, ..] = *cursor.rest() else { return Err(cursor.flaw(BYTE)) };
        match (hex_digit(high), hex_digit(low)) {
            (Some(high), Some(low)) => *byte = high << 4 | low,
            _ => return Err(cursor.flaw(BYTE)),
        }
        cursor.skip(2);
    }
    match cursor.peek() {
        None | Some(b' ' | b'\t' | b'\r') => Ok(()),
        Some(_) => Err(cursor.flaw(BYTE)),
    }
}

#[cfg(test)]
mod tests {
    use super::super::parse;
    use super::*;

    type Case = (&'static str, Stamp, FrameKind, u32, &'static [u8], Option<Direction>);
    type Read = (Stamp, String, FrameKind, u32, Vec<u8>, Option<Direction>);

    fn read(line: &str) -> Result<Read, Flaw> {
        let mut data = [0; MAX_DATA];
        let Printed { stamp, interface, kind, id, len, direction } =
            parse(line.as_bytes(), &mut data).expect("it is printed for a person")?;
        Ok((stamp, interface.to_owned(), kind, id, data[..len].to_vec(), direction))
    }

    #[test]
    fn what_candump_prints_on_a_screen_is_read() {
        use FrameKind::{Error, Extended, Fd, Remote, Standard};
        use Stamp::{Absolute, Since};
        let fd = |extended| Fd { extended, flags: 0 };
        let clock = Absolute(1_795_209_995_234_358_000);
        let (rx, tx) = (Some(Direction::Rx), Some(Direction::Tx));
        let cases: [Case; 13] = [
            (
                "  vcan0  520   [8]  00 00 01 00 00 00 00 FF",
                Stamp::None,
                Standard,
                0x520,
                &[0, 0, 1, 0, 0, 0, 0, 255],
                None,
            ),
            ("vcan0 520 [2] 1a 2B\r", Stamp::None, Standard, 0x520, &[0x1A, 0x2B], None),
            (" (1795209995.234358)  vcan0  520   [1]  00", clock, Standard, 0x520, &[0], None),
            (" (000.010123)  vcan0  520   [1]  00   '#'", Since(10_123_000), Standard, 0x520, &[0], None),
            (
                " (2026-11-20 20:46:35.234358)  vcan0  520   [0]",
                Absolute(1_795_207_595_234_358_000),
                Standard,
                0x520,
                &[],
                None,
            ),
            (
                " (1795209995.234358)  vcan0       520   [2]  00 00   '..'",
                clock,
                Standard,
                0x520,
                &[0, 0],
                None,
            ),
            (
                "  vcan0  18FF50E5   [2]  00 11                     '..'",
                Stamp::None,
                Extended,
                0x18FF_50E5,
                &[0, 0x11],
                None,
            ),
            ("  vcan0       123  [02]  AA BB", Stamp::None, fd(false), 0x123, &[0xAA, 0xBB], None),
            (
                "  vcan0  18FF50E5  [12]  00 01 02 03 04 05 06 07 08 09 0A 0B",
                Stamp::None,
                fd(true),
                0x18FF_50E5,
                &[0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11],
                None,
            ),
            (
                "  vcan0       123   [3]  remote request",
                Stamp::None,
                Remote { extended: false, len: 3 },
                0x123,
                &[],
                None,
            ),
            ("  vcan0  20000004   [2]  00 0C   ERRORFRAME", Stamp::None, Error, 4, &[0, 0xC], None),
            ("  vcan0  RX - -  520   [1]  07", Stamp::None, Standard, 0x520, &[7], rx),
            ("  vcan0  TX B E  520   [1]  07", Stamp::None, Standard, 0x520, &[7], tx),
        ];
        for (line, stamp, kind, id, data, direction) in cases {
            assert_eq!(
                read(line),
                Ok((stamp, "vcan0".to_owned(), kind, id, data.to_vec(), direction)),
                "{line}"
            );
        }
    }

    #[test]
    fn other_lines_are_refused_where_they_go_wrong() {
        let cases = [
            ("[8]", 3, EXAMPLE),
            ("vcan0 [8]", 6, IDENTIFIER),
            ("vcan0 52 [8]", 6, IDENTIFIER),
            ("vcan0 800 [8]", 6, IDENTIFIER),
            ("vcan0 FFFFFFFF [8]", 6, IDENTIFIER),
            ("vcan0 520[8]", 9, LENGTH),
            ("vcan0 520 8] [", 10, LENGTH),
            ("vcan0 520 [x]", 10, LENGTH),
            ("vcan0 520 [65]", 10, LENGTH),
            ("vcan0 520 [008]", 10, LENGTH),
            ("vcan0 520 [8", 10, LENGTH),
            ("vcan0 520 [2] 00", 16, BYTE),
            ("vcan0 520 [2] 00 0", 17, BYTE),
            ("vcan0 520 [2] 0000", 16, BYTE),
            ("vcan0 520 [1] 0g", 14, BYTE),
            ("vcan0 520 [1] 000", 16, BYTE),
            ("vcan0 RX x 520 [1] 00", 9, DIRECTION),
        ];
        for (line, at, expected) in cases {
            assert_eq!(read(line), Err(Flaw { at, expected }), "{line}");
        }
    }

    #[test]
    fn lines_of_other_sorts_are_left_to_others() {
        for line in
            ["", "rubbish", "(1.000000) can0 520#0011", "(1.000000) can0 520#0011 [", "can0 520#00 [8]"]
        {
            assert!(parse(line.as_bytes(), &mut [0; MAX_DATA]).is_none(), "{line}");
        }
    }
}
