//! Lines that say nothing in the protocol, and how a line is taken apart.

use std::borrow::Cow;
use std::fmt;

use serde::Deserialize;
use serde::de::{Deserializer, MapAccess, Visitor};

/// Why a line is not what was expected: what was found, and what would have been right.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BadLine(String);

impl BadLine {
    pub(super) fn new(text: impl Into<String>) -> Self {
        Self(text.into())
    }

    /// A key that is there more than once.
    pub(super) fn twice(key: &str) -> Self {
        Self(format!("{key:?} is there twice; expected each key once"))
    }

    /// A key that there is not.
    pub(super) fn unknown<'a>(key: &str, expected: impl Iterator<Item = &'a str>) -> Self {
        let expected: Vec<&str> = expected.collect();
        Self(format!("there is no key {key:?}; expected one of {}", expected.join(", ")))
    }

    /// A value that a key cannot have.
    pub(super) fn value(key: &str, found: &Given<'_>, expected: impl fmt::Display) -> Self {
        Self(format!("{key:?} is {found}; expected {expected}"))
    }
}

impl fmt::Display for BadLine {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for BadLine {}

/// No list of the protocol is longer.
const LONGEST_LIST: usize = 128;

/// A value of JSON, as far as the protocol has any.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Given<'a> {
    Null,
    Flag(bool),
    Number(i64),
    /// A number that is not written as a whole one, or too large for that.
    Float(f64),
    Text(Cow<'a, str>),
    /// A list of texts.
    List(Vec<String>),
    /// Another list or an object.
    Other(&'static str),
}

impl fmt::Display for Given<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Null => f.write_str("null"),
            Self::Flag(flag) => write!(f, "{flag}"),
            Self::Number(number) => write!(f, "{number}"),
            // Whole numbers are read as such up to here.
            Self::Float(number) if number.abs() >= 2_f64.powi(63) => {
                write!(f, "{number:?}, which is too large")
            }
            Self::Float(number) => write!(f, "{number:?}, which has a point or an exponent"),
            Self::Text(text) => write!(f, "{text:?}"),
            Self::List(_) => f.write_str("a list"),
            Self::Other(what) => f.write_str(what),
        }
    }
}

impl<'de> Deserialize<'de> for Given<'de> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Any;
        impl<'de> Visitor<'de> for Any {
            type Value = Given<'de>;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a value")
            }

            fn visit_unit<E>(self) -> Result<Given<'de>, E> {
                Ok(Given::Null)
            }

            fn visit_bool<E>(self, flag: bool) -> Result<Given<'de>, E> {
                Ok(Given::Flag(flag))
            }

            fn visit_i64<E>(self, number: i64) -> Result<Given<'de>, E> {
                Ok(Given::Number(number))
            }

            fn visit_u64<E>(self, number: u64) -> Result<Given<'de>, E> {
                Ok(i64::try_from(number).map_or(Given::Other("a number that is too large"), Given::Number))
            }

            fn visit_f64<E>(self, number: f64) -> Result<Given<'de>, E> {
                Ok(Given::Float(number))
            }

            fn visit_borrowed_str<E>(self, text: &'de str) -> Result<Given<'de>, E> {
                Ok(Given::Text(Cow::Borrowed(text)))
            }

            fn visit_str<E>(self, text: &str) -> Result<Given<'de>, E> {
                Ok(Given::Text(Cow::Owned(text.to_owned())))
            }

            fn visit_seq<A: serde::de::SeqAccess<'de>>(self, mut list: A) -> Result<Given<'de>, A::Error> {
                let (mut texts, mut others) = (Vec::new(), false);
                while let Some(one) = list.next_element::<Given<'de>>()? {
                    match one {
                        Given::Text(text) if texts.len() < LONGEST_LIST => texts.push(text.into_owned()),
                        _ => others = true,
                    }
                }
                Ok(if others { Given::Other("a list") } else { Given::List(texts) })
            }

            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Given<'de>, A::Error> {
                while map.next_entry::<serde::de::IgnoredAny, serde::de::IgnoredAny>()?.is_some() {}
                Ok(Given::Other("an object"))
            }
        }
        deserializer.deserialize_any(Any)
    }
}

/// A line as the keys and values of its object, in order.
pub(super) struct Object<'a>(pub(super) Vec<(Cow<'a, str>, Given<'a>)>);

impl<'a> Object<'a> {
    /// Takes a line apart.
    pub(super) fn read(line: &'a str) -> Result<Self, BadLine> {
        serde_json::from_str(line).map_err(|error| {
            BadLine::new(format!("{}: {error}; expected a JSON object on one line", excerpt(line)))
        })
    }
}

impl<'de> Deserialize<'de> for Object<'de> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Entries;
        impl<'de> Visitor<'de> for Entries {
            type Value = Object<'de>;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a JSON object")
            }

            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Object<'de>, A::Error> {
                let mut entries = Vec::with_capacity(32);
                while let Some(Given::Text(key)) = map.next_key()? {
                    entries.push((key, map.next_value()?));
                }
                Ok(Object(entries))
            }
        }
        deserializer.deserialize_map(Entries)
    }
}

/// As much of a line as an error shows.
pub(super) fn excerpt(line: &str) -> String {
    const SHOWN: usize = 60;
    match line.char_indices().nth(SHOWN) {
        Some((end, _)) => format!("{:?}...", &line[..end]),
        None => format!("{line:?}"),
    }
}
