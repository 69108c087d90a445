//! Hexadecimal digits, through a table: one load for each digit, and no branch until the end.

use super::frame::MAX_CLASSIC;

/// What the table holds for a byte that is no digit: any value with high bits set.
const NONE: u8 = 0xFF;

const VALUE: [u8; 256] = {
    let mut table = [NONE; 256];
    let mut digit = 0;
    while digit < 16 {
        table[b"0123456789abcdef"[digit as usize] as usize] = digit;
        table[b"0123456789ABCDEF"[digit as usize] as usize] = digit;
        digit += 1;
    }
    table
};

/// The value of one digit, upper or lower case.
#[inline]
pub(super) fn digit(byte: u8) -> Option<u8> {
    match VALUE[usize::from(byte)] {
        NONE => None,
        value => Some(value),
    }
}

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
        Err(digits.iter().take_while(|byte| digit(**byte).is_some()).count())
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

/// The bytes that up to [`MAX_CLASSIC`] pairs of digits stand for, and how many they are; `None` if there is more or
/// anything else.
#[inline]
pub(super) fn some_bytes(digits: &[u8]) -> Option<([u8; MAX_CLASSIC], usize)> {
    let (pairs, odd) = digits.as_chunks::<2>();
    let (mut bytes, mut seen) = ([0; MAX_CLASSIC], 0);
    for (byte, pair) in bytes.iter_mut().zip(pairs) {
        let [high, low] = pair.map(|digit| VALUE[usize::from(digit)]);
        seen |= high;
        seen |= low;
        *byte = high << 4 | low & 0xF;
    }
    (seen != NONE && odd.is_empty() && pairs.len() <= MAX_CLASSIC).then_some((bytes, pairs.len()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_agree_with_the_standard_library() {
        for byte in 0..=u8::MAX {
            let expected = char::from(byte).to_digit(16).and_then(|value| u8::try_from(value).ok());
            assert_eq!(digit(byte), expected, "{byte:#04x}");
            assert_eq!(number([b'5', byte]), expected.map(|low| 0x50 | u32::from(low)).ok_or(1));
            assert_eq!(bytes([byte, b'a']), expected.map(|high| [high << 4 | 0xA]));
            assert_eq!(bytes([b'C', byte]), expected.map(|low| [0xC0 | low]));
            assert_eq!(some_bytes(&[b'1', b'2', byte, b'a']).is_some(), expected.is_some());
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
