//! What a signal's numbers mean: the link from the type of a field to the columns of the table.

use super::Scale;

/// A type that a signal can carry: a flag, a count, an enumeration or a quantity.
///
/// Every column of [`SignalDef`](super::SignalDef) that does not depend on the message comes from here.
pub trait SignalValue: Copy + Default {
    /// Whether the bits are read as two's complement.
    const SIGNED: bool;
    /// The physical size of one raw step.
    const SCALE: Scale;
    /// The unit as the CAN database writes it, empty where there is none.
    const UNIT: &'static str;
    /// The lowest raw value allowed.
    const MIN: i32;
    /// The highest raw value allowed.
    const MAX: i32;
    /// The values that have names, ascending. An enumeration allows no other value.
    const VALUES: &'static [(i32, &'static str)];

    /// The value with this raw number, or `None` where it is not allowed.
    fn from_raw(raw: i32) -> Option<Self>;

    /// The raw number of this value.
    fn to_raw(self) -> i32;
}

/// A flag: 0 or 1, also where the signal has more bits.
impl SignalValue for bool {
    const SIGNED: bool = false;
    const SCALE: Scale = Scale::ONE;
    const UNIT: &'static str = "";
    const MIN: i32 = 0;
    const MAX: i32 = 1;
    const VALUES: &'static [(i32, &'static str)] = &[];

    #[inline]
    fn from_raw(raw: i32) -> Option<Self> {
        match raw {
            0 => Some(false),
            1 => Some(true),
            _ => None,
        }
    }

    #[inline]
    fn to_raw(self) -> i32 {
        i32::from(self)
    }
}

/// A count that uses every value of its type has no range to keep, so it is that plain type.
macro_rules! plain_counts {
    ($($count:ty),+) => {$(
        impl SignalValue for $count {
            const SIGNED: bool = false;
            const SCALE: Scale = Scale::ONE;
            const UNIT: &'static str = "";
            const MIN: i32 = <$count>::MIN as i32;
            const MAX: i32 = <$count>::MAX as i32;
            const VALUES: &'static [(i32, &'static str)] = &[];

            #[inline]
            fn from_raw(raw: i32) -> Option<Self> {
                <$count>::try_from(raw).ok()
            }

            #[inline]
            fn to_raw(self) -> i32 {
                i32::from(self)
            }
        }
    )+};
}

plain_counts!(u8, u16);

#[cfg(test)]
mod tests {
    use super::SignalValue;

    #[test]
    fn a_flag_is_zero_or_one() {
        assert_eq!([-1, 0, 1, 2].map(bool::from_raw), [None, Some(false), Some(true), None]);
    }
}
