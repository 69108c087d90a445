//! A value in the signal's unit, as exact as its database allows.

use std::io::Write as _;

use adsdv_spec::messages::{Decimal, Scale};

/// A value in the signal's unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Value {
    /// So many steps of a fraction: a signal of the document, exactly.
    Steps {
        /// How many.
        raw: i32,
        /// The fraction.
        scale: Scale,
    },
    /// A whole number.
    Whole(i128),
    /// A float, where the database has one.
    Real(f64),
}

impl Value {
    /// The nearest float.
    pub fn to_f64(self) -> f64 {
        match self {
            Self::Steps { raw, scale } => scale.physical(raw),
            #[expect(clippy::cast_precision_loss, reason = "the nearest is what is asked for")]
            Self::Whole(number) => number as f64,
            Self::Real(number) => number,
        }
    }

    /// Appends it as a number of JSON or of CSV: exact, with a point where it needs one. A float that is no number is `empty`.
    pub(crate) fn put(self, out: &mut Vec<u8>, empty: &[u8]) {
        match self {
            Self::Steps { raw, scale } if scale.den() == 1 => {
                put_integer(out, i64::from(raw) * i64::from(scale.num()));
            }
            // A vector takes everything.
            Self::Steps { raw, scale } => drop(write!(out, "{}", Decimal { raw, scale })),
            Self::Whole(number) => put_whole(out, number),
            Self::Real(number) if number.is_finite() => drop(write!(out, "{number:?}")),
            Self::Real(_) => out.extend_from_slice(empty),
        }
    }
}

/// Appends a whole number.
pub(crate) fn put_whole(out: &mut Vec<u8>, number: i128) {
    match i64::try_from(number) {
        Ok(number) => put_integer(out, number),
        Err(_) => drop(write!(out, "{number}")),
    }
}

/// Appends an integer.
#[inline]
pub(crate) fn put_integer(out: &mut Vec<u8>, number: i64) {
    out.extend_from_slice(itoa::Buffer::new().format(number).as_bytes());
}

/// Writes the steps of one fraction as decimals, fast: prepared once for each signal.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Steps {
    scale: Scale,
    /// A step in units of the last digit, that digit's weight, and its number; `None` where the decimal is very long.
    digits: Option<(u64, u64, usize)>,
}

impl Steps {
    pub(crate) fn new(scale: Scale) -> Self {
        let (num, den) = (u64::from(scale.num()), u64::from(scale.den()));
        let fits = |digits: u32| {
            let weight = 10_u64.checked_pow(digits)?;
            let step = num.checked_mul(weight)?;
            (step % den == 0 && u32::try_from(step / den).is_ok()).then_some((
                step / den,
                weight,
                digits as usize,
            ))
        };
        Self { scale, digits: (0..=9).find_map(fits) }
    }

    /// Appends so many steps as people know it from Python: whole numbers of a scale that is a fraction end in `.0`.
    #[inline]
    pub(crate) fn put(&self, out: &mut Vec<u8>, raw: i32) {
        let Some((step, weight, digits)) = self.digits else {
            let before = out.len();
            // A vector takes everything.
            let _ = write!(out, "{}", Decimal { raw, scale: self.scale });
            if !out.iter().skip(before).any(|&byte| byte == b'.') {
                out.extend_from_slice(b".0");
            }
            return;
        };
        if raw < 0 {
            out.push(b'-');
        }
        let number = u64::from(raw.unsigned_abs()) * step;
        let (whole, rest) = (number / weight, number % weight);
        out.extend_from_slice(itoa::Buffer::new().format(whole).as_bytes());
        if digits == 0 {
            return;
        }
        out.push(b'.');
        if rest == 0 {
            out.push(b'0');
            return;
        }
        let mut buffer = itoa::Buffer::new();
        let text = buffer.format(rest).as_bytes();
        for _ in text.len()..digits {
            out.push(b'0');
        }
        out.extend_from_slice(text);
        while out.pop_if(|digit| *digit == b'0').is_some() {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The scales of every signal that there is, written fast, against how spec writes them.
    #[test]
    fn steps_are_written_as_the_decimals_that_they_are() {
        for edition in adsdv_spec::Edition::ALL {
            let signals = edition.bus.messages.iter().flat_map(|message| message.signals);
            for scale in signals.map(|signal| signal.scale) {
                for raw in [0, 1, -1, 7, 10, -125, 128, 1000, i32::MAX, i32::MIN] {
                    let mut out = Vec::new();
                    Steps::new(scale).put(&mut out, raw);
                    let mut expected = Decimal { raw, scale }.to_string();
                    if scale.den() != 1 && !expected.contains('.') {
                        expected += ".0";
                    }
                    assert_eq!(String::from_utf8(out).expect("digits"), expected);
                }
            }
        }
    }

    #[test]
    fn numbers_are_exact_and_nothing_else_is_a_number() {
        let put = |value: Value| {
            let mut out = Vec::new();
            value.put(&mut out, b"null");
            String::from_utf8(out).expect("digits")
        };
        assert_eq!(put(Value::Whole(i128::from(u64::MAX))), "18446744073709551615");
        assert_eq!(put(Value::Whole(-5)), "-5");
        assert_eq!([0.1, 1e300, -2.0].map(|number| put(Value::Real(number))), ["0.1", "1e300", "-2.0"]);
        assert_eq!([f64::NAN, f64::INFINITY].map(|number| put(Value::Real(number))), ["null", "null"]);
    }
}
