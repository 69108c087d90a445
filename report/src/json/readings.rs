//! The questions that an edition leaves open.

use adsdv_spec::{Choice, Edition, Reading};
use serde::Serialize;

use super::SCHEMA;

/// The questions that an edition leaves open as `adsdv readings --json` prints them.
#[derive(Serialize)]
pub struct ReadingsJson {
    schema: u32,
    edition: &'static str,
    readings: Vec<ReadingJson>,
}

#[derive(Serialize)]
struct ReadingJson {
    id: &'static str,
    section: &'static str,
    question: &'static str,
    choices: Vec<ChoiceJson>,
}

#[derive(Serialize)]
struct ChoiceJson {
    id: &'static str,
    text: &'static str,
    default: bool,
}

impl ReadingsJson {
    /// The questions of this edition.
    pub fn new(edition: &Edition) -> Self {
        Self {
            schema: SCHEMA,
            edition: edition.version,
            readings: edition.questions().map(|reading| ReadingJson::of(edition, reading)).collect(),
        }
    }
}

impl ReadingJson {
    fn of(edition: &Edition, reading: Reading) -> Self {
        Self {
            id: reading.id(),
            section: reading.section(),
            question: reading.question(),
            choices: edition
                .choices
                .of_reading(reading)
                .map(|choice| ChoiceJson::of(edition, choice))
                .collect(),
        }
    }
}

impl ChoiceJson {
    fn of(edition: &Edition, choice: Choice) -> Self {
        Self { id: choice.id(), text: choice.text(), default: edition.readings.is(choice) }
    }
}
