//! Things that are known by a stable name: how a name is written and read back.

use core::fmt;

/// Writes each thing, with the separator between them.
pub(crate) fn separated<T: fmt::Display>(
    f: &mut fmt::Formatter<'_>,
    separator: &str,
    things: impl Iterator<Item = T>,
) -> fmt::Result {
    for (place, thing) in things.enumerate() {
        if place > 0 {
            f.write_str(separator)?;
        }
        write!(f, "{thing}")?;
    }
    Ok(())
}

/// Lets `$type`, which displays as its name and is read from it, be serialised as that name; and generates it.
macro_rules! impl_named {
    ($type:ident, $a_name:literal) => {
        #[cfg(feature = "serde")]
        impl serde::Serialize for $type {
            fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                serializer.collect_str(self)
            }
        }

        #[cfg(feature = "serde")]
        impl<'de> serde::Deserialize<'de> for $type {
            fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                struct Name;
                impl serde::de::Visitor<'_> for Name {
                    type Value = $type;

                    fn expecting(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                        f.write_str($a_name)
                    }

                    fn visit_str<E: serde::de::Error>(self, name: &str) -> Result<$type, E> {
                        name.parse().map_err(|unknown: $crate::UnknownName| {
                            E::custom(format_args!("{name:?}: {unknown}"))
                        })
                    }
                }
                deserializer.deserialize_str(Name)
            }
        }

        #[cfg(feature = "proptest")]
        impl proptest::arbitrary::Arbitrary for $type {
            type Parameters = ();
            type Strategy = proptest::sample::Select<Self>;

            fn arbitrary_with((): ()) -> Self::Strategy {
                proptest::sample::select(Self::ALL)
            }
        }
    };
}

/// Reads `$type` from its name, which `$name` gives.
macro_rules! impl_find {
    ($type:ident by $name:ident, $example:literal) => {
        impl $type {
            #[doc = concat!("The one with this name, such as `", $example, "`; `None` if there is none.")]
            pub fn find(name: &str) -> Option<Self> {
                Self::ALL.iter().copied().find(|one| one.$name() == name)
            }
        }

        impl core::str::FromStr for $type {
            type Err = $crate::UnknownName;

            fn from_str(name: &str) -> Result<Self, Self::Err> {
                Self::find(name).ok_or($crate::UnknownName::$type)
            }
        }
    };
}

pub(crate) use {impl_find, impl_named};
