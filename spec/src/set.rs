//! Sets of a few named things, as the bits of an integer: what atoms, faults and choices have in common.

/// Gives `$set`, a newtype over `$bits`, the methods of a set of `$element`s.
///
/// An element has `ALL`, and its discriminant is the number of its bit.
macro_rules! impl_set {
    ($set:ident($bits:ident) of $element:ident, $name:literal) => {
        impl $set {
            #[doc = concat!("No ", $name, ".")]
            pub const NONE: Self = Self(0);
            #[doc = concat!("Every ", $name, ".")]
            pub const ALL: Self = Self::of($element::ALL);

            #[doc = concat!("The set of each ", $name, " given.")]
            pub const fn of(elements: &[$element]) -> Self {
                let mut set = Self::NONE;
                let mut i = 0;
                while i < elements.len() {
                    set = set.with(elements[i]);
                    i += 1;
                }
                set
            }

            #[doc = concat!("The set of this one ", $name, " if `present`, else the empty set.")]
            #[inline]
            pub const fn when(element: $element, present: bool) -> Self {
                Self((present as $bits) << element as u8)
            }

            #[doc = concat!("The set with these bits; `None` if a bit stands for no ", $name, ".")]
            pub const fn from_bits(bits: $bits) -> Option<Self> {
                if bits & !Self::ALL.0 == 0 { Some(Self(bits)) } else { None }
            }

            #[doc = concat!("The bits; the number of a bit is the discriminant of the ", $name, ".")]
            pub const fn bits(self) -> $bits {
                self.0
            }

            #[doc = concat!("Whether this ", $name, " is in the set.")]
            #[inline]
            pub const fn has(self, element: $element) -> bool {
                self.0 >> element as u8 & 1 == 1
            }

            #[doc = concat!("The set with this ", $name, " added.")]
            #[must_use]
            #[inline]
            pub const fn with(self, element: $element) -> Self {
                Self(self.0 | 1 << element as u8)
            }

            #[doc = concat!("The set with this ", $name, " taken out.")]
            #[must_use]
            #[inline]
            pub const fn without(self, element: $element) -> Self {
                Self(self.0 & !(1 << element as u8))
            }

            /// What is in either set.
            #[must_use]
            #[inline]
            pub const fn union(self, other: Self) -> Self {
                Self(self.0 | other.0)
            }

            /// What is in both sets.
            #[must_use]
            #[inline]
            pub const fn intersection(self, other: Self) -> Self {
                Self(self.0 & other.0)
            }

            /// What is in this set and not in the other.
            #[must_use]
            #[inline]
            pub const fn difference(self, other: Self) -> Self {
                Self(self.0 & !other.0)
            }

            /// Whether the other set has all of this one.
            #[inline]
            pub const fn is_subset(self, other: Self) -> bool {
                self.0 & !other.0 == 0
            }

            /// Whether the set is empty.
            #[inline]
            pub const fn is_empty(self) -> bool {
                self.0 == 0
            }

            #[doc = concat!("How many ", $name, "s are in the set.")]
            #[inline]
            pub const fn len(self) -> usize {
                self.0.count_ones() as usize
            }

            #[doc = concat!("Each ", $name, " of the set, in the order of `ALL`.")]
            pub fn iter(self) -> impl Iterator<Item = $element> + Clone {
                $element::ALL.iter().copied().filter(move |&element| self.has(element))
            }
        }

        /// As the names of what is in the set, with a space between them.
        impl core::fmt::Display for $set {
            fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                $crate::named::separated(f, " ", self.iter())
            }
        }

        /// As a list of names: the bits are this crate's own affair.
        #[cfg(feature = "serde")]
        impl serde::Serialize for $set {
            fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                use serde::ser::SerializeSeq;
                // Not as an iterator's items: a filter does not know how many will come, which some formats must.
                let mut names = serializer.serialize_seq(Some(self.len()))?;
                for element in self.iter() {
                    names.serialize_element(&element)?;
                }
                names.end()
            }
        }

        /// From a list of names in any order, none of them twice.
        #[cfg(feature = "serde")]
        impl<'de> serde::Deserialize<'de> for $set {
            fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                use serde::de::{Error, SeqAccess, Visitor};

                struct Names;
                impl<'de> Visitor<'de> for Names {
                    type Value = $set;

                    fn expecting(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                        f.write_str(concat!("a list with the name of each ", $name))
                    }

                    fn visit_seq<A: SeqAccess<'de>>(self, mut names: A) -> Result<$set, A::Error> {
                        let mut set = $set::NONE;
                        while let Some(element) = names.next_element::<$element>()? {
                            if set.has(element) {
                                return Err(A::Error::custom(format_args!("{element} is in the list twice")));
                            }
                            set = set.with(element);
                        }
                        Ok(set)
                    }
                }
                deserializer.deserialize_seq(Names)
            }
        }

        impl From<$set> for $bits {
            fn from(set: $set) -> Self {
                set.0
            }
        }

        impl TryFrom<$bits> for $set {
            type Error = &'static str;

            fn try_from(bits: $bits) -> Result<Self, Self::Error> {
                Self::from_bits(bits).ok_or(concat!("a set of bits, one of which stands for no ", $name))
            }
        }

        #[cfg(kani)]
        impl kani::Arbitrary for $set {
            fn any() -> Self {
                Self(kani::any::<$bits>() & Self::ALL.0)
            }
        }

        #[cfg(feature = "arbitrary")]
        impl arbitrary::Arbitrary<'_> for $set {
            fn arbitrary(u: &mut arbitrary::Unstructured<'_>) -> arbitrary::Result<Self> {
                Ok(Self(u.arbitrary::<$bits>()? & Self::ALL.0))
            }
        }

        #[cfg(feature = "proptest")]
        impl proptest::arbitrary::Arbitrary for $set {
            type Parameters = ();
            type Strategy =
                proptest::strategy::Map<proptest::arbitrary::StrategyFor<$bits>, fn($bits) -> Self>;

            fn arbitrary_with((): ()) -> Self::Strategy {
                use proptest::strategy::Strategy;
                proptest::arbitrary::any::<$bits>().prop_map(|bits| Self(bits & Self::ALL.0))
            }
        }
    };
}

pub(crate) use impl_set;
