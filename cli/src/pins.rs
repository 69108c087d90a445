//! `--reading ID=CHOICE`: pins a question that the document leaves open.

use adsdv_spec::{Choice, Choices, Edition, Machine, Readings};

use crate::error::Error;

/// The choices of an edition that remain possible for a judge.
pub(crate) fn possible(edition: &Edition, pins: &[Choice]) -> Result<Choices, Error> {
    agree(edition, pins)?;
    Ok(pins.iter().copied().fold(edition.choices, Choices::pin))
}

/// The choices that remain possible for a judge who has yet to recognise the edition: each pin has to be an answer in one
/// edition at least. Whether it is one in the edition that is recognised, [`possible`] tells.
pub(crate) fn possible_in_some(default: &Edition, pins: &[Choice]) -> Result<Choices, Error> {
    match Edition::ALL.iter().find(|edition| agree(edition, pins).is_ok()) {
        Some(_) => Ok(pins.iter().copied().fold(default.choices, Choices::pin)),
        None => possible(default, pins),
    }
}

/// The answers of a machine: the defaults of its edition where nothing is pinned.
pub(crate) fn answers(edition: &Edition, pins: &[Choice]) -> Result<Readings, Error> {
    agree(edition, pins)?;
    Ok(pins.iter().copied().fold(edition.readings, Readings::with))
}

/// The machine of an edition with these answers.
pub(crate) fn machine(edition: &Edition, pins: &[Choice]) -> Result<Machine, Error> {
    answers(edition, pins).map(|readings| Machine::new(*edition, readings))
}

/// Fails where two pins contradict each other, or one the edition.
fn agree(edition: &Edition, pins: &[Choice]) -> Result<(), Error> {
    for (index, pin) in pins.iter().enumerate() {
        if !edition.choices.has(*pin) {
            let ids: Vec<&str> = edition.choices.of_reading(pin.reading()).map(Choice::id).collect();
            return Err(Error {
                what: format!("--reading {pin}"),
                why: format!(
                    "is no answer in edition {}; expected {}={}",
                    edition.version,
                    pin.reading().id(),
                    ids.join(" or ")
                ),
                hint: format!(
                    "`adsdv readings --edition {}` lists the choices that it leaves",
                    edition.version
                ),
            });
        }
        let before = pins.iter().take(index);
        if let Some(other) =
            before.into_iter().find(|other| other.reading() == pin.reading() && *other != pin)
        {
            return Err(Error {
                what: format!("--reading {pin}"),
                why: format!("{} is already pinned to {}", pin.reading().id(), other.id()),
                hint: "pin each reading once; `adsdv readings` lists the choices".to_owned(),
            });
        }
    }
    Ok(())
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
