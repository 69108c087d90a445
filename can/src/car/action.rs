//! What the operator can do: set a switch, or cycle the power.

use std::fmt;
use std::str::FromStr;

use adsdv_oracle::protocol::{Domain, INPUTS, InputField, Value};
use adsdv_spec::Inputs;

/// Something that the operator, or the world around the car, does to it.
///
/// It is written as `asms on`, `ami TRACK_DRIVE`, `ebs ARMED` or `power cycle`. The names and the values are those of the
/// protocol of programs under test (`oracle/PROTOCOL.md`); a switch is `on` or `off`.
///
/// ```
/// use adsdv_can::car::Action;
///
/// let action: Action = "ami TRACK_DRIVE".parse()?;
/// assert_eq!(action.to_string(), "ami TRACK_DRIVE");
/// assert_eq!(
///     "asms up".parse::<Action>().unwrap_err().to_string(),
///     "found \"up\", expected asms to be off or on",
/// );
/// # Ok::<(), adsdv_can::car::UnknownSwitch>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Action {
    /// Sets a switch, or whatever has a position, to a raw value.
    Set(Switch, i32),
    /// Turns the power of the VCU off and on again.
    PowerCycle,
}

/// The words for the power cycle.
const POWER_CYCLE: &str = "power cycle";

/// Something that the operator or the world sets: a master switch, the mission, "Go", a cause of an open shutdown circuit, a
/// fault that another controller reports.
#[derive(Clone, Copy, Debug)]
pub struct Switch(&'static InputField);

impl PartialEq for Switch {
    fn eq(&self, other: &Self) -> bool {
        self.key() == other.key()
    }
}

impl Eq for Switch {}

impl Switch {
    /// Every switch: what of the VCU's inputs neither the AI Computer sends nor the vehicle measures.
    pub fn all() -> impl Iterator<Item = Self> {
        INPUTS.iter().filter(|field| matches!(field.part, "" | "sdc" | "reports")).map(Self)
    }

    /// The switch of this name, such as `asms`.
    pub fn named(name: &str) -> Option<Self> {
        Self::all().find(|switch| switch.key() == name)
    }

    /// Its name, such as `asms`.
    pub fn key(self) -> &'static str {
        self.0.key
    }

    /// The part of the inputs that it is of: `sdc`, `reports`, or empty for the switches of the car itself.
    pub fn part(self) -> &'static str {
        self.0.part
    }

    /// Its positions.
    pub fn domain(self) -> Domain {
        self.0.domain
    }

    /// Its position, raw.
    pub fn get(self, inputs: &Inputs) -> i32 {
        (self.0.get)(inputs)
    }

    /// Sets it. A value that it has not changes nothing.
    pub(super) fn set(self, inputs: &mut Inputs, raw: i32) {
        (self.0.set)(inputs, raw);
    }

    /// A position in words: `on`, `off` or a name.
    pub fn position(self, raw: i32) -> String {
        match self.domain() {
            Domain::Flag => (if raw == 0 { "off" } else { "on" }).to_owned(),
            domain => Value { domain, raw: Some(raw) }.to_string(),
        }
    }

    /// The raw values of its positions, in order.
    pub fn positions(self) -> Vec<i32> {
        match self.domain() {
            Domain::Flag => vec![0, 1],
            Domain::Names(names) => names.iter().map(|&(raw, _)| raw).collect(),
            Domain::Number { min, max } => (min..=max).collect(),
        }
    }

    /// What its positions are, in words.
    fn expected(self) -> String {
        let positions: Vec<String> = self.positions().into_iter().map(|raw| self.position(raw)).collect();
        match positions.split_last() {
            Some((last, rest)) if !rest.is_empty() => format!("{} or {last}", rest.join(", ")),
            _ => positions.concat(),
        }
    }
}

impl fmt::Display for Action {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Set(switch, raw) => write!(f, "{} {}", switch.key(), switch.position(*raw)),
            Self::PowerCycle => f.write_str(POWER_CYCLE),
        }
    }
}

/// Words that are no action.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnknownSwitch {
    /// Where the wrong words stand in the text, in bytes.
    pub at: usize,
    /// What was found; empty if nothing was.
    pub found: String,
    /// What was expected.
    pub expected: String,
}

impl fmt::Display for UnknownSwitch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "found {}, expected {}", Excerpt(&self.found), self.expected)
    }
}

impl std::error::Error for UnknownSwitch {}

/// What was found, short and printable: rubbish in a file does not reach a terminal.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Excerpt<'a>(pub(crate) &'a str);

impl fmt::Display for Excerpt<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        /// So many characters are shown.
        const SHOWN: usize = 40;
        if self.0.is_empty() {
            return f.write_str("nothing");
        }
        match self.0.char_indices().nth(SHOWN) {
            Some((end, _)) => write!(f, "{:?}...", self.0.get(..end).unwrap_or_default()),
            None => write!(f, "{:?}", self.0),
        }
    }
}

impl FromStr for Action {
    type Err = UnknownSwitch;

    fn from_str(text: &str) -> Result<Self, UnknownSwitch> {
        let error = |rest: &str, found: &str, expected: String| {
            Err(UnknownSwitch { at: text.len() - rest.len(), found: found.to_owned(), expected })
        };
        if text.split_whitespace().eq(POWER_CYCLE.split(' ')) {
            return Ok(Self::PowerCycle);
        }
        let text = text.trim_end();
        let start = text.trim_start();
        let (name, rest) = start.split_once(char::is_whitespace).unwrap_or((start, ""));
        if name.is_empty() {
            return error("", "", "an action such as asms on".to_owned());
        }
        let Some(switch) = Switch::named(name) else {
            let names: Vec<&str> = Switch::all().map(Switch::key).collect();
            return error(start, name, format!("{POWER_CYCLE}, or one of {}", names.join(", ")));
        };
        let position = rest.trim_start();
        let raw = switch.positions().into_iter().find(|&raw| switch.position(raw) == position);
        raw.map_or_else(
            || error(position, position, format!("{name} to be {}", switch.expected())),
            |raw| Ok(Self::Set(switch, raw)),
        )
    }
}
