//! What the operator can do: set a switch, or cycle the power.

use std::fmt::{self, Write as _};
use std::str::FromStr;

use adsdv_conform::protocol::{Domain, INPUTS, InputField, Value};
use adsdv_spec::Inputs;

/// Something that the operator, or the world around the car, does to it.
///
/// It is written as `asms on`, `ami TRACK_DRIVE`, `ebs ARMED` or `power cycle`. The names and the values are those of the
/// protocol of programs under test (`conform/PROTOCOL.md`); a switch is `on` or `off`.
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

impl Action {
    /// The words for the power cycle.
    pub const POWER_CYCLE: &str = "power cycle";

    /// What the power cycle is, in a few words.
    pub const ABOUT_POWER_CYCLE: &str = "turns the power of the VCU off and on again";
}

/// What each switch is, in a few words: all that describes switches to people takes it from here.
const ABOUT: [(&str, &str); 19] = [
    ("asms", "the Autonomous System Master Switch"),
    ("tsms", "the Tractive System Master Switch"),
    ("ami", "the mission selected at the AMI"),
    ("ebs", "the state of the Emergency Braking System"),
    ("go", "the remote \"Go\" switch"),
    ("remote_estop", "the remote E-stop button is pressed"),
    ("res_link_lost", "the remote E-stop has lost its transmitter"),
    ("vehicle_estop", "an E-stop button on the vehicle is pressed"),
    ("crash_sensor", "the inertial crash sensor is activated"),
    ("critical_fault", "a critical fault without a flag of its own"),
    ("bms_fault", "a critical fault in the traction battery"),
    ("mpp_dongle_removed", "the autonomous driving dongle is not plugged in"),
    ("hvil_open", "HVIL or shutdown circuit: an open circuit"),
    ("hvil_short", "HVIL or shutdown circuit: a short circuit"),
    ("ebs_fault", "the Emergency Braking System is faulty"),
    ("offboard_charger_fault", "the off-board charger is faulty"),
    ("charging", "the battery charges: a fault once ASMS or TSMS is on"),
    ("batt_temp_high", "the battery is hot (a warning)"),
    ("batt_soc_low", "the battery's charge is low (a warning)"),
];

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

    /// What it is, in a few words.
    ///
    /// ```
    /// use adsdv_can::car::Switch;
    ///
    /// let asms = Switch::named("asms").expect("a switch");
    /// assert_eq!(asms.about(), "the Autonomous System Master Switch");
    /// ```
    pub fn about(self) -> &'static str {
        // The tests hold that there is one for each.
        ABOUT.iter().find(|(key, _)| *key == self.key()).map_or("", |(_, about)| about)
    }

    /// The switch whose name is most like this one, if one is like it at all.
    fn like(name: &str) -> Option<&'static str> {
        /// The name of no switch is nearly as long.
        const LONGEST: usize = 40;
        if name.len() > LONGEST {
            return None;
        }
        let name = name.to_ascii_lowercase();
        let (power, _) = Action::POWER_CYCLE.split_once(' ')?;
        let switches = Self::all().map(|switch| (switch.key(), switch.key()));
        let (_, meant) = switches
            .chain([(power, Action::POWER_CYCLE)])
            .map(|(word, meant)| (strsim::damerau_levenshtein(&name, word), word, meant))
            .filter(|(typing_errors, word, _)| *typing_errors <= (word.len() / 3).min(2))
            .map(|(typing_errors, _, meant)| (typing_errors, meant))
            .min_by_key(|(typing_errors, _)| *typing_errors)?;
        Some(meant)
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
}

impl fmt::Display for Action {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Set(switch, raw) => write!(f, "{} {}", switch.key(), switch.position(*raw)),
            Self::PowerCycle => f.write_str(Self::POWER_CYCLE),
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
    pub expected: Expected,
}

impl fmt::Display for UnknownSwitch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "found {}, expected {}", Excerpt(self.found.as_bytes()), self.expected)
    }
}

impl std::error::Error for UnknownSwitch {}

