//! Times as they are written: seconds with at most three decimals, so that they are whole milliseconds.

use std::fmt;

use super::MAX_MS;

/// Milliseconds, written as seconds without zeros at the end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Seconds(pub(super) u64);

impl fmt::Display for Seconds {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (seconds, ms) = (self.0 / 1000, self.0 % 1000);
        if ms == 0 {
            return write!(f, "{seconds}");
        }
        write!(f, "{seconds}.{}", format!("{ms:03}").trim_end_matches('0'))
    }
}

impl Seconds {
    /// Reads a time, as milliseconds; says what was expected if it is none.
    pub(super) fn parse(text: &str) -> Result<u32, String> {
        let (whole, decimals) = text.split_once('.').unwrap_or((text, "0"));
        let digits = |part: &str| !part.is_empty() && part.bytes().all(|byte| byte.is_ascii_digit());
        if !digits(whole) || !digits(decimals) {
            return Err("seconds such as 3 or 0.25".to_owned());
        }
        if decimals.len() > 3 {
            return Err("seconds with at most three decimals".to_owned());
        }
        let too_long = || format!("at most {} seconds, which is a day", Self(MAX_MS.into()));
        let seconds: u32 = whole.parse().map_err(|_| too_long())?;
        // Three digits, hence a number.
        let ms: u32 = format!("{decimals:0<3}").parse().unwrap_or_default();
        let all = seconds.checked_mul(1000).and_then(|all| all.checked_add(ms)).filter(|&all| all <= MAX_MS);
        all.ok_or_else(too_long)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_whole_milliseconds() {
        let read =
            [("0", 0), ("12.5", 12_500), ("0.001", 1), ("007.250", 7250), ("86400", MAX_MS), ("0.0", 0)];
        for (text, ms) in read {
            assert_eq!(Seconds::parse(text), Ok(ms), "{text}");
        }
        let written = [(0, "0"), (12_500, "12.5"), (1, "0.001"), (10, "0.01"), (MAX_MS, "86400")];
        for (ms, text) in written {
            assert_eq!(Seconds(ms.into()).to_string(), text);
            assert_eq!(Seconds::parse(text), Ok(ms));
        }
    }

    #[test]
    fn what_is_no_time_is_refused() {
        let refused = [
            ("", "seconds such as"),
            (".5", "seconds such as"),
            ("5.", "seconds such as"),
            ("-1", "seconds such as"),
            ("+1", "seconds such as"),
            ("1e3", "seconds such as"),
            ("NaN", "seconds such as"),
            ("inf", "seconds such as"),
            ("1,5", "seconds such as"),
            ("1.2.3", "seconds such as"),
            ("\u{661}", "seconds such as"),
            ("0.0001", "three decimals"),
            ("86400.001", "at most 86400"),
            ("4294967296", "at most 86400"),
            ("99999999999999999999999", "at most 86400"),
        ];
        for (text, expected) in refused {
            let error = Seconds::parse(text).unwrap_err();
            assert!(error.contains(expected), "{text}: {error}");
        }
    }
}
