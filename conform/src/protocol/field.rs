//! What the fields of the protocol have in common: a key, and the values that it may have.

use std::fmt;
use std::hash::{Hash, Hasher};

use adsdv_spec::Bus;
use adsdv_spec::messages::SignalValue;

use super::bad_line::Given;
use super::foreign;

/// The values of a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Domain {
    /// `true` or `false`; 1 or 0 is understood as well.
    Flag,
    /// One of these names; its number is understood as well.
    Names(&'static [(i32, &'static str)]),
    /// A whole number: raw, in steps of the signal, as it is on the bus.
    Number {
        /// The lowest.
        min: i32,
        /// The highest.
        max: i32,
    },
}

impl Domain {
    /// The same, but with the range or the names that a bus gives to the signal of this field, where there is one.
    pub(super) const fn on_bus(self, field: &str, bus: &Bus) -> Self {
        if let Self::Flag = self {
            return self;
        }
        match (self, bus.signal_of(field)) {
            (Self::Number { .. }, Some(signal)) => Self::Number { min: signal.min, max: signal.max },
            (Self::Names(_), Some(signal)) if !signal.values.is_empty() => Self::Names(signal.values),
            _ => self,
        }
    }

    /// The values of a type.
    pub(super) const fn of<T: SignalValue>() -> Self {
        if !T::VALUES.is_empty() {
            Self::Names(T::VALUES)
        } else if T::MIN == 0 && T::MAX == 1 {
            Self::Flag
        } else {
            Self::Number { min: T::MIN, max: T::MAX }
        }
    }

    /// The raw number of a value that was read; `None` if it is none of this field's.
    pub(super) fn raw(self, read: &Given<'_>) -> Option<i32> {
        let number = match (self, read) {
            (Self::Flag, Given::Flag(flag)) => Some(i64::from(*flag)),
            (Self::Names(names), Given::Text(text)) => {
                names.iter().find(|(_, name)| is_spelt(name, text)).map(|&(raw, _)| raw.into())
            }
            (_, Given::Number(number)) => Some(*number),
            _ => None,
        };
        number.and_then(|raw| i32::try_from(raw).ok()).filter(|&raw| self.has(raw))
    }

    /// The same, and where it is none, that of another edition's name for one of them.
    pub(super) fn raw_or(self, other: Self, read: &Given<'_>) -> Option<i32> {
        self.raw(read).or_else(|| other.raw(read).filter(|&raw| self.has(raw)))
    }

    /// The number of a value of the right kind that is none of these: a number, or a name.
    pub(super) fn foreign(self, read: &Given<'_>) -> Option<i32> {
        match (self, read) {
            (Self::Names(_) | Self::Number { .. }, Given::Number(number)) => i32::try_from(*number).ok(),
            (Self::Names(_), Given::Text(name)) => foreign::number(name),
            _ => None,
        }
    }

    /// Whether it has this raw value.
    pub fn has(self, raw: i32) -> bool {
        match self {
            Self::Flag => raw == 0 || raw == 1,
            Self::Names(names) => names.iter().any(|&(value, _)| value == raw),
            Self::Number { min, max } => (min..=max).contains(&raw),
        }
    }
}

/// Whether a name is this one: the documents write some names with spaces and some with underscores, and some with both.
fn is_spelt(name: &str, text: &str) -> bool {
    let plain = |byte: u8| if byte == b' ' { b'_' } else { byte };
    name.len() == text.len() && name.bytes().map(plain).eq(text.bytes().map(plain))
}

/// The bus in whose words values are written. It is no part of what they are: what is equal in numbers is equal.
#[derive(Clone, Copy, Debug)]
pub(super) struct Words(pub(super) Bus);

impl PartialEq for Words {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Eq for Words {}

impl Hash for Words {
    fn hash<H: Hasher>(&self, _: &mut H) {}
}

/// What is expected of a field, in words.
impl fmt::Display for Domain {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Flag => f.write_str("true or false"),
            Self::Names(names) => {
                f.write_str("one of ")?;
                for (place, (raw, name)) in names.iter().enumerate() {
                    write!(f, "{}{name:?} ({raw})", if place == 0 { "" } else { ", " })?;
                }
                Ok(())
            }
            Self::Number { min, max } => write!(f, "a whole number from {min} to {max}"),
        }
    }
}

/// A value of a field, for display: by its name where it has one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Value {
    /// The values of its field.
    pub domain: Domain,
    /// The raw number; `None`: there is none at present.
    pub raw: Option<i32>,
}

impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some(raw) = self.raw else { return f.write_str("null") };
        match self.domain {
            Domain::Flag => write!(f, "{}", raw != 0),
            Domain::Names(names) => match names.iter().find(|&&(value, _)| value == raw) {
                Some((_, name)) => f.write_str(name),
                None => match foreign::name(raw) {
                    // It is the program's word: nothing in it may do anything to a terminal.
                    Some(name) => write!(f, "{}", name.escape_debug()),
                    None => write!(f, "{raw}"),
                },
            },
            Domain::Number { .. } => write!(f, "{raw}"),
        }
    }
}

impl Value {
    /// The value as JSON.
    pub(super) fn write_json(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.domain {
            // No name has anything in it that JSON would have escaped: a test holds them to that.
            Domain::Names(_) if self.raw.is_some_and(|raw| self.domain.has(raw)) => write!(f, "\"{self}\""),
            _ => write!(f, "{self}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Json(Value);

    impl fmt::Display for Json {
        fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            self.0.write_json(f)
        }
    }

    #[test]
    fn a_name_is_read_with_spaces_and_with_underscores() {
        let names = Domain::Names(&[(0, "NO SHUTDOWN"), (1, "EBS_FAULT")]);
        let read = |text: &str| names.raw(&Given::Text(text.into()));
        assert_eq!(["NO SHUTDOWN", "NO_SHUTDOWN"].map(read), [Some(0); 2]);
        assert_eq!(["EBS_FAULT", "EBS FAULT"].map(read), [Some(1); 2]);
        assert_eq!(["NO-SHUTDOWN", "NO SHUTDOW", "EBS  FAULT", ""].map(read), [None; 4]);
    }

    #[test]
    fn names_are_texts_and_what_is_not_there_is_null() {
        let json = |domain, raw| Json(Value { domain, raw }).to_string();
        let names = Domain::Names(&[(1, "AS_OFF")]);
        assert_eq!([json(names, Some(1)), json(names, None)], ["\"AS_OFF\"", "null"]);
        let number = Domain::Number { min: -9, max: 9 };
        assert_eq!([json(number, Some(-7)), json(number, None)], ["-7", "null"]);
        assert_eq!([json(Domain::Flag, Some(1)), json(Domain::Flag, Some(0))], ["true", "false"]);
    }
}
