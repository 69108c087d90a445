//! What a program under test answers: as much as it has to show.

use std::fmt;
use std::str::FromStr;

use super::bad_line::{BadLine, Given, Object};
use super::field::{Value, Words};
use super::shown::{FIELDS, SHOWN, Shown};
use super::spoken::Protocol;
use super::unsaid::UNSAID;

/// An answer to a step: some fields of [`SHOWN`] or all; a field that it leaves out is not checked. It is read from a line.
///
/// A number or a name that the field does not have is a value as well, one that no specification shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Answer {
    given: [AnsweredValue; SHOWN.len()],
    words: Words,
}

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
        let given = FIELDS.iter().zip(&self.given).find(|(field, _)| field.key == key);
        given.is_some_and(|(_, given)| *given != AnsweredValue::Nothing)
    }

    /// What the answer says of a field; `None` if it says nothing, or if there is no such field.
    pub fn get(&self, key: &str) -> Option<Value> {
        let (field, given) = FIELDS.iter().zip(&self.given).find(|(field, _)| field.key == key)?;
        match given {
            AnsweredValue::Nothing => None,
            AnsweredValue::Value(raw) => Some(Value { domain: field.domain_on(&self.words.0), raw: *raw }),
        }
    }

    /// What it says of the field at this place in [`SHOWN`], as a raw value; `None` if it says nothing.
    pub fn raw_at(&self, place: usize) -> Option<Option<i32>> {
        match self.given.get(place)? {
            AnsweredValue::Nothing => None,
            AnsweredValue::Value(raw) => Some(*raw),
        }
    }

    /// The keys of the fields of which it says anything.
    pub fn keys(&self) -> impl Iterator<Item = &'static str> {
        let given = self.given;
        FIELDS
            .iter()
            .zip(given)
            .filter(|(_, given)| *given != AnsweredValue::Nothing)
            .map(|(field, _)| field.key)
    }

    /// Of each field of [`SHOWN`] whether the answer says anything of it.
    pub(crate) fn given(&self) -> impl Iterator<Item = bool> {
        self.given.into_iter().map(|given| given != AnsweredValue::Nothing)
    }

    /// The answer without all other fields than this one.
    pub(crate) fn only(&self, key: &str) -> Self {
        let mut only = Self { given: [AnsweredValue::Nothing; SHOWN.len()], words: self.words };
        let slots = FIELDS.iter().zip(only.given.iter_mut().zip(&self.given));
        slots.filter(|(field, _)| field.key == key).for_each(|(_, (slot, given))| *slot = *given);
        only
    }

    /// The answer without all other fields than these.
    #[must_use]
    pub fn among(mut self, keys: &[&str]) -> Self {
        let others = FIELDS.iter().zip(&mut self.given).filter(|(field, _)| !keys.contains(&field.key));
        others.for_each(|(_, given)| *given = AnsweredValue::Nothing);
        self
    }

    /// Whether a line answers a reset: an object that shows nothing, as `{}`. The error says why it is no object.
    ///
    /// # Errors
    ///
    /// Fails if the line is no object, and says why.
    pub fn is_reset(line: &str) -> Result<bool, BadLine> {
        let Object(entries) = Object::read(line)?;
        Ok(entries.iter().all(|(key, _)| !FIELDS.iter().any(|field| field.key == key && field.is_in(UNSAID))))
    }

    /// Which edition an answer to a hello says that the program is of; `None` if it says none. The error says why the line is
    /// no object.
    ///
    /// # Errors
    ///
    /// Fails if the line is no object, and says why.
    pub fn edition(line: &str) -> Result<Option<String>, BadLine> {
        let Object(entries) = Object::read(line)?;
        let said = entries.into_iter().find(|(key, _)| key == "edition");
        Ok(said.map(|(_, version)| match version {
            Given::Text(version) => version.into_owned(),
            other => other.to_string(),
        }))
    }

    /// Whether all that it says is so.
    pub fn agrees(&self, shown: &Shown) -> bool {
        self.differing(shown) == 0
    }

    /// In how many fields it is not what was expected.
    pub fn differing(&self, shown: &Shown) -> usize {
        let differs = |(given, expected): &(&AnsweredValue, &Option<i32>)| match given {
            AnsweredValue::Nothing => false,
            AnsweredValue::Value(found) => found != *expected,
        };
        self.given.iter().zip(&shown.raw).filter(differs).count()
    }

    /// Each field in which it is not what was expected.
    pub fn differences(&self, shown: &Shown) -> impl Iterator<Item = Difference> {
        let given = FIELDS.iter().zip(self.given).zip(shown.raw);
        let words = shown.words;
        given.filter_map(move |((field, given), expected)| match given {
            AnsweredValue::Value(found) if found != expected => {
                let value = |raw| Value { domain: field.domain_on(&words.0), raw };
                Some(Difference { key: field.key, found: value(found), expected: value(expected) })
            }
            _ => None,
        })
    }
}

