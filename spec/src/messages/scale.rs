//! How a raw integer becomes a number with a unit, exactly: a scale is a fraction, never a float.

use core::fmt;

/// The physical size of one raw step, as the exact fraction `num / den`.
///
/// It displays as the decimal that the CAN database prints.
///
/// ```
/// use adsdv_spec::Edition;
///
/// let scale_of = |id, signal| Some(Edition::V3_0.bus.message(id)?.signal(signal)?.scale.to_string());
/// assert_eq!(scale_of(0x500, "Steer_actual_deg").as_deref(), Some("0.5"));
/// assert_eq!(scale_of(0x501, "Yaw_rate_degps").as_deref(), Some("0.0078125"));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Scale {
    num: u32,
    den: u32,
}

impl Scale {
    /// One raw step is one unit.
    pub const ONE: Self = Self::new(1, 1);

    /// The fraction `num / den`. Only tables call this, when they are compiled.
    pub(crate) const fn new(num: u32, den: u32) -> Self {
        assert!(num > 0 && den > 0, "a scale is a positive fraction");
        Self { num, den }
    }

    /// The numerator; never zero.
    pub const fn num(self) -> u32 {
        self.num
    }

    /// The denominator; never zero.
    pub const fn den(self) -> u32 {
        self.den
    }

    /// A raw value in units, for display and plotting. Nothing in this crate compares the result.
    pub fn physical(self, raw: i32) -> f64 {
        f64::from(raw) * f64::from(self.num) / f64::from(self.den)
    }

    /// The raw value nearest to `physical` units (halves away from zero), saturated to `i64`;
    /// `None` for NaN.
    pub(super) const fn nearest_raw(self, physical: f64) -> Option<i64> {
        if physical.is_nan() {
            return None;
        }
        let steps = physical * self.den as f64 / self.num as f64;
        #[expect(clippy::cast_possible_truncation, reason = "towards zero, and saturating, is what is meant")]
        let whole = steps as i64;
        #[expect(clippy::cast_precision_loss, reason = "exact for every value that has a fractional part")]
        let rest = steps - whole as f64;
        Some(if rest >= 0.5 {
            whole.saturating_add(1)
        } else if rest <= -0.5 {
            whole.saturating_sub(1)
        } else {
            whole
        })
    }
}

impl fmt::Display for Scale {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        Decimal { raw: 1, scale: *self }.fmt(f)
    }
}

/// Displays a raw value in units, as an exact decimal without trailing zeros: raw 125 in steps of 0.1
/// is `12.5`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Decimal {
    /// The raw value.
    pub raw: i32,
    /// The size of one step.
    pub scale: Scale,
}

impl fmt::Display for Decimal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // Enough for any denominator 2^n that fits 32 bits; all others of the table need fewer.
        const MOST_DIGITS: u32 = 31;

        let den = u64::from(self.scale.den);
        let magnitude = u64::from(self.raw.unsigned_abs()) * u64::from(self.scale.num);
        let sign = if self.raw < 0 { "-" } else { "" };
        write!(f, "{sign}{}", magnitude / den)?;
        let mut rest = magnitude % den;
        if rest != 0 {
            f.write_str(".")?;
        }
        for _ in 0..MOST_DIGITS {
            if rest == 0 {
                break;
            }
            rest *= 10;
            write!(f, "{}", rest / den)?;
            rest %= den;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_scale_is_its_fraction() {
        let scale = Scale::new(3, 7);
        assert_eq!((scale.num(), scale.den()), (3, 7));
    }

    #[test]
    fn nearest_rounds_halves_away_from_zero() {
        let half = Scale::new(1, 2);
        assert_eq!(half.nearest_raw(0.24), Some(0));
        assert_eq!(half.nearest_raw(0.25), Some(1));
        assert_eq!(half.nearest_raw(-0.24), Some(0));
        assert_eq!(half.nearest_raw(-0.25), Some(-1));
        assert_eq!(Scale::ONE.nearest_raw(0.499_999_999_999_999_94), Some(0));
        assert_eq!(Scale::new(1, 10).nearest_raw(0.3), Some(3));
        assert_eq!(Scale::new(1, 10).nearest_raw(-19.5), Some(-195));
    }

    #[test]
    fn nearest_saturates_and_knows_nan() {
        assert_eq!(Scale::ONE.nearest_raw(f64::INFINITY), Some(i64::MAX));
        assert_eq!(Scale::ONE.nearest_raw(f64::NEG_INFINITY), Some(i64::MIN));
        assert_eq!(Scale::ONE.nearest_raw(1e300), Some(i64::MAX));
        assert_eq!(Scale::ONE.nearest_raw(-1e300), Some(i64::MIN));
        assert_eq!(Scale::ONE.nearest_raw(f64::NAN), None);
    }
}
