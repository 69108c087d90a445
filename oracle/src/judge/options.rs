//! What the judge may assume.

use adsdv_spec::{Choices, Edition};

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
}

impl Default for JudgeOptions {
    fn default() -> Self {
        Self { edition: Edition::DEFAULT, window_ms: 30, deadline_ms: 50, readings: Choices::ALL }
    }
}
