//! From plain integers to the specification's types and back: a value that a type cannot have is an error.

use core::fmt;

use adsdv_spec::messages::{Decimal, Scale, SignalDef, SignalValue};

use crate::edition::{self, Rows, adsdv_edition};
use crate::error::Refusal;

/// What a field may be; it displays as in `0 = NEUTRAL, 1 = FORWARD`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Allowed {
    pub(crate) min: i32,
    pub(crate) max: i32,
    pub(crate) values: &'static [(i32, &'static str)],
    scale: Scale,
    unit: &'static str,
}

impl Allowed {
    pub(crate) const fn of<T: SignalValue>() -> Self {
        Self { min: T::MIN, max: T::MAX, values: T::VALUES, scale: T::SCALE, unit: T::UNIT }
    }

    /// What an edition allows of it, where that has a signal for it.
    pub(crate) fn on_bus(self, signal: Option<&SignalDef>) -> Self {
        match signal {
            Some(signal) if self.values.is_empty() => Self { min: signal.min, max: signal.max, ..self },
            Some(signal) if !signal.values.is_empty() => Self { values: signal.values, ..self },
            _ => self,
        }
    }
}

impl fmt::Display for Allowed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (place, (value, name)) in self.values.iter().enumerate() {
            write!(f, "{}{value} = {name}", if place == 0 { "" } else { ", " })?;
        }
        match (self.values, self.min, self.max) {
            ([], 0, 1) => f.write_str("0 or 1"),
            ([], min, max) if self.unit.is_empty() => write!(f, "{min} to {max}"),
            ([], min, max) => {
                let (lowest, highest) =
                    (Decimal { raw: min, scale: self.scale }, Decimal { raw: max, scale: self.scale });
                write!(f, "{min} to {max} ({lowest} to {highest} {})", self.unit)
            }
            _ => Ok(()),
        }
    }
}

/// The value with this number, in the range that the edition gives to the signal of the field, where there is one; `of` and
/// `field` name it for the error.
#[inline(always)]
pub(crate) fn value<T: SignalValue>(
    of: &'static str,
    field: &'static str,
    rows: Rows,
    edition: adsdv_edition,
    raw: impl Into<i32>,
) -> Result<T, Refusal<'static>> {
    let raw = raw.into();
    match (T::from_raw(raw), rows.get(edition)) {
        (Some(_), Some(signal)) if raw < signal.min || raw > signal.max => {
            Err(refused::<T>(of, field, edition, raw))
        }
        (Some(value), _) => Ok(value),
        (None, _) => Err(refused::<T>(of, field, edition, raw)),
    }
}

#[cold]
fn refused<T: SignalValue>(
    of: &'static str,
    field: &'static str,
    edition: adsdv_edition,
    raw: i32,
) -> Refusal<'static> {
    let bus = edition::numbered(edition).map(|edition| &edition.bus);
    let signal = bus.and_then(|bus| bus.signal_of(edition::on_the_bus(field)));
    Refusal::Value { of, field, given: raw.into(), allowed: Allowed::of::<T>().on_bus(signal) }
}

/// The number of a value, in the type that its field has in C. Every value of every field fits: the tests go through
/// them.
#[inline(always)]
pub(crate) fn raw<T: SignalValue, C: TryFrom<i32> + Default>(value: T) -> C {
    C::try_from(value.to_raw()).unwrap_or_default()
}

/// Gives a flat struct of C the way from and to a struct of the specification, which is written down with all its parts.
/// No field of the specification's can be left out: what reads it would not compile. `field = name` is for a field that
/// has another name in C.
macro_rules! conversions {
    ($of:literal $plain:ident: $type:ident $body:tt) => {
        impl $plain {
            /// As the specification has it; an error names the field that the edition does not allow.
            #[inline(always)]
            pub(crate) fn read(
                &self,
                edition: crate::edition::adsdv_edition,
            ) -> Result<$type, crate::error::Refusal<'static>> {
                Ok(crate::plain::conversions!(@read $of self edition $type $body))
            }
        }

        impl From<&$type> for $plain {
            #[inline(always)]
            fn from(value: &$type) -> Self {
                let mut plain = Self::default();
                crate::plain::conversions!(@write plain (value) $body);
                plain
            }
        }
    };
    (@read $of:literal $from:ident $edition:ident $type:ident
        { $($field:ident $(= $name:ident)? $(: $inner:ident $body:tt)?),* $(,)? }
    ) => {
        $type { $($field: crate::plain::conversions!(@read_field $of $from $edition $field $(= $name)? $(: $inner $body)?)),* }
    };
    (@read_field $of:literal $from:ident $edition:ident $field:ident) => {
        crate::plain::value(
            $of,
            stringify!($field),
            const { crate::edition::Rows::of(stringify!($field)) },
            $edition,
            $from.$field,
        )?
    };
    (@read_field $of:literal $from:ident $edition:ident $field:ident = $name:ident) => {
        crate::plain::value(
            $of,
            stringify!($name),
            const { crate::edition::Rows::of(stringify!($name)) },
            $edition,
            $from.$name,
        )?
    };
    (@read_field $of:literal $from:ident $edition:ident $field:ident: $inner:ident $body:tt) => {
        crate::plain::conversions!(@read $of $from $edition $inner $body)
    };
    (@write $to:ident $path:tt { $($field:ident $(= $name:ident)? $(: $inner:ident $body:tt)?),* $(,)? }) => {
        $( crate::plain::conversions!(@write_field $to $path $field $(= $name)? $(: $inner $body)?); )*
    };
    (@write_field $to:ident ($($path:tt)+) $field:ident) => {
        $to.$field = crate::plain::raw($($path)+.$field)
    };
    (@write_field $to:ident ($($path:tt)+) $field:ident = $name:ident) => {
        $to.$name = crate::plain::raw($($path)+.$field)
    };
    (@write_field $to:ident ($($path:tt)+) $field:ident: $inner:ident $body:tt) => {
        crate::plain::conversions!(@write $to ($($path)+.$field) $body)
    };
}

pub(crate) use conversions;
