//! All that is wrong with a file of rules, in the order in which it stands there.

use std::fmt;

use super::error::{RuleError, SpannedError};
use super::limits::MISTAKES;

/// Everything that is wrong with a file of rules, in the order of the file: at least one mistake.
///
/// A line that cannot be read has one mistake, for what is behind it is anybody's guess; of a line that can, every name, word and
/// unit that is wrong is one. The first twenty are listed, and further ones are counted.
///
/// ```
/// use adsdv_oracle::rules::RuleFile;
///
/// let errors = "calm: never sped > 5\npace: alway moving".parse::<RuleFile>().unwrap_err();
/// let places: Vec<_> = errors.iter().map(|error| (error.line, error.column)).collect();
/// assert_eq!((places, errors.more()), (vec![(1, 13), (2, 13)], 0));
/// assert_eq!(errors.first().text, "calm: never sped > 5");
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RuleErrors {
    first: RuleError,
    rest: Vec<RuleError>,
    more: usize,
}

impl RuleErrors {
    /// The first mistake of the file.
    pub const fn first(&self) -> &RuleError {
        &self.first
    }

    /// The mistakes that are listed, in the order of the file.
    pub fn iter(&self) -> impl Iterator<Item = &RuleError> {
        std::iter::once(&self.first).chain(&self.rest)
    }

    /// How many mistakes there are beyond those that are listed.
    pub const fn more(&self) -> usize {
        self.more
    }

    /// What stands behind the listed ones: `and 3 more mistakes`; `None` where they are all.
    pub fn and_more(&self) -> Option<String> {
        match self.more {
            0 => None,
            1 => Some("and 1 more mistake".to_owned()),
            more => Some(format!("and {more} more mistakes")),
        }
    }
}

impl From<RuleError> for RuleErrors {
    fn from(first: RuleError) -> Self {
        Self { first, rest: Vec::new(), more: 0 }
    }
}

/// A line for each mistake.
impl fmt::Display for RuleErrors {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.first)?;
        self.rest.iter().try_for_each(|error| write!(f, "\n{error}"))?;
        self.and_more().map_or(Ok(()), |more| write!(f, "\n{more}"))
    }
}

impl std::error::Error for RuleErrors {}

/// Gathers the mistakes of a file, which are to be added in its order.
#[derive(Debug, Default)]
pub(super) struct Mistakes {
    listed: Vec<RuleError>,
    more: usize,
}

impl Mistakes {
    /// This is wrong with a line, whose number counts from 1.
    pub(super) fn add(&mut self, wrong: SpannedError, line: usize, text: &str) {
        if self.are_counted_only() {
            self.more += 1;
        } else {
            self.listed.push(wrong.in_line(line, text));
        }
    }

    /// Whether a further one is only counted, so that nobody needs to know what it is.
    pub(super) fn are_counted_only(&self) -> bool {
        self.listed.len() >= MISTAKES
    }

    /// There is no further one.
    pub(super) fn finish(self) -> Result<(), RuleErrors> {
        let mut listed = self.listed.into_iter();
        match listed.next() {
            Some(first) => Err(RuleErrors { first, rest: listed.collect(), more: self.more }),
            None => Ok(()),
        }
    }
}
