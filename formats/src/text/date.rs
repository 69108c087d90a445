//! Days and times of day as headers have them.
//!
//! None of them says which time zone it is of: they are taken for UTC, so that times of one file fit together.

use adsdv_oracle::text::{days, decimal, time_ns};

use super::Cursor;

const NS_PER_SECOND: i64 = 1_000_000_000;
const NS_PER_DAY: i128 = 86_400 * 1_000_000_000;
/// Days from 1899-12-30, where spreadsheets and PEAK count from, to 1970-01-01.
const SPREADSHEET_DAYS: i128 = 25_569;

/// The nanoseconds since 1970 of a number of days since 1899-12-30, such as 42209.4075997106; `None` before 1970, after 2262, and for
/// anything else.
pub(crate) fn days_ns(text: &[u8]) -> Option<i64> {
    let point = text.iter().position(|byte| *byte == b'.').unwrap_or(text.len());
    let days = i128::from(decimal(text.get(..point)?)?) - SPREADSHEET_DAYS;
    let (mut part, mut whole) = (0, 1);
    // Twelve digits of a day are finer than a microsecond.
    for digit in text.get(point + 1..).unwrap_or_default() {
        let digit = digit.checked_sub(b'0').filter(|digit| *digit <= 9)?;
        if whole < 1_000_000_000_000_000_000 {
            (part, whole) = (part * 10 + i128::from(digit), whole * 10);
        }
    }
    let ns = days.checked_mul(NS_PER_DAY)?.checked_add(part * NS_PER_DAY / whole)?;
    i64::try_from(ns).ok().filter(|ns| *ns >= 0)
}

/// The nanoseconds since 1970 of a date as Vector's programs write it in English or German, with 12 or 24 hours: `Fri Jul 28
/// 10:00:00.123 am 2017`. `None` before 1970, after 2262, and for anything else.
pub(crate) fn date_ns(text: &[u8]) -> Option<i64> {
    let mut cursor = Cursor::new(text);
    cursor.word();
    let month = month(cursor.word().text)?;
    let day = number(cursor.word().text)?;
    let time = cursor.word().text;
    let behind = cursor.word();
    let (half, year) = match (behind.is("am"), behind.is("pm")) {
        (false, false) => (None, behind.text),
        (_, pm) => (Some(pm), cursor.word().text),
    };
    let days = days(number(year)?, month, day)?;
    let ns = days.checked_mul(86_400 * NS_PER_SECOND)?.checked_add(time_of_day(time, half)?)?;
    (ns >= 0 && cursor.is_at_end()).then_some(ns)
}

fn number(text: &[u8]) -> Option<i64> {
    decimal(text).and_then(|number| i64::try_from(number).ok())
}

fn month(name: &[u8]) -> Option<i64> {
    const NAMES: [&[&[u8]]; 12] = [
        &[b"jan"],
        &[b"feb"],
        // In UTF-8 and in Latin-1.
        &[b"mar", "mär".as_bytes(), b"m\xe4r", b"mrz"],
        &[b"apr"],
        &[b"may", b"mai"],
        &[b"jun"],
        &[b"jul"],
        &[b"aug"],
        &[b"sep"],
        &[b"oct", b"okt"],
        &[b"nov"],
        &[b"dec", b"dez"],
    ];
    let begins =
        |short: &&[u8]| name.get(..short.len()).is_some_and(|begin| begin.eq_ignore_ascii_case(short));
    (1..).zip(NAMES).find(|(_, names)| names.iter().any(begins)).map(|(month, _)| month)
}

/// The nanoseconds of a time such as 10:00:00.123, in the afternoon if `half` says so.
fn time_of_day(text: &[u8], half: Option<bool>) -> Option<i64> {
    let mut parts = text.split(|byte| *byte == b':');
    let (hour, minute, second) = (number(parts.next()?)?, number(parts.next()?)?, parts.next()?);
    let hour = match half {
        None if hour < 24 => hour,
        Some(afternoon) if (1..=12).contains(&hour) => hour % 12 + if afternoon { 12 } else { 0 },
        _ => return None,
    };
    let second = match second.iter().position(|byte| *byte == b'.') {
        // python-can writes milliseconds without the zeros before them: 13.5 is five of them.
        Some(point) if second.len() - point <= 3 => {
            let milliseconds = number(second.get(point + 1..)?)?;
            number(second.get(..point)?)?.checked_mul(NS_PER_SECOND)?.checked_add(milliseconds * 1_000_000)?
        }
        _ => time_ns(second, NS_PER_SECOND)?,
    };
    let fits = minute < 60 && second < 61 * NS_PER_SECOND && parts.next().is_none();
    fits.then_some((hour * 3600 + minute * 60) * NS_PER_SECOND + second)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dates_of_vector_are_read_in_english_and_german() {
        let cases: [(&[u8], Option<i64>); 19] = [
            (b"Thu Jan 1 00:00:00.000 1970", Some(0)),
            (b"Wed Nov 25 13:14:22.123 2026", Some(1_795_612_462_123_000_000)),
            (b"Wed Nov 25 01:14:22.123 pm 2026", Some(1_795_612_462_123_000_000)),
            (b"  Wed  Nov 25 01:14:22.123 PM 2026 ", Some(1_795_612_462_123_000_000)),
            (b"Wed Nov 25 12:00:00 am 2026", Some(1_795_564_800_000_000_000)),
            (b"Wed Nov 25 12:00:00 pm 2026", Some(1_795_608_000_000_000_000)),
            (b"Sam Feb 29 12:00:00 2020", Some(1_582_977_600_000_000_000)),
            ("Son Mär 1 12:00:00 2020".as_bytes(), Some(1_583_064_000_000_000_000)),
            (b"Son M\xe4r 1 12:00:00 2020", Some(1_583_064_000_000_000_000)),
            (b"Don Dez 31 23:59:59.999999 2020", Some(1_609_459_199_999_999_000)),
            (b"Wed Nov 25 13:14:22.5 2026", Some(1_795_612_462_005_000_000)),
            (b"Wed Nov 25 13:14:22 2026 x", None),
            (b"Wed Nov 25 13:14:22.123 am 2026", None),
            (b"Wed Nov 25 24:00:00 2026", None),
            (b"Wed Nov 25 13:14 2026", None),
            (b"Wed Xyz 25 13:14:22 2026", None),
            (b"Wed Nov 25 13:14:22 1969", None),
            (b"Wed Nov 25 13:14:22 9999", None),
            (b"", None),
        ];
        for (text, time) in cases {
            assert_eq!(date_ns(text), time, "{}", text.escape_ascii());
        }
    }

    #[test]
    fn days_of_spreadsheets_are_read() {
        let cases = [
            ("25569", Some(0)),
            ("25569.5", Some(43_200_000_000_000)),
            // 24.07.2015 09:46:56.615, as the header with this number says.
            ("42209.4075997106", Some(1_437_731_216_614_995_840)),
            ("25568.9", None),
            ("999999.0", None),
            ("99999999999999999999999", None),
            ("42209.x", None),
            ("-1", None),
            ("", None),
        ];
        for (text, time) in cases {
            assert_eq!(days_ns(text.as_bytes()), time, "{text}");
        }
    }
}
