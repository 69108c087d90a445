//! What a function answers, and how it says what is wrong.

use core::ffi::c_char;
use core::fmt;

use adsdv_spec::messages::{DecodeError, OutOfRange};
use adsdv_spec::{Choice, Edition, Reading, UnknownName};

use crate::allowed::Allowed;
use crate::text;

/// The size of the text of an error, with the NUL at its end.
pub const ADSDV_ERROR_TEXT: usize = 508;

/// What a function answers. 0 is success; a function that fails changes nothing but the error, unless its comment says so.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum adsdv_status {
    /// It did what it says.
    ADSDV_OK = 0,
    /// A pointer that must not be NULL is, or one is not aligned as its type must be.
    ADSDV_BAD_POINTER = 1,
    /// A field of a struct, a signal or an argument has a value that it cannot have.
    ADSDV_BAD_VALUE = 2,
    /// There is nothing of that name in the edition: no reading, choice, signal or value.
    ADSDV_UNKNOWN_NAME = 3,
    /// No message of the edition has that identifier.
    ADSDV_UNKNOWN_ID = 4,
    /// A frame has fewer bytes than the signal or the message needs.
    ADSDV_TOO_SHORT = 5,
    /// An array that is to be filled has too few places.
    ADSDV_NO_ROOM = 6,
    /// The judge has finished: it takes no more frames.
    ADSDV_FINISHED = 7,
    /// A mistake in this library. The object concerned can only be freed.
    ADSDV_INTERNAL = 8,
    /// There is no edition of the interface with that version or number.
    ADSDV_UNKNOWN_EDITION = 9,
    /// A text of rules is wrong, or they name what the edition has not.
    ADSDV_BAD_RULES = 10,
}

/// What went wrong, in words. A function writes it when it fails, and leaves it alone otherwise. Wherever a function
/// takes one, NULL may be given instead.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct adsdv_error {
    /// The status that the function answered, an adsdv_status.
    pub status: i32,
    /// What was found and what was expected, such as "inputs.asms is 7; expected 0 or 1". UTF-8, with a NUL at its end.
    pub text: [c_char; ADSDV_ERROR_TEXT],
}

impl Default for adsdv_error {
    fn default() -> Self {
        Self { status: adsdv_status::ADSDV_OK as i32, text: [0; ADSDV_ERROR_TEXT] }
    }
}

impl adsdv_error {
    #[cold]
    pub(crate) fn of(trouble: &Refusal<'_>) -> Self {
        Self { status: trouble.status() as i32, text: text::array(format_args!("{trouble}")) }
    }
}

