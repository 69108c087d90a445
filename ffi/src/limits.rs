//! What the numbers of a struct may be in each edition, and all of them compared at once.
//!
//! To ask of each of 57 inputs whether its type and the edition have it takes three times as long as a step. Here they are compared
//! as they lie in memory, bytes with bytes and words with words, which a compiler does with many in one instruction. Which
//! number is wrong is asked only where one is.

use core::ops::{BitOr, Deref};

use adsdv_spec::messages::{SignalDef, SignalValue};

use crate::border::{Numbers, Packed};
use crate::edition::Rows;

/// The lowest value of each number of a struct, and how far above that the highest is.
#[derive(Clone, Copy)]
pub(crate) struct Limits<const BYTES: usize, const WORDS: usize> {
    lowest: Numbers<BYTES, WORDS>,
    range: Numbers<BYTES, WORDS>,
    /// How many numbers have limits.
    bytes: usize,
    words: usize,
}

impl<const BYTES: usize, const WORDS: usize> Limits<BYTES, WORDS> {
    /// No number has any yet.
    pub(crate) const NONE: Self = {
        let zero = Numbers { bytes: [0; BYTES], words: [0; WORDS] };
        Self { lowest: zero, range: zero, bytes: 0, words: 0 }
    };

    /// With those of the number of this type and size that begins at this byte.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "what is cut is asked for, or equal"
    )]
    pub(crate) const fn with(mut self, offset: usize, field: Field, range: Range) -> Self {
        // What the specification can have, the field of C can.
        assert!(field.min <= range.min && range.max <= field.max && range.min <= range.max);
        let width = (range.max - range.min) as u32;
        if field.size == 1 {
            self.lowest.bytes[offset] = range.min as u8;
            self.range.bytes[offset] = width as u8;
            self.bytes += 1;
        } else {
            let place = (offset - BYTES) / 2;
            self.lowest.words[place] = range.min as u16;
            self.range.words[place] = width as u16;
            self.words += 1;
        }
        self
    }

    /// The same; all numbers have theirs.
    pub(crate) const fn complete(self) -> Self {
        assert!(self.bytes == BYTES && self.words == WORDS, "a number has no limits");
        self
    }

    /// A struct whose numbers are within their limits; `None` if one is not.
    #[inline(always)]
    pub(crate) fn check<'a, T: Packed<BYTES, WORDS>>(&self, plain: &'a T) -> Option<Checked<'a, T>> {
        if self.hold(plain.numbers()) { Some(Checked(plain)) } else { None }
    }

    #[inline(always)]
    fn hold(&self, numbers: &Numbers<BYTES, WORDS>) -> bool {
        // What is read of limits that it knows the compiler computes beforehand, for each number alone.
        let Self { lowest, range, .. } = core::hint::black_box(self);
        let bytes =
            within::<_, 16, _>(&numbers.bytes, &lowest.bytes, &range.bytes, |number, lowest, range| {
                number.wrapping_sub(lowest).saturating_sub(range)
            });
        let words =
            within::<_, 8, _>(&numbers.words, &lowest.words, &range.words, |number, lowest, range| {
                number.wrapping_sub(lowest).saturating_sub(range)
            });
        bytes & words
    }
}

/// A struct whose numbers are within limits: each is one that the specification has.
#[derive(Clone, Copy)]
pub(crate) struct Checked<'a, T>(&'a T);

impl<T> Deref for Checked<'_, T> {
    type Target = T;

    #[inline(always)]
    fn deref(&self) -> &T {
        self.0
    }
}

/// Whether no number is above its range: as many at a time as one instruction has, and without a branch for each.
#[inline(always)]
fn within<T: Copy + Default + PartialEq + BitOr<Output = T>, const TOGETHER: usize, const N: usize>(
    numbers: &[T; N],
    lowest: &[T; N],
    range: &[T; N],
    above: impl Fn(T, T, T) -> T,
) -> bool {
    let (numbers, rest_of_numbers) = numbers.as_chunks::<TOGETHER>();
    let (lowest, rest_of_lowest) = lowest.as_chunks::<TOGETHER>();
    let (range, rest_of_range) = range.as_chunks::<TOGETHER>();
    let mut all = [T::default(); TOGETHER];
    for ((numbers, lowest), range) in numbers.iter().zip(lowest).zip(range) {
        for place in 0..TOGETHER {
            all[place] = all[place] | above(numbers[place], lowest[place], range[place]);
        }
    }
    let mut half = TOGETHER / 2;
    while half > 0 {
        for place in 0..half {
            all[place] = all[place] | all[place + half];
        }
        half /= 2;
    }
    let rest = rest_of_numbers.iter().zip(rest_of_lowest).zip(rest_of_range);
    rest.fold(all[0], |all, ((number, lowest), range)| all | above(*number, *lowest, *range)) == T::default()
}

