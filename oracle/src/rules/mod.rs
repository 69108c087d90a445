//! A team's own rules: what it wants of every run, in the words of the signals and conditions, judged beside the document.
//!
//! ```text
//! text --> lex --> parse --> RuleFile (names as they were written)
//!                              |  under an edition: names, units, resolve
//!                              v
//! judge --> what is known --> Runner: a predicate is true, false or unknown; track: a rule holds, is broken, or undecided
//! ```
//!
//! A file has a rule in each line: `name: form "what it is for"`. There are six forms, with the meaning that signal temporal logic
//! gives them, over true, false and unknown:
//!
//! | form | broken when | in signal temporal logic |
//! |---|---|---|
//! | `always P` | P is false | G P |
//! | `never P` | P is true | G ¬P |
//! | `never P for T`, `P for at most T` | P has been true for longer than T | ¬F G\[0,T\] P |
//! | `after P, Q within T` | P became true, and Q was false up to T after it | G (↑P → F\[0,T\] Q) |
//! | `after P, Q for T` | P became true, and Q was false before T was over | G (↑P → G\[0,T\] Q) |
//! | `after P, Q until R [within T]` | P became true, and Q was false before R was true, or R not true by T | G (↑P → Q U\[0,T\] R) |
//! | `P until Q` | P was false before Q was true | P U Q |
//!
//! What is unknown neither breaks a rule nor confirms it: with less known, less is said, and never the opposite. A message that is
//! late is unknown from the time at which the judge takes it for that. All of it is online and in bounded memory.
//!
//! ```
//! use adsdv_oracle::log::{LogOptions, judge_log};
//! use adsdv_oracle::rules::{RuleFile, RuleVerdict};
//!
//! let rules: RuleFile = "calm: never AS_STATE == AS_READY \"this car stays off\" # a comment".parse()?;
//! let log: String = (0..100).map(|n| format!("({}.{:02}) can0 520#00000{}0000000000\n", n / 50, n % 50 * 2, 1 + n / 60)).collect();
//! let options = LogOptions { rules: Some(rules), ..LogOptions::default() };
//! let report = judge_log(log.as_bytes(), &options, |_| {})?;
//! let [calm] = &report.rules[..] else { panic!("a rule") };
//! assert_eq!((calm.verdict(), calm.broken), (RuleVerdict::Broken, 1));
//! assert_eq!(calm.breaches[0].seen, "AS_STATE is AS_READY");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod error;
mod lex;
mod limits;
mod mistakes;
mod names;
mod number;
mod parse;
mod predicate;
mod report;
mod resolve;
mod runner;
mod syntax;
mod term;
#[cfg(test)]
mod tests;
mod track;
mod undecided;

use std::str::FromStr;
use std::sync::Arc;

use adsdv_spec::Edition;

pub use error::RuleError;
pub use mistakes::RuleErrors;
pub use report::{Breach, RuleReport, RuleVerdict};
pub(crate) use runner::Runner;
pub(crate) use undecided::GoHidden;

/// The rules of a file, as they were written.
///
/// Which edition they are for need not be known yet, as where a log is to tell it. So a name that some edition has can be read, and one
/// that none has cannot; once the edition is known, [`RuleFile::check`] tells what it has not.
///
/// ```
/// use adsdv_oracle::rules::RuleFile;
/// use adsdv_spec::Edition;
///
/// let rules: RuleFile = "slow: always VEH_SPEED_ACTUAL < 10 m/s\nstage: never EBS_STATE is EBS_FAULT".parse()?;
/// assert_eq!(rules.len(), 2);
/// rules.check(&Edition::V2026)?;
/// let errors = rules.check(&Edition::V4_0).unwrap_err();
/// assert_eq!((errors.first().line, errors.first().column), (2, 14));
/// assert!(errors.first().why.ends_with("edition 4.0 has no such signal; expected one that it has, or the edition that has this: 2026"));
/// # Ok::<(), adsdv_oracle::rules::RuleErrors>(())
/// ```
#[derive(Clone, Debug)]
pub struct RuleFile {
    rules: Arc<[syntax::RuleLine]>,
}

impl RuleFile {
    /// Reads the text of a file: at most 1000 lines of at most 2000 characters.
    ///
    /// # Errors
    ///
    /// Fails with all that is wrong with it, what the edition has not among that. Where no edition is given, what none has is wrong,
    /// and so is that none has all.
    pub fn read(text: &str, edition: Option<&Edition>) -> Result<Self, RuleErrors> {
        let scope = edition.map_or(resolve::Scope::Any, resolve::Scope::One);
        Ok(Self { rules: parse::file(text, scope)?.into() })
    }

    /// How many rules there are.
    pub fn len(&self) -> usize {
        self.rules.len()
    }

    /// Whether there is none. A file without a rule is refused, so there is always one.
    pub fn is_empty(&self) -> bool {
        self.rules.is_empty()
    }

    /// Whether an edition has every signal and every word that is named.
    ///
    /// # Errors
    ///
    /// Fails with all that it has not.
    pub fn check(&self, edition: &Edition) -> Result<(), RuleErrors> {
        resolve::all(&self.rules, edition).map(drop)
    }
}

impl FromStr for RuleFile {
    type Err = RuleErrors;

    /// Reads the text of a file whose edition is not known yet, as [`RuleFile::read`] does.
    fn from_str(text: &str) -> Result<Self, RuleErrors> {
        Self::read(text, None)
    }
}
