//! The time stamp: seconds in parentheses, `(1795209995.234358)`.

use super::cursor::Cursor;
use super::error::Flaw;

const TIME: &str = "a time such as (1436509052.249713)";
const SECONDS: &str = "a time in seconds, such as (1436509052.249713)";
const END: &str = "a digit, or the ')' that ends the time";
const EARLIER: &str = "a time before the year 2262, which is what 64 bits of nanoseconds can hold";

pub(super) const NS_PER_SECOND: i64 = 1_000_000_000;
pub(super) const NS_PER_MICROSECOND: i64 = 1_000;

/// Takes a time stamp; the result is in nanoseconds.
#[inline]
pub(super) fn take(cursor: &mut Cursor<'_>) -> Result<i64, Flaw> {
    match usual(cursor) {
        Some(time) => Ok(time),
        None => any(cursor),
    }
}

/// The form that candump prints, ten digits of seconds and six of microseconds, read eight digits at a time.
/// Whatever it cannot read is left for [`any`], which would read this form to the same value.
#[inline]
pub(super) fn usual(cursor: &mut Cursor<'_>) -> Option<i64> {
    let [b'(', seconds @ .., b'.', _, _, _, _, _, _, b')'] = cursor.rest().first_chunk::<19>()? else {
        return None;
    };
    let [_, _, _, _, _, _, _, _, _, _, last @ .., b')'] = cursor.rest().first_chunk::<19>()? else {
        return None;
    };
    let [hundreds @ .., s8, s9] = seconds;
    // Of the last eight, the two before the fraction are one digit and the point.
    let ones = u64::from(u16::from_le_bytes([*s8, *s9]));
    let hundreds = eight_digits(u64::from_le_bytes(*hundreds))?;
    let rest = eight_digits(u64::from_le_bytes(*last) >> 16 << 16 | ones)?;
    // Sixteen digits of microseconds: below 10^16, so that nanoseconds may overflow, and then it is not usual.
    let time = (hundreds * 100_000_000 + rest).checked_mul(NS_PER_MICROSECOND)?;
    cursor.skip(19);
    Some(time)
}

/// The second of a line before, which the next one most likely names too: then only the fraction is read.
#[derive(Debug)]
pub(super) struct Second {
    /// As it stands there, with the parenthesis and the point.
    text: [u8; 12],
    ns: i64,
}

impl Second {
    /// No second is known yet.
    pub(super) const UNKNOWN: Self = Self { text: [0; 12], ns: 0 };

    /// As [`usual`], in less time for a line of the same second as the one before.
    #[inline]
    pub(super) fn usual(&mut self, cursor: &mut Cursor<'_>) -> Option<i64> {
        let stamp = cursor.rest().first_chunk::<19>()?;
        if stamp.first_chunk() != Some(&self.text) {
            return self.another(cursor);
        }
        let (_, last) = stamp.split_last_chunk()?;
        let word = u64::from_le_bytes(*last);
        // The point before the six digits makes room for two zeros, and the parenthesis behind them falls out.
        let digits = word >> 8 << 16 | u64::from(u16::from_le_bytes(*b"00"));
        let time = self.ns.checked_add(eight_digits(digits)? * NS_PER_MICROSECOND)?;
        if word >> 56 != u64::from(b')') {
            return None;
        }
        cursor.skip(19);
        Some(time)
    }

    #[cold]
    fn another(&mut self, cursor: &mut Cursor<'_>) -> Option<i64> {
        let text = *cursor.rest().first_chunk()?;
        let time = usual(cursor)?;
        *self = Self { text, ns: time - time % NS_PER_SECOND };
        Some(time)
    }
}

/// The number that eight decimal digits stand for: each step halves the count of the numbers in the word and
/// doubles their width.
#[inline]
fn eight_digits(digits: u64) -> Option<i64> {
    let word = digits ^ 0x3030_3030_3030_3030;
    // A byte above 9 has its top bit set here, either its own or the one that adding 0x76 carries into it.
    if (word | word.wrapping_add(0x7676_7676_7676_7676)) & 0x8080_8080_8080_8080 != 0 {
        return None;
    }
    let pairs = (word * 10 + (word >> 8)) & 0x00FF_00FF_00FF_00FF;
    let fours = (pairs * 100 + (pairs >> 16)) & 0x0000_FFFF_0000_FFFF;
    let eight = (fours * 10_000 + (fours >> 32)) & 0xFFFF_FFFF;
    i64::try_from(eight).ok()
}

