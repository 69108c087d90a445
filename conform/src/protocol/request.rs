//! What a program under test gets: which edition all is about, the order to begin anew, or a step.

use std::borrow::Cow;
use std::fmt;
use std::str::FromStr;

use adsdv_spec::Inputs;

use super::bad_line::{BadLine, Given, Object};
use super::field::{Domain, Value};
use super::inputs::InputField;
use super::spoken::Protocol;

/// A line to a program under test. It displays as that line, without the end of the line, and is read from it, in the words of
/// [`UNSAID`](super::UNSAID); in those of another edition its [`Protocol`](super::Protocol) writes and reads it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Request {
    /// All that follows is about this edition. Without it, all is about [`UNSAID`](super::UNSAID).
    Hello {
        /// The version of the edition, which need not be one that there is.
        edition: String,
    },
    /// Begin anew, as after a power cycle.
    Reset,
    /// One step.
    Step {
        /// The time since the last step, or since the reset, in milliseconds.
        dt_ms: u32,
        /// What the VCU sees.
        inputs: Inputs,
    },
}

impl fmt::Display for Request {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.write(f, &Protocol::UNSAID)
    }
}

impl Request {
    pub(super) fn write(&self, f: &mut fmt::Formatter<'_>, protocol: &Protocol) -> fmt::Result {
        let (dt_ms, inputs) = match self {
            Self::Hello { edition } => {
                let edition = serde_json::Value::from(edition.as_str());
                return write!(f, "{{\"op\":\"hello\",\"edition\":{edition}}}");
            }
            Self::Reset => return f.write_str("{\"op\":\"reset\"}"),
            Self::Step { dt_ms, inputs } => (dt_ms, inputs),
        };
        write!(f, "{{\"op\":\"step\",\"dt_ms\":{dt_ms}")?;
        for (field, value) in given(inputs, protocol) {
            write!(f, ",\"{}\":", field.key)?;
            value.write_json(f)?;
        }
        f.write_str("}")
    }
}

/// The inputs that are not at their defaults.
fn given(inputs: &Inputs, protocol: &Protocol) -> impl Iterator<Item = (&'static InputField, Value)> {
    let usual = Inputs::default();
    protocol.inputs().filter_map(move |(field, domain)| {
        let raw = (field.get)(inputs);
        let value = Value { domain, raw: Some(raw) };
        (raw != (field.get)(&usual)).then_some((field, value))
    })
}

/// Inputs as a JSON object of their own, with the keys of a step. It displays as that, and is read from it, as a
/// [`Request`] is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct InputsAsJson(pub Inputs);

impl fmt::Display for InputsAsJson {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.write(f, &Protocol::UNSAID)
    }
}

impl InputsAsJson {
    pub(super) fn write(&self, f: &mut fmt::Formatter<'_>, protocol: &Protocol) -> fmt::Result {
        f.write_str("{")?;
        for (place, (field, value)) in given(&self.0, protocol).enumerate() {
            write!(f, "{}\"{}\":", if place == 0 { "" } else { "," }, field.key)?;
            value.write_json(f)?;
        }
        f.write_str("}")
    }
}

impl FromStr for InputsAsJson {
    type Err = BadLine;

    fn from_str(object: &str) -> Result<Self, BadLine> {
        Self::read(object, &Protocol::UNSAID)
    }
}

impl InputsAsJson {
    pub(super) fn read(object: &str, protocol: &Protocol) -> Result<Self, BadLine> {
        let Object(entries) = Object::read(object)?;
        let mut inputs = Inputs::default();
        for (place, (key, found)) in entries.iter().enumerate() {
            if entries.iter().take(place).any(|(other, _)| other == key) {
                return Err(BadLine::twice(key));
            }
            set_input(&mut inputs, key, found, protocol)?;
        }
        Ok(Self(inputs))
    }
}

impl FromStr for Request {
    type Err = BadLine;

    fn from_str(line: &str) -> Result<Self, BadLine> {
        Self::read(line, &Protocol::UNSAID)
    }
}

/// The operations, in words.
const OPERATIONS: &str = "\"reset\" or \"step\", or \"hello\" first of all";

