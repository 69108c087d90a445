//! The usual line, which a log has millions of: read at one go, or left to the other files.
//!
//! ```text
//! (1795209995.234358) vcan0 520#0000010000000000
//! ```
//!
//! Ten digits of seconds and six of microseconds, one space, the interface of the line before, one space, an
//! identifier of 11 bits, up to eight bytes of data, and nothing else. [`line::parse`](super::line::parse) reads such
//! a line to the same record, but slower: it has to be ready for anything, and to say where it went wrong.

use super::cursor::Cursor;
use super::record::MAX_CLASSIC;
use super::said::LastSaid;
use super::time::Second;

/// What a usual line says, apart from its interface.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Usual {
    pub(super) time_ns: i64,
    pub(super) id: u32,
    pub(super) data: [u8; MAX_CLASSIC],
    /// Number of data bytes.
    pub(super) len: usize,
}

/// What a line before said that the usual line says again.
#[derive(Debug)]
pub(super) struct Before {
    pub(super) interface: Interface,
    second: Second,
    said: LastSaid,
}

impl Before {
    /// No line has come yet.
    pub(super) const NOTHING: Self =
        Self { interface: Interface::UNKNOWN, second: Second::UNKNOWN, said: LastSaid::NOTHING };
}

/// The interface that the usual line names, with the space before it and that behind: as one word, for names that fit.
#[derive(Debug)]
pub(super) struct Interface {
    word: u128,
    /// Which bits of a word count; none before the first frame, when there is no interface and no line is usual.
    mask: u128,
    len: usize,
}

impl Interface {
    /// No interface is known yet.
    pub(super) const UNKNOWN: Self = Self { word: 0, mask: 0, len: 0 };

    /// The interface of this name.
    pub(super) fn named(name: &str) -> Self {
        let len = name.len() + 2;
        let mut bytes = [0; size_of::<u128>()];
        match bytes.get_mut(..len) {
            Some(place) => place.copy_from_slice(format!(" {name} ").as_bytes()),
            None => return Self::UNKNOWN,
        }
        let mask = u128::MAX >> (8 * (size_of::<u128>() - len));
        Self { word: u128::from_le_bytes(bytes), mask, len }
    }

    /// What stands behind it, if the text begins with it.
    #[inline]
    fn behind<'a>(&self, text: &'a [u8]) -> Option<&'a [u8]> {
        let word = u128::from_le_bytes(*text.first_chunk()?);
        text.get(self.len..).filter(|_| self.mask != 0 && word & self.mask == self.word)
    }
}

/// Reads the line at the beginning of a text if it is a usual one on the interface of the line before and there is room for the
/// longest; tells how long it is, with its line feed, which is found on the way.
#[expect(
    clippy::inline_always,
    reason = "it has one caller, to which its result would go through memory: one part in twenty of `check`"
)]
#[inline(always)]
pub(super) fn read(text: &[u8], before: &mut Before) -> Option<(Usual, usize)> {
    let mut cursor = Cursor::new(text);
    let time_ns = before.second.usual(&mut cursor)?;
    let (id, digits) = before.interface.behind(cursor.rest())?.split_first_chunk()?;
    let said = before.said.says(*id, digits.first_chunk()?)?;
    let (id, data, len) = (said.id, said.data, said.len);
    Some((Usual { time_ns, id, data, len }, text.len() - digits.len() + 2 * len + 1))
}

#[cfg(test)]
mod tests {
    use super::super::line;
    use super::super::record::{self, FrameKind, Record};
    use super::*;

    /// What is known after a line on this interface.
    fn before(interface: &str) -> Before {
        Before { interface: Interface::named(interface), ..Before::NOTHING }
    }

    /// Whether the line is usual. If it is, the long way must read it to the same record.
    fn is_usual(text: &str) -> bool {
        let with_more = format!("{text}\n(1795209995.234359) vcan0");
        let read = read(with_more.as_bytes(), &mut before("vcan0"));
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
            assert_eq!(read(line.as_bytes(), &mut Before { ..Before::NOTHING }), None, "{line}");
        }
    }

    #[test]
    fn an_interface_has_its_whole_name_between_two_spaces() {
        for name in ["c", "vcan0", "fourteen_bytes"] {
            let line = |name| format!("(1795209995.234358) {name} 520#0011223344556677\n");
            let read = |interface| read(line(name).as_bytes(), &mut before(interface)).is_some();
            assert!(read(name), "{name}");
            assert!(!read("vcan") && !read("can0") && !read("fifteen_bytes__"), "{name}");
        }
        let behind = |name: &str| Interface::named(name).behind(b" fifteen_bytes__ 520#00112233").is_some();
        assert!(!behind("fifteen_bytes__") && !behind("fifteen_bytes_"), "it is read the long way");
    }
}
