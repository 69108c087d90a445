//! One line: time, interface, frame, and perhaps a direction.

use super::cursor::Cursor;
use super::error::Flaw;
use super::frame;
use super::record::{Direction, MAX_DATA, Record};
use super::time;

const GAP_BEFORE_INTERFACE: &str = "a space and the name of an interface, such as vcan0";
const GAP_BEFORE_FRAME: &str = "a space and a frame, such as 520#0000010000000000";
const INTERFACE: &str = "the name of an interface, such as vcan0";
const END: &str = "the end of the line, or R (received) or T (sent)";

/// Reads `line`, the text of line `number` without its line feed. The frame's data are put into `data`.
#[inline]
pub(super) fn parse<'a>(
    number: u64,
    line: &'a [u8],
    data: &'a mut [u8; MAX_DATA],
) -> Result<Record<'a>, Flaw> {
    let mut cursor = Cursor::new(line);
    cursor.skip_blanks();
    let time_ns = time::take(&mut cursor)?;
    take_gap(&mut cursor, GAP_BEFORE_INTERFACE)?;
    let interface = take_interface(&mut cursor)?;
    take_gap(&mut cursor, GAP_BEFORE_FRAME)?;
    let frame = frame::take(&mut cursor, data)?;
    let direction = take_direction(&mut cursor)?;
    let data = data.get(..frame.len).unwrap_or_default();
    Ok(Record {
        line: number,
        time_ns,
        interface,
        kind: frame.kind,
        id: frame.id,
        data,
        direction,
        terminated: true,
    })
}

#[inline]
fn take_gap(cursor: &mut Cursor<'_>, expected: &'static str) -> Result<(), Flaw> {
    // Several: candump aligns the names of interfaces to the right.
    if cursor.skip_blanks() && cursor.peek().is_some() { Ok(()) } else { Err(cursor.flaw(expected)) }
}

#[inline]
pub(super) fn take_interface<'a>(cursor: &mut Cursor<'a>) -> Result<&'a str, Flaw> {
    let text = cursor.rest();
    let len = text.iter().take_while(|byte| **byte > b' ' && **byte != 0x7F).count();
    let name = text.get(..len).unwrap_or_default();
    let name = str::from_utf8(name).map_err(|_| cursor.flaw(INTERFACE))?;
    if name.is_empty() || !name.is_ascii() && name.contains(char::is_control) {
        return Err(cursor.flaw(INTERFACE));
    }
    cursor.skip(len);
    Ok(name)
}

/// Whether a line can name its interface so.
pub(super) fn is_interface(name: &str) -> bool {
    take_interface(&mut Cursor::new(name.as_bytes())) == Ok(name)
}

#[inline]
fn take_direction(cursor: &mut Cursor<'_>) -> Result<Option<Direction>, Flaw> {
    let gap = cursor.skip_blanks();
    let direction = match cursor.peek() {
        None => return Ok(None),
        Some(b'R') if gap => Direction::Rx,
        Some(b'T') if gap => Direction::Tx,
        Some(_) => return Err(cursor.flaw(END)),
    };
    cursor.skip(1);
    cursor.skip_blanks();
    if cursor.peek().is_some() {
        return Err(cursor.flaw(END));
    }
    Ok(Some(direction))
}

#[cfg(test)]
mod tests {
    use super::super::record::FrameKind;
    use super::*;

    fn read(line: &[u8]) -> Result<(i64, String, Option<Direction>), Flaw> {
        let mut data = [0; MAX_DATA];
        let record = parse(3, line, &mut data)?;
        assert_eq!((record.line, record.kind, record.id), (3, FrameKind::Standard, 0x123));
        assert_eq!(record.data, [0x11, 0x22]);
        Ok((record.time_ns, record.interface.to_owned(), record.direction))
    }

    #[test]
    fn lines_are_read_with_any_spacing_interface_and_direction() {
        let cases: [(&str, &str, Option<Direction>); 9] = [
            ("(1.000000) vcan0 123#1122", "vcan0", None),
            ("(1.000000) vcan0 123#1122\r", "vcan0", None),
            ("(1.000000) vcan0 123#1122  \t\r", "vcan0", None),
            ("  (1.000000)   can0  123#1122", "can0", None),
            ("(1.000000)\tcan0\t123#1122", "can0", None),
            ("(1.000000) slcan0.1-ä 123#1122", "slcan0.1-ä", None),
            ("(1.000000) any 123#1122 R", "any", Some(Direction::Rx)),
            ("(1.000000) any 123#1122 T\r", "any", Some(Direction::Tx)),
            ("(1.000000) 123#1122 123#1122", "123#1122", None),
        ];
        for (line, interface, direction) in cases {
            assert_eq!(read(line.as_bytes()), Ok((1_000_000_000, interface.to_owned(), direction)), "{line}");
        }
    }

    #[test]
    fn other_lines_are_refused_where_they_go_wrong() {
        let cases: [(&[u8], usize, &str); 17] = [
            (b"(1.000000)", 10, GAP_BEFORE_INTERFACE),
            (b"(1.000000) ", 11, GAP_BEFORE_INTERFACE),
            (b"(1.000000)vcan0 123#1122", 10, GAP_BEFORE_INTERFACE),
            (b"(1.000000) vcan0", 16, GAP_BEFORE_FRAME),
            (b"(1.000000) vcan0\r", 17, GAP_BEFORE_FRAME),
            (b"(1.000000) 123#1122", 19, GAP_BEFORE_FRAME),
            (b"(1.000000) \x1b[2J 123#1122", 11, INTERFACE),
            (b"(1.000000) \xc2\x9b2J 123#1122", 11, INTERFACE),
            (b"(1.000000) \xff\xfe 123#1122", 11, INTERFACE),
            (b"(1.000000) vc\0n 123#1122", 13, GAP_BEFORE_FRAME),
            (b"(1.000000) vcan0 123#1122 X", 26, END),
            (b"(1.000000) vcan0 123#1122R", 25, END),
            (b"(1.000000) vcan0 123#1122T", 25, END),
            (b"(1.000000) vcan0 123#1122 R T", 28, END),
            // Error frames are neither CAN FD nor remote, and CAN XL has no extended identifiers.
            (b"(1.000000) vcan0 20000004##100", 26, END),
            (b"(1.000000) vcan0 20000004#R", 26, END),
            (b"(1.000000) vcan0 00000520#81:00:12345678#11", 28, END),
        ];
        for (line, at, expected) in cases {
            assert_eq!(read(line), Err(Flaw { at, expected }), "{}", line.escape_ascii());
        }
    }
}