/// Any number of digits before and after the point; the point itself may be missing.
fn any(cursor: &mut Cursor<'_>) -> Result<i64, Flaw> {
    if cursor.peek() != Some(b'(') {
        return Err(cursor.flaw(TIME));
    }
    let start = *cursor;
    cursor.skip(1);
    let mut seconds: i64 = decimal(cursor).ok_or_else(|| cursor.flaw(SECONDS))?;
    while let Some(digit) = decimal(cursor) {
        seconds = seconds
            .checked_mul(10)
            .and_then(|tens| tens.checked_add(digit))
            .ok_or_else(|| start.flaw(EARLIER))?;
    }
    let mut fraction = 0;
    if cursor.peek() == Some(b'.') {
        cursor.skip(1);
        let mut unit = NS_PER_SECOND;
        while let Some(digit) = decimal(cursor) {
            unit /= 10;
            fraction += digit * unit;
        }
    }
    if cursor.peek() != Some(b')') {
        return Err(cursor.flaw(END));
    }
    cursor.skip(1);
    seconds
        .checked_mul(NS_PER_SECOND)
        .and_then(|whole| whole.checked_add(fraction))
        .ok_or_else(|| start.flaw(EARLIER))
}

fn decimal(cursor: &mut Cursor<'_>) -> Option<i64> {
    let byte = cursor.peek().filter(u8::is_ascii_digit)?;
    cursor.skip(1);
    Some(i64::from(byte - b'0'))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<i64, Flaw> {
        let mut cursor = Cursor::new(text.as_bytes());
        let time = take(&mut cursor)?;
        assert!(cursor.rest().is_empty(), "{text}");
        Ok(time)
    }

    #[test]
    fn times_are_nanoseconds_whatever_their_digits() {
        let cases = [
            ("(1795209995.234358)", 1_795_209_995_234_358_000),
            ("(0000000000.000001)", 1_000),
            ("(9223372036.854775)", 9_223_372_036_854_775_000),
            ("(0.000000)", 0),
            ("(000.000000)", 0),
            ("(12.5)", 12_500_000_000),
            ("(12)", 12_000_000_000),
            ("(12.)", 12_000_000_000),
            ("(1795209995.234358001)", 1_795_209_995_234_358_001),
            ("(1.00000000099999999999999999999999)", 1_000_000_000),
            ("(00000000000000000000000000000001.25)", 1_250_000_000),
            ("(9223372036.854775807)", i64::MAX),
        ];
        for (text, time) in cases {
            assert_eq!(read(text), Ok(time), "{text}");
        }
    }

    #[test]
    fn other_times_are_refused_where_they_go_wrong() {
        let cases = [
            ("", 0, TIME),
            ("1795209995.234358", 0, TIME),
            ("()", 1, SECONDS),
            ("(.5)", 1, SECONDS),
            ("(-1.5)", 1, SECONDS),
            ("(2020-01-01 12:00:00.000000)", 5, END),
            ("(1795209995.23435x)", 17, END),
            ("(1795209x95.234358)", 8, END),
            ("(1795209995.234358", 18, END),
            ("(9223372036.854776)", 0, EARLIER),
            ("(9999999999.999999)", 0, EARLIER),
            ("(9223372036.854775808)", 0, EARLIER),
            ("(99999999999999999999999999999999)", 0, EARLIER),
        ];
        for (text, at, expected) in cases {
            assert_eq!(read(text), Err(Flaw { at, expected }), "{text}");
        }
    }

    #[test]
    fn the_fast_way_and_the_general_way_agree() {
        // Every byte in every place of the usual form.
        for place in 0..19 {
            for byte in 0..=u8::MAX {
                let mut text = *b"(1795209995.234358)";
                text[place] = byte;
                let whole = |take: &mut dyn FnMut(&mut Cursor<'_>) -> Option<i64>| {
                    let mut cursor = Cursor::new(&text);
                    take(&mut cursor).filter(|_| cursor.rest().is_empty())
                };
                let expected = whole(&mut |cursor| any(cursor).ok());
                let mut second = same_second("(1795209995.000000)");
                assert_eq!(whole(&mut usual), expected, "{}", text.escape_ascii());
                assert_eq!(whole(&mut |cursor| second.usual(cursor)), expected, "{}", text.escape_ascii());
            }
        }
    }

    /// What is known after a line with this time.
    fn same_second(text: &str) -> Second {
        let mut second = Second::UNKNOWN;
        assert!(second.usual(&mut Cursor::new(text.as_bytes())).is_some(), "{text}");
        second
    }

    #[test]
    fn a_second_goes_on_until_another_begins() {
        let mut second = Second::UNKNOWN;
        for (text, time) in [
            ("(1795209995.999999)", Some(1_795_209_995_999_999_000)),
            ("(1795209995.000000)", Some(1_795_209_995_000_000_000)),
            ("(1795209996.000001)", Some(1_795_209_996_000_001_000)),
            ("(1795209996.00000x)", None),
            ("(1795209996.000002 ", None),
            ("(1795209996.00003)", None),
            ("(1795209996.000004)", Some(1_795_209_996_000_004_000)),
            ("(9223372036.854775)", Some(9_223_372_036_854_775_000)),
            ("(9223372036.854776)", None),
            ("(9223372036.000000)", Some(9_223_372_036_000_000_000)),
        ] {
            assert_eq!(second.usual(&mut Cursor::new(text.as_bytes())), time, "{text}");
        }
    }
}