impl FromStr for Answer {
    type Err = BadLine;

    fn from_str(line: &str) -> Result<Self, BadLine> {
        Self::read(line, &Protocol::UNSAID)
    }
}

impl Answer {
    pub(super) fn read(line: &str, protocol: &Protocol) -> Result<Self, BadLine> {
        let Object(entries) = Object::read(line)?;
        let mut answer = Self { given: [AnsweredValue::Nothing; SHOWN.len()], words: Words(*protocol.bus()) };
        for (key, found) in &entries {
            let place = FIELDS.iter().position(|field| field.key == key);
            let slot = place.and_then(|place| {
                Some((place, FIELDS.get(place)?, protocol.shown_at(place)?, answer.given.get_mut(place)?))
            });
            let Some((place, field, domain, given)) = slot else {
                return Err(BadLine::unknown(key, protocol.shown().map(|(field, _)| field.key)));
            };
            if *given != AnsweredValue::Nothing {
                return Err(BadLine::twice(key));
            }
            *given = match found {
                Given::Null if field.nullable => AnsweredValue::Value(None),
                _ => match domain.raw_or(field.domain, found) {
                    //= D-69
                    Some(raw) => AnsweredValue::Value(Some(protocol.meaning_at(place, raw))),
                    // That it is none of the values is for the judge to say.
                    None => match domain.foreign(found) {
                        Some(raw) => AnsweredValue::Value(Some(raw)),
                        None => return Err(BadLine::value(key, found, domain)),
                    },
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

impl Protocol {
    /// Reads what a program answers to a step.
    ///
    /// # Errors
    ///
    /// Fails if it is no object of outputs, and says where and what was expected.
    pub fn answer(&self, line: &str) -> Result<Answer, BadLine> {
        Answer::read(line, self)
    }
}

impl From<Shown> for Answer {
    fn from(shown: Shown) -> Self {
        let mut answer = Self { given: shown.raw.map(AnsweredValue::Value), words: shown.words };
        for (field, given) in FIELDS.iter().zip(&mut answer.given) {
            // The edition does not have it.
            if *given == AnsweredValue::Value(None) && !field.nullable {
                *given = AnsweredValue::Nothing;
            }
        }
        answer
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
        let few = answer.among(&["steer", "as_state", "go_signal"]);
        assert_eq!(few.keys().collect::<Vec<_>>(), ["as_state", "steer"]);
    }

    #[test]
    fn a_difference_prints_both_values() {
        let (machine, inputs) = (adsdv_spec::Machine::REFERENCE, adsdv_spec::Inputs::default());
        let (_, outputs) = machine.step(&adsdv_spec::Control::INITIAL, &inputs, 0);
        let answer: Answer = r#"{"as_state":"AS_READY","steer":7}"#.parse().unwrap();
        let shown = Shown::of(machine.edition(), &outputs, &inputs);
        let differences = answer.differences(&shown);
        let given: Vec<String> = differences.map(|difference| difference.to_string()).collect();
        assert_eq!(given, ["as_state is AS_READY; expected AS_OFF", "steer is 7; expected null"]);
        assert_eq!(answer.differing(&shown), 2);
    }

    #[test]
    fn a_value_that_a_field_does_not_have_is_an_answer_and_differs() {
        let (machine, inputs) = (adsdv_spec::Machine::REFERENCE, adsdv_spec::Inputs::default());
        let (_, outputs) = machine.step(&adsdv_spec::Control::INITIAL, &inputs, 0);
        let shown = Shown::of(machine.edition(), &outputs, &inputs);
        for (line, difference) in [
            (r#"{"as_state":0}"#, "as_state is 0; expected AS_OFF"),
            (r#"{"as_state":"AS_LIMP"}"#, "as_state is AS_LIMP; expected AS_OFF"),
            (r#"{"as_state":"AS_OFF","shutdown_cause":99}"#, "shutdown_cause is 99; expected NO SHUTDOWN"),
            (r#"{"as_state":"AS_OFF","front_axle_trq":-1}"#, "front_axle_trq is -1; expected 0"),
        ] {
            let answer: Answer = line.parse().unwrap();
            assert!(!answer.agrees(&shown), "{line}");
            let differences: Vec<String> =
                answer.differences(&shown).map(|difference| difference.to_string()).collect();
            assert_eq!(differences, [difference]);
        }
        for line in [
            r#"{"as_state":null}"#,
            r#"{"as_state":1.5}"#,
            r#"{"as_state":99999999999}"#,
            r#"{"as_state":"AS_OFF","handshake":2}"#,
            r#"{"as_state":"AS_OFF","front_axle_trq":"much"}"#,
        ] {
            assert!(line.parse::<Answer>().is_err(), "{line}");
        }
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
