//! Things that are known by a stable name: how a name is written, read back, and refused.

use core::fmt;

use crate::{Atom, Choice, Fault, Reading};

/// A name that stands for nothing of its kind; it displays what would have been right.
///
/// The name itself is not in it: the caller still has it.
///
/// ```
/// use adsdv_spec::Choice;
/// assert_eq!("fault-trigger=edge".parse(), Ok(Choice::FaultEdge));
/// assert_eq!(
///     "fault-trigger=slope".parse::<Choice>().unwrap_err().to_string(),
///     "no such choice of fault-trigger; expected one of level, edge",
/// );
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum UnknownName {
    /// No [`Atom`] has this id.
    Atom,
    /// No [`Fault`]'s flag has this name.
    Fault,
    /// No [`Reading`] has this id.
    Reading,
    /// What should be a [`Choice`] is not of the form `reading=choice`.
    Choice,
    /// The reading has no choice of this id.
    ChoiceOf(Reading),
}

impl fmt::Display for UnknownName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Atom => write!(f, "no such atom; expected one of ")?,
            Self::Fault => write!(f, "no such fault; expected one of ")?,
            Self::Reading => write!(f, "no such reading; expected one of ")?,
            Self::Choice => write!(f, "expected reading=choice, such as {}; readings: ", Choice::FaultEdge)?,
            Self::ChoiceOf(reading) => write!(f, "no such choice of {reading}; expected one of ")?,
        }
        match self {
            Self::Atom => separated(f, ", ", Atom::ALL.iter()),
            Self::Fault => separated(f, ", ", Fault::ALL.iter()),
            Self::Reading | Self::Choice => separated(f, ", ", Reading::ALL.iter()),
            Self::ChoiceOf(reading) => separated(f, ", ", reading.choices().iter().map(|choice| choice.id())),
        }
    }
}

impl core::error::Error for UnknownName {}

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
