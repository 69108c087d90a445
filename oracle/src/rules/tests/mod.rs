//! What the rules are to do: `parse` what a file may say, `names` what an edition has of it, `bounds` what each form comes to in
//! time, `less` that who knows less says less, and `recording` all of it on frames.

mod bounds;
mod less;
mod names;
mod parse;
mod recording;

use adsdv_spec::Edition;

use super::{RuleError, RuleFile};

/// Why a file is refused.
fn refused(text: &str) -> RuleError {
    text.parse::<RuleFile>().expect_err(text)
}

/// Why the rules of a file are refused under an edition.
fn impossible(edition: &Edition, text: &str) -> RuleError {
    text.parse::<RuleFile>().expect(text).check(edition).expect_err(text)
}
