//! Numbers of digits. The hexadecimal ones go through a table: one load for each digit, and no branch until the end.

/// What [`VALUE`] holds for a byte that is no digit: any value with high bits set.
pub(crate) const NONE: u8 = 0xFF;

/// The value of each byte as a hexadecimal digit.
pub(crate) const VALUE: [u8; 256] = {
    let mut table = [NONE; 256];
    let mut digit = 0;
    while digit < 16 {
        table[b"0123456789abcdef"[digit as usize] as usize] = digit;
        table[b"0123456789ABCDEF"[digit as usize] as usize] = digit;
        digit += 1;
    }
    table
};

/// The value of one hexadecimal digit, upper or lower case.
#[inline]
pub fn hex_digit(byte: u8) -> Option<u8> {
    match VALUE[usize::from(byte)] {
        NONE => None,
        value => Some(value),
    }
}

/// The value of a hexadecimal number of 1 to 8 digits, upper or lower case.
#[inline]
pub fn hex(text: &[u8]) -> Option<u32> {
    if text.is_empty() || text.len() > 8 {
        return None;
    }
    let mut number = 0;
    for byte in text {
        number = number << 4 | u32::from(hex_digit(*byte)?);
    }
    Some(number)
}

/// The byte that two hexadecimal digits stand for.
#[inline]
pub fn hex_byte(high: u8, low: u8) -> Option<u8> {
    let (high, low) = (VALUE[usize::from(high)], VALUE[usize::from(low)]);
    (high | low != NONE).then_some(high << 4 | low & 0xF)
}

/// The value of a decimal number of digits alone.
#[inline]
pub fn decimal(text: &[u8]) -> Option<u64> {
    if text.is_empty() {
        return None;
    }
    text.iter().try_fold(0_u64, |number, byte| {
        let digit = byte.wrapping_sub(b'0');
        if digit > 9 {
            return None;
        }
        number.checked_mul(10)?.checked_add(digit.into())
    })
}

/// The nanoseconds of a time such as 12.345, whose whole numbers are of `unit_ns` each; `None` if they do not fit into 64 bits, and for
/// anything else. Digits finer than a nanosecond are dropped.
#[inline]
pub fn time_ns(text: &[u8], unit_ns: i64) -> Option<i64> {
    let point = text.iter().position(|byte| *byte == b'.').unwrap_or(text.len());
    let (whole, fraction) = text.split_at_checked(point)?;
    let whole = i64::try_from(decimal(whole)?).ok()?.checked_mul(unit_ns)?;
    let (mut unit, mut part) = (unit_ns, 0);
    for byte in fraction.get(1..).unwrap_or_default() {
        let digit = byte.wrapping_sub(b'0');
        if digit > 9 {
            return None;
        }
        unit /= 10;
        part += unit * i64::from(digit);
    }
    whole.checked_add(part)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_digits_and_nothing_else() {
        for (text, number) in [
            ("0", Some(0)),
            ("1fF", Some(0x1FF)),
            ("FFFFFFFF", Some(u32::MAX)),
            ("000000000", None),
            ("", None),
            ("5g", None),
            ("0x5", None),
            ("-1", None),
        ] {
            assert_eq!(hex(text.as_bytes()), number, "{text}");
        }
        for (text, number) in [
            ("0012", Some(12)),
            ("18446744073709551615", Some(u64::MAX)),
            ("18446744073709551616", None),
            ("", None),
            ("1a", None),
            ("+1", None),
        ] {
            assert_eq!(decimal(text.as_bytes()), number, "{text}");
        }
        for high in 0..=u8::MAX {
            let expected = char::from(high).to_digit(16).and_then(|value| u8::try_from(value).ok());
            assert_eq!(hex_digit(high), expected, "{high:#04x}");
            for low in [b'0', b'9', b'a', b'F', b'g', b' ', 0xFF] {
                assert_eq!(hex_byte(high, low).map(u32::from), hex(&[high, low]), "{high} {low}");
            }
        }
    }

    #[test]
    fn times_are_nanoseconds_whatever_their_digits() {
        const SECOND: i64 = 1_000_000_000;
        for (text, unit_ns, time) in [
            ("0.012345", SECOND, Some(12_345_000)),
            ("12", SECOND, Some(12 * SECOND)),
            ("12.", SECOND, Some(12 * SECOND)),
            ("1.0000000019", SECOND, Some(SECOND + 1)),
            ("9223372036.854775807", SECOND, Some(i64::MAX)),
            ("9223372036.854775808", SECOND, None),
            ("99999999999999999999", SECOND, None),
            ("1841.7", 1_000_000, Some(1_841_700_000)),
            ("", SECOND, None),
            (".5", SECOND, None),
            ("-1.5", SECOND, None),
            ("1.5.2", SECOND, None),
            ("1.5e3", SECOND, None),
        ] {
            assert_eq!(time_ns(text.as_bytes(), unit_ns), time, "{text}");
        }
    }
}
