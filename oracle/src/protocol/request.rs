//! What a program under test is told: to begin anew, or to step.

use std::fmt;
use std::str::FromStr;

use adsdv_spec::Inputs;

use super::bad_line::{BadLine, Given, Object};
use super::field::{Domain, Value};
use super::inputs::{INPUTS, InputField};

/// A line to a program under test. It displays as that line, without the end of the line, and is read from it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Request {
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
        let Self::Step { dt_ms, inputs } = self else { return f.write_str("{\"op\":\"reset\"}") };
        write!(f, "{{\"op\":\"step\",\"dt_ms\":{dt_ms}")?;
        for (field, value) in given(inputs) {
            write!(f, ",\"{}\":", field.key)?;
            value.write_json(f)?;
        }
        f.write_str("}")
    }
}

/// The inputs that are not at their defaults.
fn given(inputs: &Inputs) -> impl Iterator<Item = (&'static InputField, Value)> {
    let usual = Inputs::default();
    INPUTS.iter().filter_map(move |field| {
        let raw = (field.get)(inputs);
        let value = Value { domain: field.domain, raw: Some(raw) };
        (raw != (field.get)(&usual)).then_some((field, value))
    })
}

/// Inputs as a JSON object of their own, with the keys of a step. It displays as that, and is read from it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct InputsAsJson(pub Inputs);

impl fmt::Display for InputsAsJson {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("{")?;
        for (place, (field, value)) in given(&self.0).enumerate() {
            write!(f, "{}\"{}\":", if place == 0 { "" } else { "," }, field.key)?;
            value.write_json(f)?;
        }
        f.write_str("}")
    }
}

impl FromStr for InputsAsJson {
    type Err = BadLine;

    fn from_str(object: &str) -> Result<Self, BadLine> {
        let Object(entries) = Object::read(object)?;
        let mut inputs = Inputs::default();
        for (place, (key, found)) in entries.iter().enumerate() {
            if entries.iter().take(place).any(|(other, _)| other == key) {
                return Err(BadLine::twice(key));
            }
            set_input(&mut inputs, key, found)?;
        }
        Ok(Self(inputs))
    }
}

impl FromStr for Request {
    type Err = BadLine;

    fn from_str(line: &str) -> Result<Self, BadLine> {
        let Object(entries) = Object::read(line)?;
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
                ("op", _) => return Err(BadLine::value(key, found, "\"reset\" or \"step\"")),
                ("dt_ms", Given::Number(number)) if u32::try_from(*number).is_ok() => {
                    dt_ms = u32::try_from(*number).ok();
                }
                ("dt_ms", _) => {
                    return Err(BadLine::value(key, found, Domain::Number { min: 0, max: i32::MAX }));
                }
                _ => set_input(&mut inputs, key, found)?,
            }
        }
        match (op, dt_ms) {
            (Some("reset"), _) if given.len() == 1 => Ok(Self::Reset),
            (Some("reset"), _) => Err(BadLine::new("a reset has nothing but \"op\"")),
            (Some(_), Some(dt_ms)) => Ok(Self::Step { dt_ms, inputs }),
            (Some(_), None) => {
                Err(BadLine::new("a step has no \"dt_ms\"; expected milliseconds since the last"))
            }
            (None, _) => Err(BadLine::new("there is no \"op\"; expected \"reset\" or \"step\"")),
        }
    }
}

fn set_input(inputs: &mut Inputs, key: &str, found: &Given<'_>) -> Result<(), BadLine> {
    let Some(field) = INPUTS.iter().find(|field| field.key == key) else {
        return Err(BadLine::unknown(key, ["op", "dt_ms"].into_iter().chain(INPUTS.iter().map(|f| f.key))));
    };
    let set = field.domain.raw(found).is_some_and(|raw| (field.set)(inputs, raw));
    if set { Ok(()) } else { Err(BadLine::value(key, found, field.domain)) }
}
