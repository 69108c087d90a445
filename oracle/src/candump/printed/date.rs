//! The time of `candump -t A`: a date and the time of day, `(2026-11-25 12:00:00.010123)`.
//!
//! It is that of the clock on the wall where it was recorded, which zone that was it does not say: it is taken for UTC. Between two frames it
//! makes no difference, but where the clock was set, such as at the end of summer time.

use super::super::cursor::Cursor;
use super::super::time::NS_PER_SECOND;
use crate::text::days;

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

#[cfg(test)]
mod tests {
    use super::*;

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
