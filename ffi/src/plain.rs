//! From plain integers to the specification's types and back: a value that a type cannot have is an error.

use core::hint::assert_unchecked;

use adsdv_spec::messages::SignalValue;

use crate::allowed::Allowed;
use crate::edition::{self, Rows, adsdv_edition};
use crate::error::Refusal;

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
    match (T::from_raw(raw), rows.get(edition::place(edition))) {
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
    Refusal::Value { of, place: None, field, given: raw.into(), allowed: Allowed::of::<T>().on_bus(signal) }
}

/// The value with this number.
///
/// # Safety
///
/// There has to be one.
#[inline(always)]
pub(crate) unsafe fn allowed<T: SignalValue>(raw: impl Into<i32>) -> T {
    let raw = raw.into();
    let value = T::from_raw(raw);
    debug_assert!(value.is_some(), "{raw} was found to be allowed");
    // SAFETY: the caller promises that there is a value, and there is none out of this range.
    unsafe {
        assert_unchecked(T::MIN <= raw && raw <= T::MAX);
        value.unwrap_unchecked()
    }
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
    ($of:literal $plain:ident[$bytes:literal, $words:literal]: $type:ident $body:tt) => {
        impl $plain {
            /// As the specification has it; an error names the field that the edition does not allow.
            #[inline(always)]
            pub(crate) fn read(
                &self,
                edition: crate::edition::adsdv_edition,
            ) -> Result<$type, crate::error::Refusal<'static>> {
                match self.check(edition) {
                    Some(checked) => Ok(checked.read()),
                    None => Err(self.refusal(edition)),
                }
            }

            /// All of it, if the edition allows that; `None` as well where there is no such edition.
            #[inline(always)]
            pub(crate) fn check(
                &self,
                edition: crate::edition::adsdv_edition,
            ) -> Option<crate::limits::Checked<'_, Self>> {
                /// What each edition allows.
                static LIMITS: [crate::limits::Limits<$bytes, $words>; crate::edition::COUNT] = {
                    let mut editions = [crate::limits::Limits::NONE; crate::edition::COUNT];
                    let mut place = 0;
                    while place < editions.len() {
                        let limits = editions[place];
                        crate::plain::conversions!(@limits limits place $plain $type () $body);
                        editions[place] = limits.complete();
                        place += 1;
                    }
                    editions
                };
                LIMITS.get(crate::edition::place(edition))?.check(self)
            }

            /// What is not allowed of it: a field, or there is no such edition.
            #[cold]
            #[inline(never)]
            pub(crate) fn refusal(&self, edition: crate::edition::adsdv_edition) -> crate::error::Refusal<'static> {
                let each = || Ok(crate::plain::conversions!(@read $of self edition $type $body));
                let looked: Result<$type, _> = each();
                looked.err().unwrap_or(crate::error::Refusal::NoEdition { of: "", given: edition })
            }
        }

        impl crate::limits::Checked<'_, $plain> {
            /// As the specification has it.
            #[inline(always)]
            pub(crate) fn read(self) -> $type {
                // SAFETY: a number within its limits is a value of its type: the tests of limits.rs go through all of them.
                unsafe { crate::plain::conversions!(@take self $type $body) }
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
    (@take $from:ident $type:ident
        { $($field:ident $(= $name:ident)? $(: $inner:ident $body:tt)?),* $(,)? }
    ) => {
        $type { $($field: crate::plain::conversions!(@take_field $from $field $(= $name)? $(: $inner $body)?)),* }
    };
    (@take_field $from:ident $field:ident) => { crate::plain::allowed($from.$field) };
    (@take_field $from:ident $field:ident = $name:ident) => { crate::plain::allowed($from.$name) };
    (@take_field $from:ident $field:ident: $inner:ident $body:tt) => {
        crate::plain::conversions!(@take $from $inner $body)
    };
    (@limits $limits:ident $place:ident $plain:ident $type:ident $path:tt
        { $($field:ident $(= $name:ident)? $(: $inner:ident $body:tt)?),* $(,)? }
    ) => {
        $( crate::plain::conversions!(
            @limits_field $limits $place $plain $type $path $field $(= $name)? $(: $inner $body)?
        ); )*
    };
    (@limits_field $limits:ident $place:ident $plain:ident $type:ident $path:tt $field:ident) => {
        crate::plain::conversions!(@limits_field $limits $place $plain $type $path $field = $field)
    };
    (@limits_field $limits:ident $place:ident $plain:ident $type:ident ($($path:tt)*) $field:ident = $name:ident) => {
        let $limits = $limits.with(
            core::mem::offset_of!($plain, $name),
            crate::limits::field(|plain: &$plain| plain.$name),
            crate::limits::range(
                |value: &$type| value$($path)*.$field,
                crate::edition::Rows::of(stringify!($name)),
                $place,
            ),
        );
    };
    (@limits_field $limits:ident $place:ident $plain:ident $type:ident ($($path:tt)*) $field:ident: $inner:ident $body:tt) => {
        crate::plain::conversions!(@limits $limits $place $plain $type ($($path)*.$field) $body)
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
