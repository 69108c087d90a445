//! Columns: times, counts, and text wrapped to a width.

use std::fmt;

/// A time in nanoseconds, as seconds with three decimals.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Seconds(pub(crate) i64);

impl fmt::Display for Seconds {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ms = self.0.max(0).saturating_add(500_000) / 1_000_000;
        f.pad_integral(true, "", &format!("{}.{:03}", ms / 1000, ms % 1000))
    }
}

/// A number and its noun, in the plural where it has to be.
pub(crate) fn counted(count: u64, noun: &str) -> String {
    let plural = if count == 1 { "" } else { "s" };
    format!("{count} {noun}{plural}")
}

/// Writes words, or other pieces of text that are to stay whole, in indented lines of at most `width` columns. A
/// longer piece gets a line of its own.
pub(crate) fn wrapped<T: AsRef<str>>(
    out: &mut String,
    pieces: impl IntoIterator<Item = T>,
    indent: usize,
    width: usize,
) {
    let room = width.saturating_sub(indent);
    let mut used = None;
    for piece in pieces {
        let word = piece.as_ref();
        let length = word.chars().count();
        match used {
            Some(column) if column + 1 + length <= room => {
                out.push(' ');
                used = Some(column + 1 + length);
            }
            _ => {
                if used.is_some() {
                    out.push('\n');
                }
                out.extend(std::iter::repeat_n(' ', indent));
                used = Some(length);
            }
        }
        out.push_str(word);
    }
    out.push('\n');
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_have_three_decimals_and_are_padded() {
        assert_eq!(format!("{:>10}|", Seconds(13_015_499_999)), "    13.015|");
        assert_eq!(Seconds(999_999_999).to_string(), "1.000");
        assert_eq!(Seconds(0).to_string(), "0.000");
        assert!(Seconds(i64::MAX).to_string().starts_with("9223372036."));
    }

    #[test]
    fn text_is_wrapped_at_words() {
        let mut out = String::new();
        wrapped(&mut out, "one two three four-is-longer-than-that five".split(' '), 4, 4 + 9);
        let lines: Vec<_> = out.lines().map(str::trim_start).collect();
        assert_eq!(lines, ["one two", "three", "four-is-longer-than-that", "five"]);
        assert!(out.lines().all(|line| line.starts_with("    ")));
    }

    #[test]
    fn one_is_singular() {
        assert_eq!([0, 1, 2].map(|count| counted(count, "note")), ["0 notes", "1 note", "2 notes"]);
    }
}
