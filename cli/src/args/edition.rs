//! `--edition` and `ADSDV_EDITION`: the edition of the interface that a command is about.

use std::ffi::OsStr;
use std::fmt;

use adsdv_spec::Edition;
use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};

use crate::error::Error;

/// The edition where nobody chooses one: this program names it here and nowhere else.
const DEFAULT: &Edition = Edition::DEFAULT;

/// The variable that has a user's own default.
pub(crate) const VARIABLE: &str = "ADSDV_EDITION";

/// The option, for every command that depends on the edition.
#[derive(Args, Clone, Copy, Debug, Default)]
pub(crate) struct EditionArgs {
    /// The edition of the interface
    #[arg(long, value_name = "VERSION", value_parser = known(), help = help())]
    edition: Option<&'static Edition>,
}

/// The option, for every command that recognises the edition by the frames.
#[derive(Args, Clone, Copy, Debug, Default)]
pub(crate) struct RecognisedArgs {
    /// The edition of the interface
    #[arg(long, value_name = "VERSION", value_parser = known(), help = help_where_recognised())]
    edition: Option<&'static Edition>,
}

fn help() -> String {
    format!("The edition of the interface [default: what {VARIABLE} says, or {}]", DEFAULT.version)
}

fn help_where_recognised() -> String {
    format!("The edition of the interface [default: what {VARIABLE} says, or the one that the frames tell]")
}

impl RecognisedArgs {
    /// The edition that was asked for, as [`EditionArgs::chosen`] has it; where nobody asked for one, the frames tell.
    pub(crate) fn chosen(self) -> Result<ChosenEdition, Error> {
        EditionArgs { edition: self.edition }.chosen()
    }
}

/// Reads the version of an edition; an unknown one is refused with those that there are.
pub(super) fn known() -> impl TypedValueParser<Value = &'static Edition> {
    PossibleValuesParser::new(Edition::ALL.iter().map(|edition| edition.version))
        .try_map(|version| Edition::find(&version).ok_or("there is no such edition"))
}

impl EditionArgs {
    /// The edition that was asked for: with the option, or else in the environment.
    pub(crate) fn chosen(self) -> Result<ChosenEdition, Error> {
        match self.edition {
            Some(edition) => Ok(ChosenEdition { edition, by_default: false }),
            None => of_environment(std::env::var_os(VARIABLE).as_deref()),
        }
    }
}

/// The edition that the environment asks for. A variable that is empty is not set, as with `NO_COLOR`.
fn of_environment(value: Option<&OsStr>) -> Result<ChosenEdition, Error> {
    let Some(value) = value.filter(|value| !value.is_empty()) else {
        return Ok(ChosenEdition { edition: DEFAULT, by_default: true });
    };
    match value.to_str().and_then(Edition::find) {
        Some(edition) => Ok(ChosenEdition { edition, by_default: false }),
        None => Err(Error {
            what: VARIABLE.to_owned(),
            // As in a program, so that nothing in it reaches a terminal.
            why: format!(
                "there is no edition {:?}; expected one of {}",
                value.to_string_lossy(),
                versions(Edition::ALL)
            ),
            hint: format!("set {VARIABLE} to one of these, or unset it; --edition counts before it"),
        }),
    }
}

fn versions(editions: &[&Edition]) -> String {
    editions.iter().map(|edition| edition.version).collect::<Vec<_>>().join(", ")
}

/// An edition, and whether somebody asked for it. It displays as the line with which an answer begins.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ChosenEdition {
    edition: &'static Edition,
    by_default: bool,
}

impl ChosenEdition {
    /// The edition.
    pub(crate) const fn edition(self) -> &'static Edition {
        self.edition
    }

    /// Its version, if somebody asked for it.
    pub(crate) const fn asked_for(self) -> Option<&'static str> {
        if self.by_default { None } else { Some(self.edition.version) }
    }

    /// The line, where these are the editions that there are.
    fn line(self, all: &[&Edition]) -> String {
        let version = self.edition.version;
        match all.last().map(|newest| newest.version) {
            _ if !self.by_default => format!("edition {version}"),
            Some(newest) if newest != version => {
                format!("edition {version} (default; --edition {newest} for today's car)")
            }
            _ => format!("edition {version} (default)"),
        }
    }
}

impl fmt::Display for ChosenEdition {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.line(Edition::ALL))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const NEWER: Edition = Edition { version: "test", ..Edition::V3_0 };

    #[test]
    fn the_line_says_what_was_chosen_and_what_a_default_may_miss() {
        let line = |edition, by_default, all: &[&Edition]| ChosenEdition { edition, by_default }.line(all);
        let (old, both) = (&Edition::V3_0, [&Edition::V3_0, &NEWER]);
        assert_eq!(line(old, false, &both), "edition 3.0");
        assert_eq!(line(old, true, &both), "edition 3.0 (default; --edition test for today's car)");
        assert_eq!(line(&NEWER, true, &both), "edition test (default)");
        assert_eq!(line(&NEWER, false, &both), "edition test");
        assert_eq!(line(old, true, &[old]), "edition 3.0 (default)");
    }

    #[test]
    fn an_empty_variable_is_none() {
        for value in [None, Some(OsStr::new(""))] {
            let chosen = of_environment(value).expect("the default");
            assert!(chosen.by_default && chosen.edition == Edition::DEFAULT);
        }
    }
}
