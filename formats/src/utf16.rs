//! Text in UTF-16, as Windows PowerShell writes what a program prints into a file, read as UTF-8.

use std::io::{self, Read};

use crate::Source;

const LITTLE_ENDIAN: &[u8] = b"\xff\xfe";
const BIG_ENDIAN: &[u8] = b"\xfe\xff";
/// So much is turned into UTF-8 at a time, in bytes of UTF-16.
const PIECE: usize = 8 * 1024;

/// A source in UTF-8 if it begins with the mark of UTF-16; else, the source as it was.
pub(crate) fn narrow(head: &[u8], source: Source) -> Result<Source, Source> {
    match (head.starts_with(LITTLE_ENDIAN), head.starts_with(BIG_ENDIAN)) {
        (false, false) => Err(source),
        (little, _) => Ok(Box::new(Narrow::new(source, little))),
    }
}

/// A source of UTF-16, as UTF-8. What is no character is the mark of one that was not understood, U+FFFD.
struct Narrow<R> {
    source: R,
    little: bool,
    /// Bytes that have come, of which the first few may wait for those behind them.
    wide: Box<[u8]>,
    waiting: usize,
    text: String,
    given: usize,
    ended: bool,
}

impl<R: Read> Narrow<R> {
    fn new(source: R, little: bool) -> Self {
        let wide = vec![0; PIECE].into_boxed_slice();
        Self { source, little, wide, waiting: 0, text: String::new(), given: 0, ended: false }
    }

    /// Reads what is there, and turns it into UTF-8: maybe nothing, where a character is not complete.
    fn more(&mut self) -> io::Result<()> {
        let count = self.source.read(self.wide.get_mut(self.waiting..).unwrap_or_default())?;
        self.ended = count == 0;
        let (wide, little) = (self.wide.get(..self.waiting + count).unwrap_or_default(), self.little);
        let (units, odd) = wide.as_chunks::<2>();
        let unit =
            |bytes: &[u8; 2]| if little { u16::from_le_bytes(*bytes) } else { u16::from_be_bytes(*bytes) };
        // The second half of a character may still come.
        let half = units.last().is_some_and(|last| (0xD800..0xDC00).contains(&unit(last))) && !self.ended;
        let whole = units.get(..units.len() - usize::from(half)).unwrap_or_default();
        self.text.clear();
        self.given = 0;
        let characters = char::decode_utf16(whole.iter().map(unit));
        self.text.extend(characters.map(|character| character.unwrap_or(char::REPLACEMENT_CHARACTER)));
        if self.ended && !odd.is_empty() {
            self.text.push(char::REPLACEMENT_CHARACTER);
        }
        let (taken, end) = (2 * whole.len(), wide.len());
        self.waiting = if self.ended { 0 } else { end - taken };
        self.wide.copy_within(taken..end, 0);
        Ok(())
    }
}

impl<R: Read> Read for Narrow<R> {
    fn read(&mut self, room: &mut [u8]) -> io::Result<usize> {
        while self.given == self.text.len() && !self.ended {
            self.more()?;
        }
        let mut rest = self.text.as_bytes().get(self.given..).unwrap_or_default();
        let count = rest.read(room)?;
        self.given += count;
        Ok(count)
    }
}

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use super::*;

    /// A source that gives so many bytes at a time.
    struct Slowly(Cursor<Vec<u8>>, usize);

    impl Read for Slowly {
        fn read(&mut self, room: &mut [u8]) -> io::Result<usize> {
            let count = room.len().min(self.1);
            self.0.read(room.get_mut(..count).unwrap_or_default())
        }
    }

    fn wide(text: &str, little: bool) -> Vec<u8> {
        let bytes = |unit: u16| if little { unit.to_le_bytes() } else { unit.to_be_bytes() };
        text.encode_utf16().flat_map(bytes).collect()
    }

    fn narrowed(bytes: &[u8], step: usize) -> String {
        let head = bytes.get(..2).unwrap_or_default();
        let source = Box::new(Slowly(Cursor::new(bytes.to_vec()), step));
        let mut text = String::new();
        narrow(head, source).unwrap_or_else(|source| source).read_to_string(&mut text).expect("it is UTF-8");
        text
    }

    #[test]
    fn text_of_either_order_is_the_same_text_however_it_comes() {
        let text = "\u{feff}(1.000000) can0 520#00\r\nM\u{e4}rz \u{1f697}\n".repeat(700);
        for little in [true, false] {
            for step in [1, 2, 3, 5, 4096, 1 << 20] {
                assert!(narrowed(&wide(&text, little), step) == text, "{little} {step}");
            }
        }
    }

    #[test]
    fn what_is_no_character_is_marked_and_costs_nothing_else() {
        let mark = '\u{fffd}';
        // Half a character at the end, and one byte too many.
        let cut = [LITTLE_ENDIAN, b"a\0", b"\x3d\xd8"].concat();
        assert_eq!(narrowed(&cut, 1), format!("\u{feff}a{mark}"));
        assert_eq!(narrowed(&[&cut[..], b"x"].concat(), 1), format!("\u{feff}a{mark}{mark}"));
        assert_eq!(narrowed(&[LITTLE_ENDIAN, b"\0\xdcb\0"].concat(), 3), format!("\u{feff}{mark}b"));
    }

    #[test]
    fn only_what_is_marked_is_turned() {
        for head in [&b""[..], b"\xff", b"(1.0", b"\xef\xbb\xbf"] {
            assert!(narrow(head, Box::new(io::empty())).is_err());
        }
    }
}