/// What was expected of words that are no action.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Expected {
    /// An action: there is nothing.
    Action,
    /// The name of a switch; with the one that may be meant, if there is one that is like it.
    Name(Option<&'static str>),
    /// One of the positions of this switch.
    Position(Switch),
    /// Both words of the power cycle.
    PowerCycle,
    /// Nothing behind the power cycle.
    NothingBehind,
}

impl fmt::Display for Expected {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let power_cycle = Action::POWER_CYCLE;
        match self {
            Self::Action => f.write_str("an action such as asms on"),
            Self::Name(Some(like)) => write!(f, "the name of a switch; did you mean {like}?"),
            Self::Name(None) => {
                let names: Vec<&str> = Switch::all().map(Switch::key).collect();
                write!(f, "{power_cycle}, or one of {}", names.join(", "))
            }
            Self::Position(switch) => {
                let positions = switch.positions().into_iter().map(|raw| switch.position(raw));
                let positions: Vec<String> = positions.collect();
                let all = match positions.split_last() {
                    Some((last, rest)) if !rest.is_empty() => format!("{} or {last}", rest.join(", ")),
                    _ => positions.concat(),
                };
                write!(f, "{} to be {all}", switch.key())
            }
            Self::PowerCycle => f.write_str(power_cycle),
            Self::NothingBehind => write!(f, "nothing behind {power_cycle}"),
        }
    }
}

/// What was found, short and printable: rubbish in a file does not reach a terminal.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Excerpt<'a>(pub(crate) &'a [u8]);

impl fmt::Display for Excerpt<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        /// So many characters are shown.
        const SHOWN: usize = 40;
        if self.0.is_empty() {
            return f.write_str("nothing");
        }
        let mut left = SHOWN;
        let mut cut = false;
        f.write_char('"')?;
        for chunk in self.0.utf8_chunks() {
            let text = chunk.valid();
            let end = text.char_indices().nth(left).map(|(end, _)| end);
            let shown = format!("{:?}", text.get(..end.unwrap_or(text.len())).unwrap_or_default());
            // The quotation marks are around it all.
            f.write_str(shown.strip_prefix('"').and_then(|shown| shown.strip_suffix('"')).unwrap_or(&shown))?;
            left = left.saturating_sub(text.chars().count());
            let bytes = chunk.invalid();
            let fits = bytes.get(..left.min(bytes.len())).unwrap_or_default();
            write!(f, "{}", fits.escape_ascii())?;
            left -= fits.len();
            cut = end.is_some() || fits.len() < bytes.len();
            if cut {
                break;
            }
        }
        f.write_str(if cut { "\"..." } else { "\"" })
    }
}

impl FromStr for Action {
    type Err = UnknownSwitch;

    fn from_str(text: &str) -> Result<Self, UnknownSwitch> {
        // Places are counted from its beginning: what follows it does not matter.
        let text = text.trim_end();
        let error = |found: &str, behind: &str, expected: Expected| {
            let at = text.len() - behind.len();
            Err(UnknownSwitch { at, found: found.to_owned(), expected })
        };
        let start = text.trim_start();
        let (name, rest) = split_word(start);
        if name.is_empty() {
            return error("", "", Expected::Action);
        }
        if let Some((_, cycle)) = Self::POWER_CYCLE.split_once(' ').filter(|(power, _)| *power == name) {
            let (word, behind) = split_word(rest);
            return match (word == cycle, behind) {
                (true, "") => Ok(Self::PowerCycle),
                (true, behind) => error(behind, behind, Expected::NothingBehind),
                (false, _) => error(start, start, Expected::PowerCycle),
            };
        }
        let Some(switch) = Switch::named(name) else {
            return error(name, start, Expected::Name(Switch::like(name)));
        };
        let raw = switch.positions().into_iter().find(|&raw| switch.position(raw) == rest);
        raw.map_or_else(|| error(rest, rest, Expected::Position(switch)), |raw| Ok(Self::Set(switch, raw)))
    }
}

/// The first word, and what follows it without the white space between them.
fn split_word(text: &str) -> (&str, &str) {
    let (word, rest) = text.split_once(char::is_whitespace).unwrap_or((text, ""));
    (word, rest.trim_start())
}
