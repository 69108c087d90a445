//! Dates of the Gregorian calendar.

/// Days since 1970 of a date of the Gregorian calendar; `None` before that, after the year 2262, which is what 64
/// bits of nanoseconds can hold, and where there is no such date.
pub fn days(year: i64, month: i64, day: i64) -> Option<i64> {
    let leap = year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
    let before = [0, 31, 59, 90, 120, 151, 181, 212, 243, 273, 304, 334, 365];
    let index = usize::try_from(month).ok()?.checked_sub(1)?;
    let (begin, end) = (*before.get(index)?, *before.get(index + 1)?);
    let longer = i64::from(leap && month == 2);
    if !(1970..2263).contains(&year) || day < 1 || day > end - begin + longer {
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
            ((2262, 12, 31), Some(107_015)),
            ((2263, 1, 1), None),
            ((i64::MIN, 1, 1), None),
            ((2026, 1, i64::MAX), None),
        ];
        for ((year, month, day), expected) in cases {
            assert_eq!(days(year, month, day), expected, "{year}-{month}-{day}");
        }
    }
}
