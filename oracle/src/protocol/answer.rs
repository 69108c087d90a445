//! What a program under test answers: as much as it has to show.

use std::fmt;
use std::str::FromStr;

use super::bad_line::{BadLine, Given, Object};
use super::field::Value;
use super::shown::{SHOWN, Shown};

/// An answer to a step: some fields of [`SHOWN`] or all; a field that it leaves out is not checked. It is read from a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Answer([AnsweredValue; SHOWN.len()]);

/// What an answer says of a field.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
enum AnsweredValue {
    #[default]
    Nothing,
    Value(Option<i32>),
}

/// A field in which an answer is not what was expected. It displays as in `as_state is AS_READY; expected AS_OFF`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Difference {
    /// The key of the field.
    pub key: &'static str,
    /// What the answer says.
    pub found: Value,
    /// What it should say.
    pub expected: Value,
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} is {}; expected {}", self.key, self.found, self.expected)
    }
}

impl Answer {
    /// Whether the answer says anything of a field.
    pub fn has(&self, key: &str) -> bool {
        let given = SHOWN.iter().zip(&self.0).find(|(field, _)| field.key == key);
        given.is_some_and(|(_, given)| *given != AnsweredValue::Nothing)
    }

    /// What the answer says of a field; `None` if it says nothing, or if there is no such field.
    pub fn get(&self, key: &str) -> Option<Value> {
        let (field, given) = SHOWN.iter().zip(&self.0).find(|(field, _)| field.key == key)?;
        match given {
            AnsweredValue::Nothing => None,
            AnsweredValue::Value(raw) => Some(Value { domain: field.domain, raw: *raw }),
        }
    }

    /// The keys of the fields of which it says anything.
    pub fn keys(&self) -> impl Iterator<Item = &'static str> {
        let given = self.0;
        SHOWN
            .iter()
            .zip(given)
            .filter(|(_, given)| *given != AnsweredValue::Nothing)
            .map(|(field, _)| field.key)
    }

    /// Of each field of [`SHOWN`] whether the answer says anything of it.
    pub(crate) fn given(&self) -> impl Iterator<Item = bool> {
        self.0.into_iter().map(|given| given != AnsweredValue::Nothing)
    }

    /// The answer without all other fields than this one.
    pub(crate) fn only(&self, key: &str) -> Self {
        let mut only = Self([AnsweredValue::Nothing; SHOWN.len()]);
        let slots = SHOWN.iter().zip(only.0.iter_mut().zip(&self.0));
        slots.filter(|(field, _)| field.key == key).for_each(|(_, (slot, given))| *slot = *given);
        only
    }

    /// Whether a line answers a reset: an object that shows nothing, as `{}`. The error says why it is no object.
    pub fn is_reset(line: &str) -> Result<bool, BadLine> {
        let Object(entries) = Object::read(line)?;
        Ok(entries.iter().all(|(key, _)| SHOWN.iter().all(|field| field.key != key)))
    }

    /// Whether all that it says is so.
    pub fn agrees(&self, shown: &Shown) -> bool {
        self.0.iter().zip(&shown.0).all(|(given, expected)| match given {
            AnsweredValue::Nothing => true,
            AnsweredValue::Value(found) => found == expected,
        })
    }

    /// Each field in which it is not what was expected.
    pub fn differences(&self, shown: &Shown) -> impl Iterator<Item = Difference> {
        let given = self.0;
        shown.iter().zip(given).filter_map(|((field, expected), given)| match given {
            AnsweredValue::Value(found) if found != expected.raw => {
                Some(Difference { key: field.key, found: Value { raw: found, ..expected }, expected })
            }
            _ => None,
        })
    }
}

impl FromStr for Answer {
    type Err = BadLine;

    fn from_str(line: &str) -> Result<Self, BadLine> {
        let Object(entries) = Object::read(line)?;
        let mut answer = Self([AnsweredValue::Nothing; SHOWN.len()]);
        for (key, found) in &entries {
            let place = SHOWN.iter().position(|field| field.key == key);
            let slot = place.and_then(|place| Some((SHOWN.get(place)?, answer.0.get_mut(place)?)));
            let Some((field, given)) = slot else {
                return Err(BadLine::unknown(key, SHOWN.iter().map(|field| field.key)));
            };
            if *given != AnsweredValue::Nothing {
                return Err(BadLine::twice(key));
            }
            *given = match found {
                Given::Null if field.nullable => AnsweredValue::Value(None),
                _ => match field.domain.raw(found) {
                    Some(raw) => AnsweredValue::Value(Some(raw)),
                    None => return Err(BadLine::value(key, found, field.domain)),
                },
            };
        }
        if answer.has("as_state") {
            Ok(answer)
        } else {
            Err(BadLine::new("there is no \"as_state\"; expected at least that"))
        }
    }
}

impl From<Shown> for Answer {
    fn from(shown: Shown) -> Self {
        Self(shown.0.map(AnsweredValue::Value))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_answer_keeps_what_it_was_given() {
        let answer: Answer = r#"{"handshake":true,"as_state":"AS_READY","steer":null}"#.parse().unwrap();
        assert_eq!(answer.keys().collect::<Vec<_>>(), ["as_state", "handshake", "steer"]);
        let raw = |key| answer.get(key).map(|value| value.raw);
        let given = ["as_state", "handshake", "steer", "go_signal", "no such key"].map(raw);
        assert_eq!(given, [Some(Some(2)), Some(Some(1)), Some(None), None, None]);
        let only = answer.only("handshake");
        assert_eq!(only.keys().collect::<Vec<_>>(), ["handshake"]);
        assert_eq!(only.get("handshake"), answer.get("handshake"));
    }

    #[test]
    fn a_difference_prints_both_values() {
        let (machine, inputs) = (adsdv_spec::Machine::REFERENCE, adsdv_spec::Inputs::default());
        let (_, outputs) = machine.step(&adsdv_spec::Control::INITIAL, &inputs, 0);
        let answer: Answer = r#"{"as_state":"AS_READY","steer":7}"#.parse().unwrap();
        let shown = Shown::of(&outputs, &inputs);
        let differences = answer.differences(&shown);
        let given: Vec<String> = differences.map(|difference| difference.to_string()).collect();
        assert_eq!(given, ["as_state is AS_READY; expected AS_OFF", "steer is 7; expected null"]);
    }

    #[test]
    fn an_object_that_shows_nothing_answers_a_reset() {
        for (line, is_reset) in
            [("{}", Ok(true)), (r#"{"version":1}"#, Ok(true)), (r#"{"steer":0}"#, Ok(false))]
        {
            assert_eq!(Answer::is_reset(line), is_reset, "{line}");
        }
        assert!(Answer::is_reset("ready").is_err());
    }
}
