//! The combinations of readings.

use adsdv_spec::{Choices, Edition, Reading, Readings};

/// Every combination of the readings that can matter to each other. `go-signal` changes what 520h tells and no control
/// state, so that its choices need no company.
pub(super) fn combinations(edition: &Edition) -> Vec<Readings> {
    let together: Vec<Reading> =
        Reading::ALL.iter().copied().filter(|reading| *reading != Reading::GoSignal).collect();
    let alone = edition.alternatives().of_reading(Reading::GoSignal);
    let alone = alone.map(|choice| edition.readings.with(choice));
    // The answer to `go-signal` is the default in all of these.
    let any = edition.choices.pin(edition.readings.choice(Reading::GoSignal));
    alone.chain(any.combinations(&together)).collect()
}

/// The choices that are not the default.
pub(super) fn others(edition: &Edition, readings: Readings) -> Choices {
    readings.choices().difference(edition.readings.choices())
}