/// The type of a field of C.
#[derive(Clone, Copy)]
pub(crate) struct Field {
    size: usize,
    min: i32,
    max: i32,
}

/// An integer that a field of C can be.
pub(crate) trait Integer {
    const FIELD: Field;
}

macro_rules! integers {
    ($($type:ident),+) => {$(
        impl Integer for $type {
            const FIELD: Field =
                Field { size: size_of::<$type>(), min: $type::MIN as i32, max: $type::MAX as i32 };
        }
    )+};
}

integers!(u8, u16, i16);

/// The type of the field that a function reads.
pub(crate) const fn field<S, C: Integer>(_: fn(&S) -> C) -> Field {
    C::FIELD
}

/// The values of a number: all from `min` to `max`.
#[derive(Clone, Copy)]
pub(crate) struct Range {
    min: i32,
    max: i32,
}

/// The values that the edition at this place leaves to what a function reads, which is a field of this name on the bus.
pub(crate) const fn range<S, T: SignalValue>(_: fn(&S) -> T, rows: Rows, place: usize) -> Range {
    // An enumeration leaves none out, or its numbers cannot be compared.
    assert!(T::VALUES.is_empty() || T::VALUES.len() == T::MAX.abs_diff(T::MIN) as usize + 1);
    match rows.get(place) {
        Some(SignalDef { min, max, .. }) => Range {
            min: if *min > T::MIN { *min } else { T::MIN },
            max: if *max < T::MAX { *max } else { T::MAX },
        },
        None => Range { min: T::MIN, max: T::MAX },
    }
}

#[cfg(test)]
mod tests {
    use adsdv_spec::{Control, Edition, Inputs};

    use super::*;
    use crate::control::adsdv_control;
    use crate::edition::adsdv_edition;
    use crate::error::Refusal;
    use crate::inputs::adsdv_inputs;

    /// With each number of a byte and each of two bytes in turn as any that it can be.
    fn each<T: Packed<BYTES, WORDS>, const BYTES: usize, const WORDS: usize>(
        usual: T,
        mut look: impl FnMut(&T),
    ) {
        let with = |change: &dyn Fn(&mut Numbers<BYTES, WORDS>)| {
            let (mut numbers, mut plain) = (*usual.numbers(), usual);
            change(&mut numbers);
            // SAFETY: a `Packed` struct is these numbers and nothing else.
            unsafe { (&raw mut plain).cast::<Numbers<BYTES, WORDS>>().write(numbers) };
            plain
        };
        for place in 0..BYTES {
            (0..=u8::MAX).for_each(|number| look(&with(&|numbers| numbers.bytes[place] = number)));
        }
        for place in 0..WORDS {
            (0..=u16::MAX).for_each(|number| look(&with(&|numbers| numbers.words[place] = number)));
        }
    }

    macro_rules! test {
        ($name:ident: $plain:ident of $usual:expr) => {
            #[test]
            fn $name() {
                let of_edition = |number: adsdv_edition| {
                    let (mut allowed, mut refused) = (0, 0);
                    each($plain::from(&$usual), |plain: &$plain| {
                        // Field by field there is nothing wrong with it.
                        let right = matches!(plain.refusal(number), Refusal::NoEdition { .. });
                        let checked = plain.check(number);
                        assert_eq!(checked.is_some(), right, "{plain:?}");
                        if let Some(checked) = checked {
                            // Each number is a value, and none is another's.
                            assert_eq!($plain::from(&checked.read()), *plain);
                            allowed += 1;
                        } else {
                            refused += 1;
                        }
                    });
                    assert!(allowed > 1000 && refused > 1000, "{allowed} allowed, {refused} refused");
                };
                std::thread::scope(|scope| {
                    for number in 0..adsdv_edition::try_from(Edition::ALL.len()).unwrap() {
                        scope.spawn(move || of_edition(number));
                    }
                });
                assert!($plain::from(&$usual).check(adsdv_edition::MAX).is_none(), "no such edition");
            }
        };
    }

    test!(of_inputs_just_what_each_field_allows_is_within_limits: adsdv_inputs of Inputs::default());
    test!(of_a_control_state_just_what_each_field_allows_is_within_limits: adsdv_control of Control::INITIAL);
}
