//! The header of the file, which tells when the measurement began.

use crate::bytes::u16_at;
use crate::text::days;

/// How a file begins.
pub(crate) const MAGIC: &[u8] = b"LOGG";
/// What of the header is read; it is longer.
pub(super) const LEN: usize = 72;
/// Where the time stands at which the measurement began.
const BEGAN: usize = 40;

/// When the measurement began, in nanoseconds since 1970; 0 where the file does not say.
///
/// It is a date and a time of day without a zone, and is taken for that of UTC, as other readers do.
pub(super) fn began(file: &[u8]) -> i64 {
    when(file).unwrap_or(0)
}

fn when(file: &[u8]) -> Option<i64> {
    let part = |index: usize| u16_at(file, BEGAN + 2 * index).map(i64::from);
    let (year, month, day) = (part(0)?, part(1)?, part(3)?);
    let (hour, minute, second, millis) = (part(4)?, part(5)?, part(6)?, part(7)?);
    let sane = (1970..=2261).contains(&year)
        && (1..=12).contains(&month)
        && (1..=31).contains(&day)
        && hour < 24
        && minute < 60
        && second < 60
        && millis < 1000;
    let days = days(year, month, day)?;
    sane.then(|| {
        let seconds = ((days * 24 + hour) * 60 + minute) * 60 + second;
        (seconds * 1000 + millis) * 1_000_000
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(parts: [u16; 8]) -> Vec<u8> {
        let mut file = vec![0; BEGAN];
        file.extend(parts.map(u16::to_le_bytes).concat());
        file
    }

    #[test]
    fn the_beginning_is_a_time_of_utc() {
        for (parts, seconds) in [
            ([1970, 1, 4, 1, 0, 0, 0, 0], 0),
            ([2000, 2, 2, 29, 12, 0, 0, 0], 951_825_600),
            ([2001, 3, 4, 1, 0, 0, 0, 0], 983_404_800),
            ([2026, 11, 3, 25, 13, 11, 37, 0], 1_795_612_297),
            ([2100, 12, 5, 31, 23, 59, 59, 0], 4_133_980_799),
        ] {
            assert_eq!(began(&file(parts)), seconds * 1_000_000_000, "{parts:?}");
        }
        assert_eq!(began(&file([1970, 1, 4, 1, 0, 0, 0, 7])), 7_000_000);
    }

    #[test]
    fn a_beginning_that_is_no_time_is_zero() {
        for parts in [
            [0; 8],
            [1969, 12, 0, 31, 0, 0, 0, 0],
            [u16::MAX; 8],
            [2026, 13, 0, 1, 0, 0, 0, 0],
            [2026, 1, 0, 1, 24, 0, 0, 0],
        ] {
            assert_eq!(began(&file(parts)), 0, "{parts:?}");
        }
        assert_eq!(began(b"LOGG"), 0);
    }
}
