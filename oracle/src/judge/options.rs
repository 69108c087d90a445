//! What the judge may assume.

use adsdv_spec::{Choices, Edition, Reading};

/// How the judge looks at a log.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct JudgeOptions {
    /// The edition of the interface that the VCU and the AI Computer are judged by.
    pub edition: &'static Edition,
    /// The window W in milliseconds: how long after a cause its effect may be seen (VCU cycle plus bus delay).
    pub window_ms: u32,
    /// The deadline D in milliseconds: for how long a condition must hold before a missing effect is a violation.
    pub deadline_ms: u32,
    /// The readings of the document that the VCU may follow. A violation is what is one under all of them.
    pub readings: Choices,
    /// Whether somebody vouches that the recording has every frame that was on the bus: then what was shown last counts until
    /// something else is shown, or for half a second, and nothing is excused by a frame that may be missing.
    pub complete: bool,
}

impl JudgeOptions {
    /// How a bus of an edition is judged where nobody asks for something else.
    ///
    /// ```
    /// use adsdv_oracle::judge::JudgeOptions;
    /// use adsdv_spec::Edition;
    /// assert_eq!(JudgeOptions::of(&Edition::V3_0).readings, Edition::V3_0.choices);
    /// ```
    pub const fn of(edition: &'static Edition) -> Self {
        Self { edition, window_ms: 30, deadline_ms: 50, readings: edition.choices, complete: false }
    }

    /// The same for a bus of another edition. Questions that were answered stay answered where the edition has that answer; all
    /// others are as open as the edition leaves them.
    ///
    /// ```
    /// use adsdv_oracle::judge::JudgeOptions;
    /// use adsdv_spec::{Choice, Edition};
    ///
    /// let before = JudgeOptions::of(&Edition::V3_0);
    /// assert_eq!(before.under(&Edition::V4_0), JudgeOptions::of(&Edition::V4_0));
    /// let pinned = JudgeOptions { readings: before.readings.pin(Choice::CommsDriving), ..before };
    /// assert!(!pinned.under(&Edition::V4_0).readings.has(Choice::CommsEveryState));
    /// ```
    #[must_use]
    pub fn under(self, edition: &'static Edition) -> Self {
        let mut readings = edition.choices;
        for &reading in Reading::ALL {
            let of = |choices: Choices| choices.intersection(Choices::of(reading.choices()));
            let possible = of(self.readings.intersection(edition.choices));
            if of(self.readings) != of(self.edition.choices) && !possible.is_empty() {
                readings = readings.difference(of(edition.choices)).union(possible);
            }
        }
        Self { edition, readings, ..self }
    }
}

impl Default for JudgeOptions {
    /// Those of the [default edition](Edition::DEFAULT).
    fn default() -> Self {
        Self::of(Edition::DEFAULT)
    }
}
