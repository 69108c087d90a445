//! Hexadecimal digits of a length that is known beforehand, all of them at once.

use super::record::MAX_CLASSIC;
use crate::text::{NONE, VALUE, hex_digit};

/// The value of up to 8 digits, or the offset of the first byte that is none.
#[inline]
pub(super) fn number<const N: usize>(digits: [u8; N]) -> Result<u32, usize> {
    const { assert!(N <= 8) };
    let (mut value, mut seen) = (0, 0);
    for byte in digits {
        let digit = VALUE[usize::from(byte)];
        seen |= digit;
        value = value << 4 | u32::from(digit & 0xF);
    }
    if seen == NONE {
        Err(digits.iter().take_while(|byte| hex_digit(**byte).is_some()).count())
    } else {
        Ok(value)
    }
}

/// The bytes that pairs of digits stand for, if they are digits all of them.
#[inline]
pub(super) fn bytes<const DIGITS: usize, const BYTES: usize>(digits: [u8; DIGITS]) -> Option<[u8; BYTES]> {
    const { assert!(DIGITS == 2 * BYTES) };
    let (mut bytes, mut seen) = ([0; BYTES], 0);
    for (byte, pair) in bytes.iter_mut().zip(digits.as_chunks::<2>().0) {
        let [high, low] = pair.map(|digit| VALUE[usize::from(digit)]);
        seen |= high;
        seen |= low;
        *byte = high << 4 | low & 0xF;
    }
    (seen != NONE).then_some(bytes)
}

/// The bytes that up to [`MAX_CLASSIC`] pairs of digits stand for, up to a line feed, and how many they are; `None` if there is
/// more or anything else.
#[inline]
pub(super) fn up_to_line_feed(text: &[u8; 2 * MAX_CLASSIC + 1]) -> Option<([u8; MAX_CLASSIC], usize)> {
    let (low, rest) = text.split_first_chunk()?;
    let ((low, low_digits), (high, high_digits)) = (eight(*low), eight(*rest.first_chunk()?));
    let digits = if low_digits < 8 { low_digits } else { 8 + high_digits };
    let bytes = high << 32 | low;
    if digits % 2 != 0 || text.get(digits) != Some(&b'\n') {
        return None;
    }
    // What stands behind the line feed is none of it.
    let kept = u64::MAX.checked_shl(4 * u32::try_from(digits).ok()?).map_or(u64::MAX, |behind| !behind);
    Some(((bytes & kept).to_le_bytes(), digits / 2))
}

/// The bytes that eight digits stand for, the first lowest, and how many digits there are before anything else, all eight at once:
/// each byte of the word is one of them.
#[inline]
const fn eight(digits: [u8; 8]) -> (u64, usize) {
    const TOP: u64 = 0x8080_8080_8080_8080;
    const fn each(byte: u8) -> u64 {
        u64::from_le_bytes([byte; 8])
    }
    let word = u64::from_le_bytes(digits);
    // Seven bits of a byte and what is added carry into its own top bit only: that says whether it is more than a number.
    let decimal = (word ^ each(b'0')) & !TOP;
    let letter = ((word | each(0x20)) ^ each(0x60)) & !TOP;
    let is_decimal = !(decimal + each(0x80 - 10)) & TOP;
    let is_letter = (letter + each(0x7F)) & !(letter + each(0x80 - 7)) & TOP;
    let others = !((is_decimal | is_letter) & !word) & TOP;
    let values = (word & each(0xF)) + (is_letter >> 7) * 9;
    let pairs = (values << 4 | values >> 8) & 0x00FF_00FF_00FF_00FF;
    let fours = (pairs | pairs >> 8) & 0x0000_FFFF_0000_FFFF;
    ((fours | fours >> 16) & 0xFFFF_FFFF, others.trailing_zeros() as usize / 8)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_agree_with_the_standard_library() {
        for byte in 0..=u8::MAX {
            let expected = char::from(byte).to_digit(16).and_then(|value| u8::try_from(value).ok());
            assert_eq!(number([b'5', byte]), expected.map(|low| 0x50 | u32::from(low)).ok_or(1));
            assert_eq!(bytes([byte, b'a']), expected.map(|high| [high << 4 | 0xA]));
            assert_eq!(bytes([b'C', byte]), expected.map(|low| [0xC0 | low]));
            for place in 0..16 {
                let mut text = *b"0123456789abCDEF\n";
                text[place] = byte;
                let digits = text.iter().take_while(|byte| hex_digit(**byte).is_some()).count();
                let usual = text[digits] == b'\n' && digits % 2 == 0;
                let expected = (0..8).map(|byte| number([text[2 * byte], text[2 * byte + 1]]).unwrap_or(0));
                let expected: Vec<u8> =
                    expected.take(digits / 2).map(|byte| byte.try_into().unwrap()).collect();
                let read = up_to_line_feed(&text)
                    .map(|(bytes, len)| (bytes[..len].to_vec(), bytes[len..].iter().all(|byte| *byte == 0)));
                assert_eq!(read, usual.then_some((expected, true)), "{byte:#04x} at {place}");
            }
        }
    }

    #[test]
    fn numbers_use_all_their_digits() {
        assert_eq!(number(*b"1FFFFFFF"), Ok(0x1FFF_FFFF));
        assert_eq!(number(*b"FfFfFfFf"), Ok(u32::MAX));
        assert_eq!(number(*b"5:0"), Err(1));
        assert_eq!(bytes(*b"0123456789abcDEF"), Some([0x01, 0x23, 0x45, 0x67, 0x89, 0xAB, 0xCD, 0xEF]));
    }
}
