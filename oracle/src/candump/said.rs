//! What each identifier said last: most frames say it again, and then their text only has to be compared.

use super::hex;
use super::record::{MAX_CLASSIC, STANDARD_MASK};

/// One for each identifier of a document, which differ in these bits of their text; others share a place, which costs time only.
const PLACES: usize = 32;

/// The text of an identifier with its number sign, and that of the longest data with the line feed.
type Id = [u8; 4];
type Digits = [u8; 2 * MAX_CLASSIC + 1];

/// The last frame of each identifier.
#[derive(Debug)]
pub(super) struct LastSaid([Said; PLACES]);

/// An identifier of 11 bits and up to eight bytes of data, as text and as what it stands for.
#[derive(Clone, Copy, Debug)]
pub(super) struct Said {
    id_text: Id,
    /// The digits and, if there is room for it, the line feed behind them.
    text: u128,
    /// Which bits of the text count.
    mask: u128,
    pub(super) id: u32,
    pub(super) data: [u8; MAX_CLASSIC],
    /// Number of data bytes.
    pub(super) len: usize,
}

impl LastSaid {
    /// No frame has come yet.
    pub(super) const NOTHING: Self = Self([Said::NOTHING; PLACES]);

    /// What a frame says; `None` if it is anything but digits of the usual number and a line feed.
    #[inline]
    pub(super) fn says(&mut self, id: Id, digits: &Digits) -> Option<&Said> {
        let place = usize::from(id[1] & 0b11) << 3 | usize::from(id[2] & 0b111);
        let said = self.0.get_mut(place)?;
        if !said.is_again(id, digits) {
            *said = Said::read(id, digits)?;
        }
        Some(said)
    }
}

impl Said {
    /// What no text is equal to.
    const NOTHING: Self = Self { id_text: [0; 4], text: 1, mask: 0, id: 0, data: [0; MAX_CLASSIC], len: 0 };

    #[inline]
    fn is_again(&self, id: Id, digits: &Digits) -> bool {
        id == self.id_text
            && word(digits) & self.mask == self.text
            && digits.get(2 * self.len) == Some(&b'\n')
    }

    #[inline]
    fn read(id_text: Id, digits: &Digits) -> Option<Self> {
        let [id @ .., b'#'] = id_text else { return None };
        let id = hex::number(id).ok().filter(|id| *id <= STANDARD_MASK)?;
        let (data, len) = hex::up_to_line_feed(digits)?;
        let mask = u128::MAX >> (8 * (2 * MAX_CLASSIC).saturating_sub(2 * len + 1));
        Some(Self { id_text, text: word(digits) & mask, mask, id, data, len })
    }
}

/// All but the last byte, which is that of the line feed behind eight bytes.
#[inline]
fn word(digits: &Digits) -> u128 {
    let [word @ .., _] = *digits;
    u128::from_le_bytes(word)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Frames of which none, or only one digit, the line feed or the identifier differs from the one before, with another line
    /// behind them.
    #[test]
    fn a_frame_says_the_same_whatever_came_before_it() {
        let texts = |id: &str, data: &str| {
            let line = format!("{id}#{data}\n(1795209995.234358)");
            let (id, digits) = line.as_bytes().split_first_chunk().unwrap();
            (*id, *digits.first_chunk().unwrap())
        };
        let mut lines = Vec::new();
        for id in ["520", "521", "5A0", "720", "512", "920", "52G", "\0\0\0"] {
            for len in 0..=MAX_CLASSIC {
                let data = "00112233445566AA".get(..2 * len).unwrap();
                lines.push(texts(id, data));
                for place in 0..data.len() {
                    let mut other = data.to_owned();
                    other.replace_range(place..=place, if place % 3 == 0 { "x" } else { "f" });
                    lines.push(texts(id, &other));
                }
            }
            lines.push(texts(id, "00112233445566AA0"));
            lines.push(texts(id, "00112233445566AA\r"));
        }
        lines.push(([0; 4], [b'\n'; 17]));
        let is = |said: Option<&Said>| said.map(|said| (said.id, said.data, said.len));
        let alone: Vec<_> = lines
            .iter()
            .map(|(id, digits)| {
                let mut last = LastSaid::NOTHING;
                is(last.says(*id, digits))
            })
            .collect();
        assert!(alone.iter().flatten().count() > 100 && alone.iter().any(Option::is_none));
        for ((first, first_digits), before) in lines.iter().zip(&alone) {
            for ((id, digits), expected) in lines.iter().zip(&alone) {
                let mut last = LastSaid::NOTHING;
                assert_eq!(is(last.says(*first, first_digits)), *before);
                assert_eq!(is(last.says(*id, digits)), *expected, "{id:?} {digits:?} after {first_digits:?}");
            }
        }
    }
}