impl Request {
    pub(super) fn read(line: &str, protocol: &Protocol) -> Result<Self, BadLine> {
        let Object(entries) = Object::read(line)?;
        if entries.iter().any(|(key, found)| key == "op" && *found == Given::Text("hello".into())) {
            return hello(&entries);
        }
        let (mut op, mut dt_ms, mut inputs) = (None, None, Inputs::default());
        let mut given: Vec<&str> = Vec::with_capacity(entries.len());
        for (key, found) in &entries {
            if given.contains(&key.as_ref()) {
                return Err(BadLine::twice(key));
            }
            given.push(key);
            match (key.as_ref(), found) {
                ("op", Given::Text(text)) if matches!(text.as_ref(), "reset" | "step") => {
                    op = Some(text.as_ref());
                }
                ("op", _) => return Err(BadLine::value(key, found, OPERATIONS)),
                ("dt_ms", Given::Number(number)) if u32::try_from(*number).is_ok() => {
                    dt_ms = u32::try_from(*number).ok();
                }
                ("dt_ms", _) => {
                    return Err(BadLine::value(key, found, Domain::Number { min: 0, max: i32::MAX }));
                }
                _ => set_input(&mut inputs, key, found, protocol)?,
            }
        }
        match (op, dt_ms) {
            (Some("reset"), _) if given.len() == 1 => Ok(Self::Reset),
            (Some("reset"), _) => Err(BadLine::new("a reset has nothing but \"op\"")),
            (Some(_), Some(dt_ms)) => Ok(Self::Step { dt_ms, inputs }),
            (Some(_), None) => {
                Err(BadLine::new("a step has no \"dt_ms\"; expected milliseconds since the last"))
            }
            (None, _) => Err(BadLine::new(format!("there is no \"op\"; expected {OPERATIONS}"))),
        }
    }
}

/// The first line of a conversation, which says which edition it is about.
fn hello(entries: &[(Cow<'_, str>, Given<'_>)]) -> Result<Request, BadLine> {
    let mut edition = None;
    let mut ops = 0;
    for (key, found) in entries {
        match (key.as_ref(), found) {
            ("op", _) if ops == 0 => ops = 1,
            ("edition", Given::Text(text)) if edition.is_none() => edition = Some(text.clone().into_owned()),
            ("op", _) | ("edition", Given::Text(_)) => return Err(BadLine::twice(key)),
            ("edition", _) => return Err(BadLine::value(key, found, "a version, such as \"3.0\"")),
            _ => return Err(BadLine::unknown(key, ["op", "edition"].into_iter())),
        }
    }
    let edition = edition.ok_or_else(|| BadLine::new("a hello has no \"edition\"; expected a version"))?;
    Ok(Request::Hello { edition })
}

fn set_input(inputs: &mut Inputs, key: &str, found: &Given<'_>, protocol: &Protocol) -> Result<(), BadLine> {
    let Some((field, domain)) = protocol.inputs().find(|(field, _)| field.key == key) else {
        let keys = protocol.inputs().map(|(field, _)| field.key);
        return Err(BadLine::unknown(key, ["op", "dt_ms"].into_iter().chain(keys)));
    };
    let set = domain.raw_or(field.domain, found).is_some_and(|raw| (field.set)(inputs, raw));
    if set { Ok(()) } else { Err(BadLine::value(key, found, domain)) }
}

impl Protocol {
    /// A request as the edition has it, without the end of the line. It leaves out what the edition does not have.
    pub fn line<'a>(&'a self, request: &'a Request) -> impl fmt::Display + 'a {
        fmt::from_fn(move |f| request.write(f, self))
    }

    /// Inputs as an object of their own, as the edition has it.
    pub fn object<'a>(&'a self, inputs: &'a InputsAsJson) -> impl fmt::Display + 'a {
        fmt::from_fn(move |f| inputs.write(f, self))
    }

    /// Reads what is asked of a program.
    ///
    /// # Errors
    ///
    /// Fails if it is no request, and says where and what was expected.
    pub fn request(&self, line: &str) -> Result<Request, BadLine> {
        Request::read(line, self)
    }

    /// Reads inputs that are an object of their own.
    ///
    /// # Errors
    ///
    /// Fails if it is no object of inputs of this edition, and says where and what was expected.
    pub fn inputs_as_json(&self, object: &str) -> Result<InputsAsJson, BadLine> {
        InputsAsJson::read(object, self)
    }
}
