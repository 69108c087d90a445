//! Why data is refused: what was given, and what would have been right.

use core::fmt;

use super::definition::with_unit;
use super::{MessageDef, SignalDef};

/// Data that is not a message of section 2.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum DecodeError {
    /// No message of section 2 has this identifier.
    UnknownId {
        /// The identifier.
        id: u16,
    },
    /// The data ends before the message's last signal does.
    TooShort {
        /// The message's name.
        message: &'static str,
        /// Its identifier.
        id: u16,
        /// The number of bytes given.
        given: usize,
        /// The number of bytes that hold every signal.
        needed: usize,
        /// The first signal that does not fit.
        signal: &'static str,
    },
    /// A signal has a value that the document does not allow.
    Value(ValueError),
}

/// A signal of a message has a value that the document does not allow: outside its range or its
/// enumeration. This is an error of the message's sender, never read as some default.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ValueError {
    /// The message's name.
    pub message: &'static str,
    /// Its identifier.
    pub id: u16,
    /// The signal's name.
    pub signal: &'static str,
    /// The raw value given.
    pub given: i32,
    /// The signal's row: what is allowed.
    pub def: &'static SignalDef,
}

/// A raw value that a signal does not allow, apart from any message; see [`SignalDef::check`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct OutOfRange {
    /// The raw value given.
    pub given: i32,
    /// The signal's row: what is allowed.
    pub def: &'static SignalDef,
}

impl SignalDef {
    /// Refuses a raw value that is not allowed, and says what is.
    ///
    /// # Errors
    ///
    /// Fails if the value is outside the range or the enumeration.
    pub const fn check(&'static self, raw: i32) -> Result<(), OutOfRange> {
        if self.allows(raw) { Ok(()) } else { Err(OutOfRange { given: raw, def: self }) }
    }
}

impl DecodeError {
    /// Data of `given` bytes is too short for this message.
    #[cold]
    pub(crate) fn too_short(message: &'static MessageDef, given: usize) -> Self {
        let mut signals = message.signals.iter();
        let missing = signals.find_map(|signal| (signal.bytes_needed() > given).then_some(signal.name));
        Self::TooShort {
            message: message.name,
            id: message.id,
            given,
            needed: message.bytes_needed(),
            signal: missing.unwrap_or_default(),
        }
    }

    /// A signal of this message must not have this raw value.
    #[cold]
    pub(crate) const fn refused(message: &'static MessageDef, def: &'static SignalDef, given: i32) -> Self {
        Self::Value(ValueError { message: message.name, id: message.id, signal: def.name, given, def })
    }
}

impl From<ValueError> for DecodeError {
    fn from(error: ValueError) -> Self {
        Self::Value(error)
    }
}

impl fmt::Display for DecodeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::UnknownId { id } => write!(f, "{id:03X}h is not the identifier of a message of section 2"),
            Self::TooShort { message, id, given, needed, signal } => write!(
                f,
                "{message} ({id:03X}h) has {given} bytes, needs {needed}: {signal} is the first signal that does not fit"
            ),
            Self::Value(error) => error.fmt(f),
        }
    }
}

impl fmt::Display for ValueError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let refused = OutOfRange { given: self.given, def: self.def };
        write!(f, "{} ({:03X}h): {refused}", self.message, self.id)
    }
}

impl OutOfRange {
    /// What was given, such as `AS_STATE is 7`.
    pub const fn seen(self) -> impl fmt::Display {
        Seen(self)
    }

    /// What is allowed, such as `1 = AS_OFF, 2 = AS_READY`.
    pub const fn allowed(self) -> impl fmt::Display {
        Allowed(self.def)
    }
}

impl fmt::Display for OutOfRange {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}, allowed: {}", self.seen(), self.allowed())
    }
}

/// The part about what was given.
struct Seen(OutOfRange);

impl fmt::Display for Seen {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(OutOfRange { given, def }) = self;
        write!(f, "{} is ", def.name)?;
        if def.values.is_empty() {
            with_unit(f, *given, def.scale, def.unit)?;
            return write!(f, " (raw {given})");
        }
        write!(f, "{given}")
    }
}

/// The part about what is allowed.
struct Allowed(&'static SignalDef);

impl fmt::Display for Allowed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(def) = self;
        if def.values.is_empty() {
            write!(f, "{} to ", super::Decimal { raw: def.min, scale: def.scale })?;
            with_unit(f, def.max, def.scale, def.unit)?;
            return write!(f, " (raw {} to {})", def.min, def.max);
        }
        for (index, (value, name)) in def.values.iter().enumerate() {
            let comma = if index == 0 { "" } else { ", " };
            write!(f, "{comma}{value} = {name}")?;
        }
        Ok(())
    }
}

impl core::error::Error for DecodeError {}
impl core::error::Error for ValueError {}
impl core::error::Error for OutOfRange {}
