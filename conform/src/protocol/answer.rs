//! What a program under test answers: as much as it has to show.

use std::fmt;
use std::str::FromStr;

use super::bad_line::{BadLine, Given, Object};
use super::field::{Value, Words};
use super::shown::{FIELDS, Shown, ShownField, ShownValues};
use super::spoken::Protocol;
use super::unsaid::UNSAID;

/// An answer to a step: some fields of [`SHOWN`](super::SHOWN) or all; a field that it leaves out is not checked. It is read from a line.
///
/// A number or a name that the field does not have is a value as well, one that no specification shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Answer {
    /// A bit for each field of which it says anything.
    given: u64,
    /// What it says; none is `null`.
    said: ShownValues,
    words: Words,
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
    /// An answer that says nothing, in the words of a bus.
    const fn nothing(words: Words) -> Self {
        Self { given: 0, said: ShownValues::NONE, words }
    }

    /// Whether the answer says anything of a field.
    pub fn has(&self, key: &str) -> bool {
        self.fields().any(|(_, field)| field.key == key)
    }

    /// What the answer says of a field; `None` if it says nothing, or if there is no such field.
    pub fn get(&self, key: &str) -> Option<Value> {
        let (place, field) = self.fields().find(|(_, field)| field.key == key)?;
        Some(Value { domain: field.domain_on(&self.words.0), raw: self.said.at(place) })
    }

    /// What it says of the field at this place in [`SHOWN`](super::SHOWN), as a raw value; `None` if it says nothing.
    pub fn raw_at(&self, place: usize) -> Option<Option<i32>> {
        self.gives(place).then(|| self.said.at(place))
    }

    /// Whether it says anything of the field at this place.
    fn gives(&self, place: usize) -> bool {
        place < FIELDS.len() && self.given >> place & 1 == 1
    }

    /// The fields of which it says anything, each with its place.
    fn fields(&self) -> impl Iterator<Item = (usize, &'static ShownField)> {
        let given = self.given;
        FIELDS.iter().enumerate().filter(move |(place, _)| given >> place & 1 == 1)
    }

    /// The keys of the fields of which it says anything.
    pub fn keys(&self) -> impl Iterator<Item = &'static str> {
        self.fields().map(|(_, field)| field.key)
    }

    /// A bit for each field of [`SHOWN`](super::SHOWN) of which the answer says anything.
    pub(crate) const fn given(&self) -> u64 {
        self.given
    }

    /// The answer without all other fields than this one.
    pub(crate) fn only(&self, key: &str) -> Self {
        self.among(&[key])
    }

    /// The answer without all other fields than these.
    #[must_use]
    pub fn among(mut self, keys: &[&str]) -> Self {
        let kept = self.fields().filter(|(_, field)| keys.contains(&field.key));
        self.given = kept.fold(0, |bits, (place, _)| bits | 1 << place);
        self.said = self.said.among(self.given);
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
        self.differing_in(&shown.raw)
    }

    /// The same, where what was expected is plain numbers.
    #[inline]
    pub fn differing_in(&self, values: &ShownValues) -> usize {
        (self.said.differing(values) & self.given).count_ones() as usize
    }

    /// Each field in which it is not what was expected.
    pub fn differences(&self, shown: &Shown) -> impl Iterator<Item = Difference> {
        let differing = self.said.differing(&shown.raw);
        let (said, raw, words) = (self.said, shown.raw, shown.words);
        self.fields().filter(move |(place, _)| differing >> place & 1 == 1).map(move |(place, field)| {
            let value = |raw: &ShownValues| Value { domain: field.domain_on(&words.0), raw: raw.at(place) };
            Difference { key: field.key, found: value(&said), expected: value(&raw) }
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
        let mut answer = Self::nothing(Words(*protocol.bus()));
        for (key, found) in &entries {
            let place = FIELDS.iter().position(|field| field.key == key);
            let slot = place.and_then(|place| Some((place, FIELDS.get(place)?, protocol.shown_at(place)?)));
            let Some((place, field, domain)) = slot else {
                return Err(BadLine::unknown(key, protocol.shown().map(|(field, _)| field.key)));
            };
            if answer.gives(place) {
                return Err(BadLine::twice(key));
            }
            answer.given |= 1 << place;
            if matches!(found, Given::Null) && field.nullable {
                continue;
            }
            let raw = match domain.raw_or(field.domain, found) {
                //= D-69
                Some(raw) => protocol.meaning_at(place, raw),
                // That it is none of the values is for the judge to say.
                None => domain.foreign(found).ok_or_else(|| BadLine::value(key, found, domain))?,
            };
            answer.said = answer.said.with(place, raw);
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
        // What has no value and is never `null`, the edition does not have.
        let nullable = FIELDS.iter().enumerate().filter(|(_, field)| field.nullable);
        let given = nullable.fold(shown.raw.there(), |bits, (place, _)| bits | 1 << place);
        Self { given, said: shown.raw, words: shown.words }
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
