//! Sets of combinations of readings: bit sets, for there are thousands of combinations and the same questions about all.

/// A set of numbers below a length that all sets of one judge have in common.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Set(Box<[u64]>);

impl Set {
    /// No number.
    pub(super) fn none(len: usize) -> Self {
        Self(vec![0; len.div_ceil(64)].into())
    }

    /// Every number below the length.
    pub(super) fn all(len: usize) -> Self {
        let mut set = Self::none(len);
        (0..len).for_each(|member| set.insert(member));
        set
    }

    pub(super) fn insert(&mut self, member: usize) {
        if let Some(word) = self.0.get_mut(member / 64) {
            *word |= 1 << (member % 64);
        }
    }

    pub(super) fn has(&self, member: usize) -> bool {
        self.0.get(member / 64).is_some_and(|word| word >> (member % 64) & 1 == 1)
    }

    pub(super) fn is_empty(&self) -> bool {
        self.0.iter().all(|&word| word == 0)
    }

    pub(super) fn and(&self, other: &Self) -> Self {
        Self(self.0.iter().zip(&other.0).map(|(a, b)| a & b).collect())
    }

    pub(super) fn add(&mut self, other: &Self) {
        self.0.iter_mut().zip(&other.0).for_each(|(a, b)| *a |= b);
    }

    pub(super) fn meets(&self, other: &Self) -> bool {
        self.0.iter().zip(&other.0).any(|(a, b)| a & b != 0)
    }

    /// Each number of the set, from the lowest.
    pub(super) fn iter(&self) -> impl Iterator<Item = usize> + '_ {
        let bits = |(place, &word): (usize, &u64)| {
            let mut left = word;
            std::iter::from_fn(move || {
                let bit = left.trailing_zeros() as usize;
                left &= left.checked_sub(1)?;
                Some(place * 64 + bit)
            })
        };
        self.0.iter().enumerate().flat_map(bits)
    }
}

#[cfg(test)]
mod tests {
    use super::Set;

    #[test]
    fn sets_are_sets() {
        let mut set = Set::none(130);
        assert!(set.is_empty());
        for member in [129, 0, 64] {
            set.insert(member);
        }
        assert_eq!(set.iter().collect::<Vec<_>>(), [0, 64, 129]);
        assert!(set.has(64) && !set.has(63) && !set.has(1000));
        assert_eq!(Set::all(130).iter().count(), 130);
        assert_eq!(Set::all(130).and(&set), set);
        let mut other = Set::none(130);
        other.insert(1);
        assert!(!other.meets(&set));
        other.add(&set);
        assert!(other.meets(&set) && other.iter().count() == 4);
    }
}
