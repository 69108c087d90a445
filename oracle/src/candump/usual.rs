//! The usual line, which a log has millions of: read at one go, or left to the other files.
//!
//! ```text
//! (1795209995.234358) vcan0 520#0000010000000000
//! ```
//!
//! Ten digits of seconds and six of microseconds, one space, the interface of the line before, one space, an
//! identifier of 11 bits, up to eight bytes of data, and nothing else. [`line::parse`](super::line::parse) reads such
//! a line to the same record, but slower: it has to be ready for anything, and to say where it went wrong.

use super::frame::{MAX_CLASSIC, STANDARD_MASK};
use super::hex;
use super::line::Cursor;
use super::time;

/// What a usual line says, apart from its interface.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Usual {
    pub(super) time_ns: i64,
    pub(super) id: u32,
    pub(super) data: [u8; MAX_CLASSIC],
    /// Number of data bytes.
    pub(super) len: usize,
}

/// Reads the line at the beginning of a text if it is a usual one on this interface and there is room for the longest; tells how long
/// it is, with its line feed, which is found on the way. Before the first frame there is no interface, and its name is empty: a usual
/// line names one.
#[inline]
pub(super) fn read(text: &[u8], interface: &[u8]) -> Option<(Usual, usize)> {
    if interface.is_empty() {
        return None;
    }
    let mut cursor = Cursor::new(text);
    let time_ns = time::usual(&mut cursor)?;
    let (&[b' ', ref id @ .., b'#'], digits) =
        cursor.rest().strip_prefix(b" ")?.strip_prefix(interface)?.split_first_chunk::<5>()?
    else {
        return None;
    };
    let id = hex::number(*id).ok().filter(|id| *id <= STANDARD_MASK)?;
    let (data, len) = hex::up_to_line_feed(digits.first_chunk()?)?;
    Some((Usual { time_ns, id, data, len }, text.len() - digits.len() + 2 * len + 1))
}

#[cfg(test)]
mod tests {
    use super::super::line;
    use super::super::record::{self, FrameKind, Record};
    use super::*;

    /// Whether the line is usual. If it is, the long way must read it to the same record.
    fn is_usual(text: &str) -> bool {
        let with_more = format!("{text}\n(1795209995.234359) vcan0");
        let read = read(with_more.as_bytes(), b"vcan0");
        let Some((Usual { time_ns, id, data, len }, taken)) = read else { return false };
        assert_eq!(taken, text.len() + 1, "{text}");
        let same = Record {
            line: 1,
            time_ns,
            interface: "vcan0",
            kind: FrameKind::Standard,
            id,
            data: &data[..len],
            direction: None,
            terminated: true,
        };
        assert_eq!(line::parse(1, text.as_bytes(), &mut [0; record::MAX_DATA]), Ok(same), "{text}");
        true
    }

    #[test]
    fn what_candump_prints_for_this_interface_is_usual() {
        for data in ["", "00", "0011", "aAbBcC", "00112233", "0011223344556677"] {
            for id in ["000", "520", "7fF"] {
                assert!(is_usual(&format!("(1795209995.234358) vcan0 {id}#{data}")), "{id}#{data}");
            }
        }
        assert!(is_usual("(0000000000.000000) vcan0 501#001122334455"));
    }

    #[test]
    fn anything_else_is_left_to_the_long_way() {
        for line in [
            "",
            "(1.000000) vcan0 520#00",
            "(1795209995.234358)  vcan0 520#00",
            "(1795209995.234358) vcan0  520#00",
            "(1795209995.234358) can0 520#00",
            "(1795209995.234358) vcan01 520#00",
            "(1795209995.234358) vcan0 800#00",
            "(1795209995.234358) vcan0 52x#00",
            "(1795209995.234358) vcan0 00000520#00",
            "(1795209995.234358) vcan0 520#R",
            "(1795209995.234358) vcan0 520##100",
            "(1795209995.234358) vcan0 520#0",
            "(1795209995.234358) vcan0 520#0g",
            "(1795209995.234358) vcan0 520#00.11",
            "(1795209995.234358) vcan0 520#00 R",
            "(1795209995.234358) vcan0 520#00\r",
            "(1795209995.234358) vcan0 520#001122334455667788",
            "(1795209995.234358) vcan0 520#0011223344556677_B",
        ] {
            assert!(!is_usual(line), "{line}");
        }
    }

    #[test]
    fn no_line_is_usual_before_an_interface_is_known() {
        for line in [
            "(1795209995.234358)  520#0011223344556677\n",
            "(1795209995.234358) vcan0 520#0011223344556677\n",
        ] {
            assert_eq!(read(line.as_bytes(), b""), None, "{line}");
        }
    }
}
