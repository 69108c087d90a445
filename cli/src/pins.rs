//! `--reading ID=CHOICE`: pins a question that the document leaves open.

use adsdv_spec::{Choice, Choices, Edition, Readings};

use crate::error::Error;

/// The choices that remain possible for a judge.
pub(crate) fn possible(pins: &[Choice]) -> Result<Choices, Error> {
    agree(pins)?;
    Ok(pins.iter().copied().fold(Edition::DEFAULT.choices, Choices::pin))
}

/// The answers of a machine: the defaults where nothing is pinned.
pub(crate) fn answers(pins: &[Choice]) -> Result<Readings, Error> {
    agree(pins)?;
    Ok(pins.iter().copied().fold(Edition::DEFAULT.readings, Readings::with))
}

/// Fails where two pins contradict each other.
fn agree(pins: &[Choice]) -> Result<(), Error> {
    for (index, pin) in pins.iter().enumerate() {
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
