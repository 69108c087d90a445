//! What somebody wants a recording to show.

use std::collections::HashSet;
use std::fmt;
use std::str::FromStr;

use adsdv_spec::{AsState, Edition};

use super::cited;

/// So many requirements are named where one is not known.
const NEAR: usize = 4;

/// Something that a recording is to show, such as an AS state.
///
/// ```
/// use adsdv_oracle::judge::Required;
/// use adsdv_spec::AsState;
///
/// assert_eq!("AS_DRIVING".parse(), Ok(Required::State(AsState::Driving)));
/// assert_eq!("DRV-3".parse(), Ok(Required::Requirement("DRV-3")));
/// let error = "DRV-99".parse::<Required>().unwrap_err();
/// assert!(error.to_string().ends_with("the nearest are DRV-15, DRV-14, DRV-12, DRV-9"), "{error}");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Required {
    /// A message of the AI Computer.
    Ai,
    /// A message of the VCU.
    Vcu,
    /// This AS state, in 520h.
    State(AsState),
    /// What this requirement is about.
    Requirement(&'static str),
}

impl Required {
    /// What was not shown, in words.
    pub const fn missing(self) -> &'static str {
        match self {
            Self::Ai | Self::Vcu => "no message of it",
            Self::State(_) => "520h never showed it",
            Self::Requirement(_) => "never exercised",
        }
    }

    /// Whether a log of this edition can show it.
    ///
    /// # Errors
    ///
    /// Fails if none can, and names requirements that are written much like it.
    pub fn is_shown_in(self, edition: &Edition) -> Result<(), RequiredError> {
        match self {
            Self::Requirement(id) if !cited::all(edition).contains(&id) => {
                Err(RequiredError::new(id, &[edition]))
            }
            _ => Ok(()),
        }
    }
}

/// As it is written.
impl fmt::Display for Required {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Ai => "ai",
            Self::Vcu => "vcu",
            Self::State(state) => state.name(),
            Self::Requirement(id) => id,
        })
    }
}

impl FromStr for Required {
    type Err = RequiredError;

    /// Takes the requirements of all editions.
    fn from_str(text: &str) -> Result<Self, RequiredError> {
        let state =
            || AsState::ALL.iter().find(|state| state.name() == text).map(|&state| Self::State(state));
        let requirement = || {
            let mut all = Edition::ALL.iter().flat_map(|edition| cited::all(edition));
            all.find(|id| *id == text).map(Self::Requirement)
        };
        match text {
            "ai" => Some(Self::Ai),
            "vcu" => Some(Self::Vcu),
            _ => state().or_else(requirement),
        }
        .ok_or_else(|| RequiredError::new(text, Edition::ALL))
    }
}

/// No recording can show this.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RequiredError {
    /// Whether it is a requirement all the same.
    known: bool,
    /// The edition that it was looked for in, if in one.
    edition: Option<&'static str>,
    /// The requirements that are named most like it.
    near: Vec<&'static str>,
}

impl RequiredError {
    fn new(given: &str, editions: &[&Edition]) -> Self {
        let known = editions.iter().any(|edition| edition.requirements.has(given));
        let edition = match editions {
            [edition] => Some(edition.version),
            _ => None,
        };
        let mut seen = HashSet::new();
        let mut near: Vec<&str> = editions.iter().flat_map(|edition| cited::all(edition)).collect();
        near.retain(|id| seen.insert(*id) && distance(id, given).is_some());
        near.sort_by_key(|id| distance(id, given));
        near.truncate(NEAR);
        Self { known, edition, near }
    }
}

/// How far the numbers of two requirements are apart; `None` if they are about different topics.
fn distance(id: &str, given: &str) -> Option<u32> {
    let (prefix, number) = id.split_once('-')?;
    let digits = given.find(|c: char| c.is_ascii_digit()).unwrap_or(given.len());
    let (topic, other) = given.split_at_checked(digits)?;
    let same = topic.trim_end_matches(['-', '_', ' ']).eq_ignore_ascii_case(prefix);
    let other = other.parse().unwrap_or(0);
    same.then(|| number.parse().map_or(u32::MAX, |number: u32| number.abs_diff(other)))
}

impl fmt::Display for RequiredError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.known, self.edition) {
            (true, _) => f.write_str("no log can show that requirement")?,
            (false, Some(edition)) => write!(f, "edition {edition} has no such requirement")?,
            (false, None) => f.write_str("nothing has that name")?,
        }
        let states: Vec<&str> = AsState::ALL.iter().map(|state| state.name()).collect();
        write!(f, "; expected ai, vcu, {} or a requirement that a log can show", states.join(", "))?;
        if self.near.is_empty() {
            f.write_str(", such as DRV-4")
        } else {
            write!(f, "; the nearest are {}", self.near.join(", "))
        }
    }
}

impl std::error::Error for RequiredError {}
