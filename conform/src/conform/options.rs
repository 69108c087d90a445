//! How a program is judged, and how far that is.

use std::time::Duration;

use adsdv_spec::{Choices, Edition};

/// How a program is judged.
#[derive(Clone, Debug)]
pub struct ConformOptions {
    /// The edition of the interface that the program is to be of.
    pub edition: Edition,
    /// The choices of readings that are allowed for.
    pub possible: Choices,
    /// How many steps late its outputs may be.
    pub latency: usize,
    /// The cycle at which it steps, in milliseconds; `None`: any time may pass between two steps.
    pub cycle_ms: Option<u32>,
    /// The seed of the random scenarios.
    pub seed: u64,
    /// How many random scenarios there are.
    pub runs: u32,
    /// Whether what is only against a decision of ours, where the document is silent, is a failure as well.
    pub strict: bool,
    /// How long the tests may take for a program whose time is that of a clock on the wall.
    pub wall_time: Duration,
    /// How long the search for shorter scenarios may take in all.
    pub shrinking: Duration,
}

impl ConformOptions {
    /// How a program of an edition is judged where nobody asks for something else.
    ///
    /// ```
    /// use adsdv_conform::ConformOptions;
    /// use adsdv_spec::Edition;
    /// assert_eq!(ConformOptions::of(&Edition::V3_0).possible, Edition::V3_0.choices);
    /// ```
    pub const fn of(edition: &Edition) -> Self {
        Self {
            edition: *edition,
            possible: edition.choices,
            latency: 0,
            cycle_ms: None,
            seed: 1,
            runs: 300,
            strict: false,
            wall_time: Duration::from_mins(5),
            shrinking: Duration::from_secs(10),
        }
    }
}

impl Default for ConformOptions {
    /// Those of the [default edition](Edition::DEFAULT).
    fn default() -> Self {
        Self::of(Edition::DEFAULT)
    }
}

/// How far it is.
#[derive(Clone, Copy, Debug)]
pub struct ConformProgress {
    /// What is being done.
    pub phase: Phase,
    /// How much of it is done.
    pub done: usize,
    /// How much there is.
    pub all: usize,
}

/// What is being done.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    /// The tests of the suite.
    Suite,
    /// The random scenarios.
    Random,
    /// The search for shorter scenarios that fail.
    Shrinking,
}
