//! `--reading ID=CHOICE`: pins a question that the document leaves open.

use adsdv_spec::{Choice, Choices, Reading, Readings};

use crate::error::Error;

/// Reads `ID=CHOICE`.
pub(crate) fn parse(text: &str) -> Result<Choice, String> {
    let Some((id, choice)) = text.split_once('=') else {
        return Err(format!("expected ID=CHOICE, such as {}; ids: {}", Choice::FaultEdge, readings()));
    };
    let Some(reading) = Reading::ALL.iter().find(|reading| reading.id() == id) else {
        return Err(format!("no reading has the id {id:?}; expected one of {}", readings()));
    };
    Choice::find(id, choice)
        .ok_or_else(|| format!("{id} has no choice {choice:?}; expected one of {}", choices(*reading)))
}

fn readings() -> String {
    list(Reading::ALL.iter().map(|reading| reading.id()))
}

fn choices(reading: Reading) -> String {
    list(reading.choices().iter().map(|choice| choice.id()))
}

fn list<'a>(ids: impl Iterator<Item = &'a str>) -> String {
    ids.collect::<Vec<_>>().join(", ")
}

/// The choices that remain possible for a judge.
pub(crate) fn possible(pins: &[Choice]) -> Result<Choices, Error> {
    agree(pins)?;
    Ok(pins.iter().copied().fold(Choices::ALL, Choices::pin))
}

/// The answers of a machine: the defaults where nothing is pinned.
pub(crate) fn answers(pins: &[Choice]) -> Result<Readings, Error> {
    agree(pins)?;
    Ok(pins.iter().copied().fold(Readings::DEFAULT, Readings::with))
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
                hint: "pin each reading once; without a pin, the judge allows for every choice".to_owned(),
            });
        }
    }
    Ok(())
}
