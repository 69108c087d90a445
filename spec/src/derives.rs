//! What features and Kani derive for a type, in one line of it.

/// A type whose values are read, written and drawn as its fields are: serde, the generators for tests, and Kani derive that.
///
/// It takes parentheses, within which rustfmt formats the type; between braces it would not.
macro_rules! data {
    ($($item:tt)*) => {
        #[cfg_attr(kani, derive(kani::Arbitrary))]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        #[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
        #[cfg_attr(feature = "proptest", derive(proptest_derive::Arbitrary))]
        $($item)*
    };
}
pub(crate) use data;
