//! `--reading ID=CHOICE`: pins a question that the document leaves open.

use adsdv_report::asked::{self, PinError};
use adsdv_spec::{Choice, Choices, Edition, Machine, Readings};

use crate::error::Error;

/// The choices of an edition that remain possible for a judge.
pub(crate) fn possible(edition: &Edition, pins: &[Choice]) -> Result<Choices, Error> {
    asked::possible(edition, pins).map_err(|error| refused(&error))
}

/// The choices that remain possible for a judge who has yet to recognise the edition.
pub(crate) fn possible_in_some(default: &Edition, pins: &[Choice]) -> Result<Choices, Error> {
    asked::possible_in_some(default, pins).map_err(|error| refused(&error))
}

/// The answers of a machine: the defaults of its edition where nothing is pinned.
pub(crate) fn answers(edition: &Edition, pins: &[Choice]) -> Result<Readings, Error> {
    asked::agree(edition, pins).map_err(|error| refused(&error))?;
    Ok(pins.iter().copied().fold(edition.readings, Readings::with))
}

/// The machine of an edition with these answers.
pub(crate) fn machine(edition: &Edition, pins: &[Choice]) -> Result<Machine, Error> {
    answers(edition, pins).map(|readings| Machine::new(*edition, readings))
}

/// What to do about readings that cannot be pinned so.
pub(crate) fn refused(error: &PinError) -> Error {
    let hint = match error {
        PinError::NoAnswer { edition, .. } => {
            format!("`adsdv readings --edition {edition}` lists the choices that it leaves")
        }
        PinError::Twice { .. } => "pin each reading once; `adsdv readings` lists the choices".to_owned(),
    };
    Error { what: format!("--reading {}", error.pin()), why: error.to_string(), hint }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_answer_that_the_edition_does_not_leave_is_refused_with_those_that_it_does() {
        let settled = Edition {
            version: "test",
            choices: Edition::V3_0.choices.without(Choice::GoEdgeEnough),
            ..Edition::V3_0
        };
        assert!(answers(&settled, &[Choice::GoRaw]).is_ok());
        for refused in [
            answers(&settled, &[Choice::GoEdgeEnough]).err(),
            possible(&settled, &[Choice::GoEdgeEnough]).err(),
        ] {
            let error = refused.expect("it is settled").to_string();
            let said =
                "--reading go-edge=edge: is no answer in edition test; expected go-edge=seen-low\nhint: ";
            assert!(error.starts_with(said) && error.contains("--edition test"), "{error}");
        }
    }
}
