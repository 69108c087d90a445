//! Answers as data: a map of reading to choice.

use core::fmt;

use crate::UnknownName;
use crate::readings::{Choice, Choices, Reading, Readings};

/// As a map of reading to choice, every reading in it.
impl serde::Serialize for Readings {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        // Not as an iterator's items: a filter does not know how many will come, which some formats must.
        let mut map = serializer.serialize_map(Some(Reading::ALL.len()))?;
        for &reading in Reading::ALL {
            serde::ser::SerializeMap::serialize_entry(&mut map, &reading, self.choice(reading).id())?;
        }
        serde::ser::SerializeMap::end(map)
    }
}

/// From a map of reading to choice, each reading at most once; those that are not in it are the default.
impl<'de> serde::Deserialize<'de> for Readings {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        use serde::de::Error as _;

        struct Visitor;
        impl<'de> serde::de::Visitor<'de> for Visitor {
            type Value = Readings;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a map of reading to choice, such as {\"fault-trigger\": \"edge\"}")
            }

            fn visit_map<A: serde::de::MapAccess<'de>>(self, mut map: A) -> Result<Readings, A::Error> {
                let mut given = Choices::NONE;
                while let Some(reading) = map.next_key::<Reading>()? {
                    if given.of_reading(reading).next().is_some() {
                        return Err(A::Error::custom(format_args!("{reading} is answered twice")));
                    }
                    given = given.with(map.next_value_seed(ChoiceOf(reading))?);
                }
                Ok(given.iter().fold(Readings::DEFAULT, Readings::with))
            }
        }

        struct ChoiceOf(Reading);
        impl<'de> serde::de::DeserializeSeed<'de> for ChoiceOf {
            type Value = Choice;

            fn deserialize<D: serde::Deserializer<'de>>(self, deserializer: D) -> Result<Choice, D::Error> {
                deserializer.deserialize_str(self)
            }
        }
        impl serde::de::Visitor<'_> for ChoiceOf {
            type Value = Choice;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                write!(f, "a choice of the reading {}", self.0.id())
            }

            fn visit_str<E: serde::de::Error>(self, value: &str) -> Result<Choice, E> {
                Choice::find(self.0.id(), value)
                    .ok_or_else(|| E::custom(format_args!("{value:?}: {}", UnknownName::ChoiceOf(self.0))))
            }
        }
        deserializer.deserialize_map(Visitor)
    }
}