/// Why a function failed; it displays as the text of the error.
#[derive(Debug)]
pub(crate) enum Refusal<'a> {
    Null(&'static str),
    Misaligned(&'static str),
    /// A field of a struct; of one of many, with its place.
    Value {
        of: &'static str,
        place: Option<usize>,
        field: &'static str,
        given: i64,
        allowed: Allowed,
    },
    /// Bits that are not one choice of each reading.
    Machine {
        readings: u32,
    },
    /// No edition has this number.
    NoEdition {
        of: &'static str,
        given: u32,
    },
    NoVersion(&'a str),
    /// A choice that the edition does not leave.
    NoChoice {
        choice: Choice,
        edition: &'static Edition,
    },
    NotText(&'static str),
    Reading {
        given: &'a str,
        why: UnknownName,
    },
    Twice(Reading),
    NoEnumeration(u32),
    NoSuchValue {
        given: &'a str,
        allowed: Allowed,
    },
    NoSignal {
        given: &'a str,
        message: &'static str,
    },
    NoIndex {
        index: usize,
        count: usize,
    },
    Decode(DecodeError),
    Signal(OutOfRange),
    NoRoom {
        what: &'static str,
        given: usize,
        needed: usize,
    },
    TooMany {
        what: &'static str,
        given: usize,
        most: usize,
    },
    #[cfg(feature = "judge")]
    Finished,
    #[cfg(feature = "judge")]
    Rules(Box<adsdv_oracle::rules::RuleErrors>),
    #[cfg(feature = "std")]
    Internal,
}

impl Refusal<'_> {
    /// The same of a struct that is at a place of an array.
    #[cold]
    pub(crate) fn at(self, number: usize) -> Self {
        match self {
            Self::Value { of, field, given, allowed, .. } => {
                Self::Value { of, place: Some(number), field, given, allowed }
            }
            other => other,
        }
    }

    pub(crate) const fn status(&self) -> adsdv_status {
        match self {
            Self::Null(_) | Self::Misaligned(_) => adsdv_status::ADSDV_BAD_POINTER,
            Self::Value { .. }
            | Self::Machine { .. }
            | Self::NoEnumeration(_)
            | Self::NoIndex { .. }
            | Self::Twice(_)
            | Self::TooMany { .. }
            | Self::Signal(_)
            | Self::Decode(DecodeError::Value(_)) => adsdv_status::ADSDV_BAD_VALUE,
            Self::NotText(_)
            | Self::Reading { .. }
            | Self::NoChoice { .. }
            | Self::NoSuchValue { .. }
            | Self::NoSignal { .. } => adsdv_status::ADSDV_UNKNOWN_NAME,
            Self::NoEdition { .. } | Self::NoVersion(_) => adsdv_status::ADSDV_UNKNOWN_EDITION,
            Self::Decode(DecodeError::UnknownId { .. }) => adsdv_status::ADSDV_UNKNOWN_ID,
            Self::Decode(DecodeError::TooShort { .. }) => adsdv_status::ADSDV_TOO_SHORT,
            Self::NoRoom { .. } => adsdv_status::ADSDV_NO_ROOM,
            #[cfg(feature = "judge")]
            Self::Finished => adsdv_status::ADSDV_FINISHED,
            #[cfg(feature = "judge")]
            Self::Rules(_) => adsdv_status::ADSDV_BAD_RULES,
            #[cfg(feature = "std")]
            Self::Internal => adsdv_status::ADSDV_INTERNAL,
        }
    }
}

impl fmt::Display for Refusal<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Null(name) => write!(f, "{name} is NULL; expected a pointer"),
            Self::Misaligned(name) => write!(f, "{name} is not aligned; expected a pointer to its type"),
            Self::Value { of, place: None, field, given, allowed } => {
                write!(f, "{of}.{field} is {given}; expected {allowed}")
            }
            Self::Value { of, place: Some(place), field, given, allowed } => {
                write!(f, "{of}[{place}].{field} is {given}; expected {allowed}")
            }
            Self::Machine { readings } => write!(
                f,
                "machine.readings is {readings:#x}; expected what adsdv_machine_init wrote: one choice of each reading"
            ),
            Self::NoEdition { of, given } => {
                write!(f, "{of}edition is {given}; expected less than {}", Edition::ALL.len())
            }
            Self::NoVersion(given) => {
                write!(f, "there is no edition {given:?}; expected one of ")?;
                separated(f, ", ", Edition::ALL.iter().map(|edition| edition.version))
            }
            Self::NoChoice { choice, edition } => {
                let (reading, version) = (choice.reading(), edition.version);
                write!(f, "readings: {choice} is no answer in edition {version}; expected {reading}=")?;
                separated(f, " or ", edition.choices.of_reading(reading).map(Choice::id))
            }
            Self::NotText(name) => write!(f, "{name} is not UTF-8; expected text"),
            Self::Reading { given, why } => write!(f, "readings: {given:?}: {why}"),
            Self::Twice(reading) => write!(f, "readings: {reading} is there twice; expected each once"),
            Self::NoEnumeration(given) => {
                write!(f, "enumeration is {given}; expected one of adsdv_enumeration")
            }
            Self::NoSuchValue { given, allowed } => {
                write!(f, "{given:?} is no name of a value; expected {allowed}")
            }
            Self::NoSignal { given, message } => write!(f, "{message} has no signal {given:?}"),
            Self::NoIndex { index, count } => write!(f, "index is {index}; expected less than {count}"),
            Self::Decode(error) => error.fmt(f),
            Self::Signal(error) => error.fmt(f),
            Self::NoRoom { what, given, needed } => {
                write!(f, "{what} has room for {given}; expected {needed}")
            }
            Self::TooMany { what, given, most } => write!(f, "{what} is {given}; expected at most {most}"),
            #[cfg(feature = "judge")]
            Self::Rules(wrong) => {
                write!(f, "rules, {}", wrong.first())?;
                match wrong.iter().count() + wrong.more() {
                    1 => Ok(()),
                    2 => f.write_str(" (and 1 more mistake)"),
                    all => write!(f, " (and {} more mistakes)", all - 1),
                }
            }
            #[cfg(feature = "judge")]
            Self::Finished => f.write_str("the judge has finished; expected a new one for more frames"),
            #[cfg(feature = "std")]
            Self::Internal => {
                f.write_str("a mistake in this library; what it was working on can only be freed")
            }
        }
    }
}

fn separated(
    f: &mut fmt::Formatter<'_>,
    separator: &str,
    texts: impl Iterator<Item = &'static str>,
) -> fmt::Result {
    for (place, text) in texts.enumerate() {
        write!(f, "{}{text}", if place == 0 { "" } else { separator })?;
    }
    Ok(())
}

impl From<DecodeError> for Refusal<'_> {
    fn from(error: DecodeError) -> Self {
        Self::Decode(error)
    }
}

impl From<OutOfRange> for Refusal<'_> {
    fn from(error: OutOfRange) -> Self {
        Self::Signal(error)
    }
}
