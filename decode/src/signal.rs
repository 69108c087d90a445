//! A signal: where it is, what its numbers mean, and what they are called.

use std::ops::RangeInclusive;

use adsdv_spec::messages::Scale;

use crate::{Coding, Place, Value};

/// What a raw number is in the signal's unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Scaling {
    /// Exactly so many steps of a fraction: the signals of the document.
    Steps(Scale),
    /// Times a whole number and plus another.
    Whole {
        /// Times this.
        factor: i64,
        /// And plus this.
        offset: i64,
    },
    /// Times a number and plus another, as floats.
    Linear {
        /// Times this.
        factor: f64,
        /// And plus this.
        offset: f64,
    },
}

impl Scaling {
    /// From the floats that a database has: whole numbers where they are, so that no digit is lost.
    pub(crate) fn of(factor: f64, offset: f64) -> Self {
        match (whole(factor), whole(offset)) {
            (Some(factor), Some(offset)) => Self::Whole { factor, offset },
            _ => Self::Linear { factor, offset },
        }
    }
}

/// A float that is a whole number, and not so large that its neighbours are none.
fn whole(number: f64) -> Option<i64> {
    const EXACT: f64 = 9_007_199_254_740_992.0;
    #[expect(clippy::cast_possible_truncation, reason = "it is whole, and not so large")]
    (number.fract() == 0.0 && number.abs() <= EXACT).then_some(number as i64)
}

/// When a signal is in a frame: only if another one, its multiplexer, has one of these values.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Multiplexed {
    /// The place of the multiplexer among the message's signals.
    pub by: usize,
    /// Its values.
    pub values: Box<[RangeInclusive<u64>]>,
}

/// A signal of a message.
#[derive(Clone, Debug, PartialEq)]
pub struct Signal {
    /// The name, as in the CAN database.
    pub name: Box<str>,
    /// The unit, empty where there is none.
    pub unit: Box<str>,
    /// Where its bits are.
    pub place: Place,
    /// What its numbers are in that unit.
    pub scaling: Scaling,
    /// The raw values that have names, ascending.
    pub names: Box<[(i64, Box<str>)]>,
    /// When it is there; `None` for always.
    pub multiplexed: Option<Multiplexed>,
    /// What it says; empty where nobody has written that down.
    pub doc: Box<str>,
}

impl Signal {
    /// The value of these bits.
    pub fn value(&self, bits: u64) -> Value {
        if self.place.coding() == Coding::Float {
            let (factor, offset) = match self.scaling {
                Scaling::Linear { factor, offset } => (factor, offset),
                #[expect(clippy::cast_precision_loss, reason = "they were floats")]
                Scaling::Whole { factor, offset } => (factor as f64, offset as f64),
                Scaling::Steps(scale) => (scale.physical(1), 0.0),
            };
            return Value::Real(self.float(bits) * factor + offset);
        }
        let raw = self.place.raw(bits);
        match (self.scaling, i32::try_from(raw)) {
            (Scaling::Steps(scale), Ok(raw)) => Value::Steps { raw, scale },
            (Scaling::Whole { factor, offset }, _) => {
                Value::Whole(raw * i128::from(factor) + i128::from(offset))
            }
            #[expect(clippy::cast_precision_loss, reason = "a float is what the database asks for")]
            (Scaling::Linear { factor, offset }, _) => Value::Real(raw as f64 * factor + offset),
            #[expect(clippy::cast_precision_loss, reason = "wider than any signal of the document")]
            (Scaling::Steps(scale), Err(_)) => Value::Real(raw as f64 * scale.physical(1)),
        }
    }

    fn float(&self, bits: u64) -> f64 {
        if self.place.width() == 64 {
            return f64::from_bits(bits);
        }
        #[expect(clippy::cast_possible_truncation, reason = "it has 32 bits")]
        f64::from(f32::from_bits(bits as u32))
    }

    /// The name of the value of these bits, where it has one.
    pub fn value_name(&self, bits: u64) -> Option<&str> {
        self.names.get(self.name_place(bits)?).map(|(_, name)| &**name)
    }

    /// The place of that among the names.
    pub(crate) fn name_place(&self, bits: u64) -> Option<usize> {
        if self.names.is_empty() || self.place.coding() == Coding::Float {
            return None;
        }
        let raw = i64::try_from(self.place.raw(bits)).ok()?;
        self.names.binary_search_by_key(&raw, |(raw, _)| *raw).ok()
    }

    /// Whether its values are whole numbers.
    pub fn is_whole(&self) -> bool {
        let by_scale = match self.scaling {
            Scaling::Steps(scale) => scale.den() == 1,
            Scaling::Whole { .. } => true,
            Scaling::Linear { .. } => false,
        };
        by_scale && self.place.coding() != Coding::Float
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Order;

    fn signal(coding: Coding, width: u32, scaling: Scaling) -> Signal {
        Signal {
            name: "S".into(),
            unit: "".into(),
            place: Place::new(0, width, Order::Little, coding).expect("bits of a frame"),
            scaling,
            names: [(-1, "minus".into()), (3, "three".into())].into(),
            multiplexed: None,
            doc: "".into(),
        }
    }

    #[test]
    fn a_value_is_exact_where_it_can_be() {
        let largest = signal(Coding::Unsigned, 64, Scaling::of(3.0, -1.0));
        assert_eq!(largest.value(u64::MAX), Value::Whole(3 * i128::from(u64::MAX) - 1));
        assert!(largest.is_whole());
        let half = signal(Coding::Signed, 8, Scaling::of(0.5, 1.0));
        assert_eq!((half.value(0xFF), half.is_whole()), (Value::Real(0.5), false));
        assert_eq!(Scaling::of(1e300, 0.0), Scaling::Linear { factor: 1e300, offset: 0.0 });
        assert!(matches!(Scaling::of(f64::NAN, 0.0), Scaling::Linear { .. }));
    }

    #[test]
    fn floats_have_both_widths() {
        let single = signal(Coding::Float, 32, Scaling::of(2.0, 1.0));
        assert_eq!(single.value(1.5_f32.to_bits().into()), Value::Real(4.0));
        let double = signal(Coding::Float, 64, Scaling::of(1.0, 0.0));
        assert_eq!(double.value(0.1_f64.to_bits()), Value::Real(0.1));
        assert_eq!(double.value_name(3), None, "the bits of a float are no number");
    }

    #[test]
    fn a_name_is_that_of_the_raw_value() {
        let named = signal(Coding::Signed, 8, Scaling::of(2.0, 0.0));
        assert_eq!([0xFF, 3, 4].map(|bits| named.value_name(bits)), [Some("minus"), Some("three"), None]);
        let unsigned = signal(Coding::Unsigned, 64, Scaling::of(1.0, 0.0));
        assert_eq!(unsigned.value_name(u64::MAX), None);
    }
}
