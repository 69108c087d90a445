//! What the operator does, and when, from a file.
//!
//! A scenario is a few lines of text. Each says when it takes place, and then what is done, separated by commas:
//!
//! ```text
//! # A mission, and an emergency stop on the way
//! 0                       ebs ARMED, ami AUTONOMOUS_DEMO
//! 0.5                     tsms on, asms on
//! AS_READY +5.5           go on
//! AS_DRIVING +3           remote_estop on
//! EMERGENCY_BRAKE +15.5   asms off
//! +1                      end
//! ```
//!
//! | it takes place | written as |
//! |---|---|
//! | so many seconds after the start | `12.5` |
//! | so many seconds after the line before took place | `+0.5` |
//! | when this AS state is reached, or if it is there already | `AS_READY` |
//! | when this AS state has lasted for so many seconds | `AS_READY +5.5` |
//!
//! Lines take place one after the other, in the order of the file: one whose time has come waits for the line before. A line
//! that waits for a state looks at it once the line before has had its effect, so that `asms off` followed by a line with
//! `AS_READY` waits for the next time that the car gets ready.
//!
//! What is done is an [`Action`]: a switch with its position, or `power cycle`. The last may be `end`: the program stops.
//! Without it the car goes on as it is. `#` begins a comment; lines with nothing else are passed over.
//!
//! Seconds have at most three decimals. A file that does not read says of every line that is wrong what was found and what
//! was expected: see [`Unreadable`].

mod error;
mod parse;
mod player;
mod read;
mod seconds;
mod stuck;

use std::fmt;
use std::str::FromStr;

use adsdv_spec::messages::AsState;

use crate::car::Action;

pub use error::{LineError, MAX_ERRORS, Unreadable};
pub use player::Player;
pub use read::{MAX_BYTES, MAX_LINE};
pub use stuck::{PATIENCE_MS, Stuck, Waiting};

use seconds::Seconds;

/// What the operator does, and when.
///
/// ```
/// use adsdv_can::scenario::Scenario;
///
/// let scenario: Scenario = "0.5  asms on,tsms on  # both\nAS_READY   +5.50 go on\n".parse()?;
/// assert_eq!(scenario.to_string(), "0.5 asms on, tsms on\nAS_READY +5.5 go on\n");
///
/// let wrong = "0 asms up\nAS_REDY go on\n".parse::<Scenario>().unwrap_err();
/// assert_eq!(
///     wrong.to_string(),
///     "line 1, column 8: found \"up\", expected asms to be off or on\n\
///      line 2, column 1: found \"AS_REDY\", expected a time such as 12.5 or +0.5, or one of AS_OFF, AS_READY, \
///      AS_DRIVING, EMERGENCY_BRAKE, AS_FINISHED",
/// );
/// # Ok::<(), adsdv_can::scenario::Unreadable>(())
/// ```
#[derive(Clone, Debug)]
pub struct Scenario {
    /// At least one.
    lines: Vec<Line>,
}

/// A line of a scenario.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Line {
    /// The number of the line in its file; the first is 1.
    pub number: u64,
    /// When it takes place.
    pub when: When,
    /// What is done.
    pub actions: Vec<Action>,
    /// Whether the program stops then.
    pub ends: bool,
}

/// When a line takes place. Times are in milliseconds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum When {
    /// So long after the start.
    At(u32),
    /// So long after the line before took place.
    After(u32),
    /// When a state has lasted for so long.
    State(AsState, u32),
}

/// The longest time of a scenario, in milliseconds: a day.
pub const MAX_MS: u32 = 24 * 60 * 60 * 1000;

impl Scenario {
    /// The scenarios that come with the program, each with its name: the text of the files in `can/scenarios`.
    pub const SAMPLES: [(&str, &str); 5] = [
        ("mission", MISSION),
        ("go-too-early", include_str!("../../scenarios/go-too-early.txt")),
        ("go-lost", include_str!("../../scenarios/go-lost.txt")),
        ("remote-estop", include_str!("../../scenarios/remote-estop.txt")),
        ("power-cycle", include_str!("../../scenarios/power-cycle.txt")),
    ];

    /// A whole mission, the first of [`SAMPLES`](Self::SAMPLES).
    pub fn mission() -> Self {
        // It reads: the tests run it. Nothing would be done otherwise.
        MISSION.parse().unwrap_or(Self { lines: Vec::new() })
    }

    /// The text of the sample of this name.
    pub fn sample(name: &str) -> Option<&'static str> {
        Self::SAMPLES.into_iter().find_map(|(sample, text)| (sample == name).then_some(text))
    }

    /// The lines, in their order.
    pub fn lines(&self) -> &[Line] {
        &self.lines
    }
}

/// The text of the built-in scenario.
const MISSION: &str = include_str!("../../scenarios/mission.txt");

/// Two scenarios are the same if the same happens; the numbers of their lines do not count.
impl PartialEq for Scenario {
    fn eq(&self, other: &Self) -> bool {
        let content = |line: &Line| (line.when, line.ends);
        self.lines.len() == other.lines.len()
            && self
                .lines
                .iter()
                .zip(&other.lines)
                .all(|(a, b)| content(a) == content(b) && a.actions == b.actions)
    }
}

impl Eq for Scenario {}

impl FromStr for Scenario {
    type Err = Unreadable;

    fn from_str(text: &str) -> Result<Self, Unreadable> {
        Self::read(text.as_bytes())
    }
}

impl fmt::Display for Scenario {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.lines.iter().try_for_each(|line| writeln!(f, "{line}"))
    }
}

impl fmt::Display for Line {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}", self.when, self.doings().join(", "))
    }
}

impl Line {
    /// What is done, in words.
    pub fn doings(&self) -> Vec<String> {
        let end = self.ends.then(|| parse::END.to_owned());
        self.actions.iter().map(Action::to_string).chain(end).collect()
    }
}

impl fmt::Display for When {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::At(ms) => write!(f, "{}", Seconds((*ms).into())),
            Self::After(ms) => write!(f, "+{}", Seconds((*ms).into())),
            Self::State(state, 0) => write!(f, "{state}"),
            Self::State(state, ms) => write!(f, "{state} +{}", Seconds((*ms).into())),
        }
    }
}
