//! Raw values as plain numbers: what is compared millions of times.

/// The raw values of so many outputs, in their order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Values<const COUNT: usize> {
    /// 0 where there is none, so that what is equal is equal number by number.
    numbers: [i32; COUNT],
    /// A bit for each that there is.
    there: u64,
}

impl<const COUNT: usize> Values<COUNT> {
    /// None of them. Each has a bit: more do not compile.
    pub(super) const NONE: Self = {
        assert!(COUNT <= u64::BITS as usize);
        Self { numbers: [0; COUNT], there: 0 }
    };

    /// These numbers, those whose bit is set.
    pub(super) fn of(numbers: [i32; COUNT], there: u64) -> Self {
        let mut values = Self { numbers, there };
        for (place, number) in values.numbers.iter_mut().enumerate() {
            // Branchless, so that many are done at a time.
            *number &= 0_i32.wrapping_sub((there >> place & 1) as i32);
        }
        values
    }

    /// The value at this place; `None` if there is none.
    pub fn at(&self, place: usize) -> Option<i32> {
        self.numbers.get(place).copied().filter(|_| self.there >> place & 1 == 1)
    }

    /// The same with another value at this place, for a state machine that shows it wrongly.
    #[must_use]
    pub const fn with(mut self, place: usize, raw: i32) -> Self {
        if place < COUNT {
            self.numbers[place] = raw;
            self.there |= 1 << place;
        }
        self
    }

    /// Those of these places alone, a bit for each.
    pub(super) fn among(&self, places: u64) -> Self {
        Self::of(self.numbers, self.there & places)
    }

    /// A bit for each place at which the values differ.
    #[inline]
    pub(super) fn differing(&self, other: &Self) -> u64 {
        // Most often they are all the same, which is one look.
        if self == other {
            return 0;
        }
        let numbers = self.numbers.iter().zip(&other.numbers).enumerate();
        numbers.fold(self.there ^ other.there, |bits, (place, (own, other))| {
            bits | u64::from(own != other) << place
        })
    }

    /// A bit for each that there is.
    pub(super) const fn there(&self) -> u64 {
        self.there
    }

    /// Each of them, in order.
    pub(super) fn iter(self) -> impl Iterator<Item = Option<i32>> {
        (0..COUNT).map(move |place| self.at(place))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_differ_in_a_number_or_in_that_there_is_one() {
        let one = Values::of([1, 2, 3], 0b101);
        assert_eq!([0, 1, 2, 3].map(|place| one.at(place)), [Some(1), None, Some(3), None]);
        assert_eq!(one.iter().collect::<Vec<_>>(), [Some(1), None, Some(3)]);
        assert_eq!(one, Values::of([1, 99, 3], 0b101), "what is not there is no number");
        assert_eq!(one.differing(&one), 0);
        assert_eq!(one.differing(&one.with(2, 4)), 0b100);
        assert_eq!(one.differing(&one.with(1, 0)), 0b010, "a 0 that is there");
        assert_eq!(one.differing(&one.with(1, 5)), 0b010);
        assert_eq!(one.with(3, 7), one, "there is no such place");
        assert_eq!(one.among(0b110), Values::NONE.with(2, 3));
        assert_eq!(one.among(0b110).there(), 0b100);
    }
}
