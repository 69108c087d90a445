//! The line that is no frame, but tells of frames that are missing: `candump -d` writes it before the next one.

use super::cursor::{self, Cursor};
use super::error::Flaw;
use super::line;

const EXPECTED: &str = "a line such as DROPCOUNT: dropped 3 CAN frames on 'vcan0' socket (total drops 7)";
const INTERFACE: &str = "the name of an interface, such as vcan0, and ' behind it";
const COUNT: &str = "how many frames";
const END: &str = "the end of the line";

/// What such a line begins with.
const MARK: &[u8] = b"DROPCOUNT:";

/// The counter of the kernel has 32 bits; candump prints the upper half of them as negative numbers.
const WRAP: u64 = 1 << 32;

/// Frames that the kernel dropped before the next one in the log, because the recorder did not take them in time.
///
/// ```text
/// DROPCOUNT: dropped 3 CAN frames on 'vcan0' socket (total drops 7)
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Dropped<'a> {
    /// Number of the line in the log; the first is 1.
    pub line: u64,
    /// Name of the network interface that they came from. Never empty; no white space or control characters.
    pub interface: &'a str,
    /// How many were dropped since the last such line.
    pub count: u64,
    /// How many were dropped since the recording began.
    pub total: u64,
}

/// Reads `line`, the text of line `number` without its line feed; `None` if it is of another sort.
pub(super) fn parse(number: u64, line: &[u8]) -> Option<Result<Dropped<'_>, Flaw>> {
    line.starts_with(MARK).then(|| read(number, line))
}

fn read(line: u64, text: &[u8]) -> Result<Dropped<'_>, Flaw> {
    let mut cursor = Cursor::new(text);
    cursor.skip(MARK.len());
    pass(&mut cursor, b" dropped ", EXPECTED)?;
    let count = take_count(&mut cursor)?;
    pass(&mut cursor, b" CAN frame", EXPECTED)?;
    cursor.skip_if(b's');
    pass(&mut cursor, b" on '", EXPECTED)?;
    let interface = take_interface(&mut cursor)?;
    pass(&mut cursor, b"' socket (total drops ", EXPECTED)?;
    let total = take_count(&mut cursor)?;
    pass(&mut cursor, b")", EXPECTED)?;
    if !cursor::is_blank(cursor.rest()) {
        return Err(cursor.flaw(END));
    }
    Ok(Dropped { line, interface, count, total })
}

fn pass(cursor: &mut Cursor<'_>, text: &[u8], expected: &'static str) -> Result<(), Flaw> {
    if !cursor.rest().starts_with(text) {
        return Err(cursor.flaw(expected));
    }
    cursor.skip(text.len());
    Ok(())
}

fn take_count(cursor: &mut Cursor<'_>) -> Result<u64, Flaw> {
    let start = *cursor;
    let negative = cursor.skip_if(b'-');
    let len = cursor.rest().iter().take_while(|byte| byte.is_ascii_digit()).count();
    let digits = cursor.rest().get(..len).unwrap_or_default();
    let number: Option<u64> = str::from_utf8(digits).ok().and_then(|digits| digits.parse().ok());
    let number = number.and_then(|number| if negative { WRAP.checked_sub(number) } else { Some(number) });
    cursor.skip(len);
    number.ok_or_else(|| start.flaw(COUNT))
}

fn take_interface<'a>(cursor: &mut Cursor<'a>) -> Result<&'a str, Flaw> {
    let text = cursor.rest();
    // An interface may have such a mark in its name; the last one ends it.
    let len = text.iter().rposition(|&byte| byte == b'\'').ok_or_else(|| cursor.flaw(INTERFACE))?;
    let name = text.get(..len).and_then(|name| str::from_utf8(name).ok());
    let name = name.filter(|name| line::is_interface(name)).ok_or_else(|| cursor.flaw(INTERFACE))?;
    cursor.skip(len);
    Ok(name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_candump_prints_is_read() {
        let cases = [
            ("DROPCOUNT: dropped 1 CAN frame on 'vcan0' socket (total drops 1)", "vcan0", 1, 1),
            (
                "DROPCOUNT: dropped 23 CAN frames on 'can0' socket (total drops 4000000000)\r",
                "can0",
                23,
                4_000_000_000,
            ),
            (
                "DROPCOUNT: dropped 2 CAN frames on 'can'0' socket (total drops -2147483647) ",
                "can'0",
                2,
                0x8000_0001,
            ),
            ("DROPCOUNT: dropped 0 CAN frame on 'any' socket (total drops -1)", "any", 0, 0xFFFF_FFFF),
            // As it is written, though no kernel counts so far.
            (
                "DROPCOUNT: dropped 18446744073709551615 CAN frames on 'any' socket (total drops 0)",
                "any",
                u64::MAX,
                0,
            ),
        ];
        for (text, interface, count, total) in cases {
            let expected = Dropped { line: 9, interface, count, total };
            assert_eq!(parse(9, text.as_bytes()), Some(Ok(expected)), "{text}");
        }
    }

    #[test]
    fn other_lines_are_refused_where_they_go_wrong() {
        let cases = [
            ("DROPCOUNT:", 10, EXPECTED),
            ("DROPCOUNT: dropped CAN frames", 19, COUNT),
            ("DROPCOUNT: dropped 99999999999999999999 CAN frames on", 19, COUNT),
            ("DROPCOUNT: dropped -9999999999 CAN frames on", 19, COUNT),
            ("DROPCOUNT: dropped 3 frames", 20, EXPECTED),
            ("DROPCOUNT: dropped 3 CAN frames on can0", 31, EXPECTED),
            ("DROPCOUNT: dropped 3 CAN frames on 'can0", 36, INTERFACE),
            ("DROPCOUNT: dropped 3 CAN frames on '' socket (total drops 3)", 36, INTERFACE),
            ("DROPCOUNT: dropped 3 CAN frames on 'a b' socket (total drops 3)", 36, INTERFACE),
            ("DROPCOUNT: dropped 3 CAN frames on 'can0' socket (total", 40, EXPECTED),
            ("DROPCOUNT: dropped 3 CAN frames on 'can0' socket (total drops x)", 62, COUNT),
            ("DROPCOUNT: dropped 3 CAN frames on 'can0' socket (total drops 3", 63, EXPECTED),
            ("DROPCOUNT: dropped 3 CAN frames on 'can0' socket (total drops 3) R", 64, END),
        ];
        for (text, at, expected) in cases {
            assert_eq!(parse(1, text.as_bytes()), Some(Err(Flaw { at, expected })), "{text}");
        }
        assert_eq!(parse(1, b"(1.000000) can0 123#"), None);
        assert_eq!(parse(1, b"DROPCOUNT"), None);
    }
}
