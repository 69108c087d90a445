//! The time of `candump -t A`: a date and the time of day, `(2026-11-25 12:00:00.010123)`.
//!
//! It is that of the clock on the wall where it was recorded, which zone that was it does not say: it is taken for UTC. Between two frames it
//! makes no difference, but where the clock was set, such as at the end of summer time.

use super::super::line::Cursor;
use super::super::time::NS_PER_SECOND;

/// The shape: a digit stands for any.
const SHAPE: &[u8] = b"(2026-11-25 12:00:00";

/// Takes a date and a time; `None`, and takes nothing, if that is not what stands there.
pub(super) fn take(cursor: &mut Cursor<'_>) -> Option<i64> {
    let text = cursor.rest();
    let head = text.get(..SHAPE.len())?;
    let fits = |(byte, shape): (&u8, &u8)| {
        if shape.is_ascii_digit() { byte.is_ascii_digit() } else { byte == shape }
    };
    if !head.iter().zip(SHAPE).all(fits) {
        return None;
    }
    let number = |from: usize, len: usize| -> i64 {
        head.iter()
            .skip(from)
            .take(len)
            .fold(0, |number, byte| number * 10 + i64::from(byte.wrapping_sub(b'0')))
    };
    let days = days(number(1, 4), number(6, 2), number(9, 2))?;
    let seconds = (number(12, 2) * 60 + number(15, 2)) * 60 + number(18, 2);
    let mut rest = text.get(SHAPE.len()..)?;
    let mut fraction = 0;
    if let Some(digits) = rest.strip_prefix(b".") {
        let len = digits.iter().take_while(|byte| byte.is_ascii_digit()).count();
        let mut unit = NS_PER_SECOND;
        for byte in digits.iter().take(len) {
            unit /= 10;
            fraction += i64::from(byte - b'0') * unit;
        }
        rest = digits.get(len..)?;
    }
    let rest = rest.strip_prefix(b")")?;
    let time_ns = (days * 86_400 + seconds).checked_mul(NS_PER_SECOND)?.checked_add(fraction)?;
    cursor.skip(text.len() - rest.len());
    Some(time_ns)
}

/// Days since 1970 of a date of the Gregorian calendar; `None` before that, and where there is no such date.
fn days(year: i64, month: i64, day: i64) -> Option<i64> {
    let leap = year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
    let before = [0, 31, 59, 90, 120, 151, 181, 212, 243, 273, 304, 334, 365];
    let index = usize::try_from(month).ok()?.checked_sub(1)?;
    let (begin, end) = (*before.get(index)?, *before.get(index + 1)?);
    let longer = i64::from(leap && month == 2);
    if year < 1970 || day < 1 || day > end - begin + longer {
        return None;
    }
    let past = year - 1;
    let leaps = |year: i64| year / 4 - year / 100 + year / 400;
    Some((year - 1970) * 365 + leaps(past) - leaps(1969) + begin + i64::from(leap && month > 2) + day - 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dates_are_days_since_1970() {
        let cases = [
            ((1970, 1, 1), Some(0)),
            ((1970, 12, 31), Some(364)),
            ((1972, 2, 29), Some(789)),
            ((1972, 3, 1), Some(790)),
            ((2000, 2, 29), Some(11_016)),
            ((2000, 3, 1), Some(11_017)),
            ((2026, 11, 25), Some(20_782)),
            ((2100, 3, 1), Some(47_541)),
            ((2100, 2, 29), None),
            ((2026, 2, 29), None),
            ((2026, 13, 1), None),
            ((2026, 0, 1), None),
            ((2026, 4, 31), None),
            ((1969, 12, 31), None),
        ];
        for ((year, month, day), expected) in cases {
            assert_eq!(days(year, month, day), expected, "{year}-{month}-{day}");
        }
    }

    #[test]
    fn only_a_whole_date_is_taken() {
        let take = |text: &str| {
            let mut cursor = Cursor::new(text.as_bytes());
            (take(&mut cursor), cursor.rest().len())
        };
        assert_eq!(take("(1970-01-02 00:00:01.5) x"), (Some(86_401_500_000_000), 2));
        assert_eq!(take("(1970-01-01 01:00:00)"), (Some(3_600_000_000_000), 0));
        for text in [
            "",
            "(1.5)",
            "(1970-01-02",
            "(1970-01-02 00:00:01.5",
            "(1970-31-02 00:00:01.5)",
            "(9999-01-01 00:00:00)",
        ] {
            assert_eq!(take(text), (None, text.len()), "{text}");
        }
    }
}
