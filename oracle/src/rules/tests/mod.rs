//! What the rules are to do: `parse` what a file may say, `mistakes` all that may be wrong with it, `names` what an edition has of it, `bounds` what each form comes to in
//! time, `less` that who knows less says less, and `recording` all of it on frames.

mod bounds;
mod go;
mod less;
mod mistakes;
mod names;
mod parse;
mod recording;

use adsdv_spec::Edition;

use super::{RuleError, RuleErrors, RuleFile};

/// All that is wrong with a file whose edition is not known.
fn mistakes(text: &str) -> RuleErrors {
    text.parse::<RuleFile>().expect_err(text)
}

/// The one mistake of a file whose edition is not known.
fn refused(text: &str) -> RuleError {
    only(text, &mistakes(text))
}

/// The one mistake of a file under an edition.
fn impossible(edition: &Edition, text: &str) -> RuleError {
    only(text, &RuleFile::read(text, Some(edition)).expect_err(text))
}

fn only(text: &str, errors: &RuleErrors) -> RuleError {
    assert_eq!((errors.iter().count(), errors.more()), (1, 0), "{text}: {errors}");
    errors.first().clone()
}
