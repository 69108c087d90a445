//! A name that stands for nothing: how it is refused. A choice's name has two parts, each of which may do so.

use core::fmt;

use crate::named::separated;
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

/// Reads `reading=choice`.
impl core::str::FromStr for Choice {
    type Err = UnknownName;

    fn from_str(name: &str) -> Result<Self, UnknownName> {
        let (reading, choice) = name.split_once('=').ok_or(UnknownName::Choice)?;
        let reading: Reading = reading.parse()?;
        Self::find(reading.id(), choice).ok_or(UnknownName::ChoiceOf(reading))
    }
}
