//! How a program is judged, and how far that is.

use std::time::Duration;

use adsdv_spec::{Choices, Edition};

/// How a program is judged.
#[derive(Clone, Debug)]
pub struct ConformOptions {
    /// The version of the document.
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
    /// How long the search for shorter scenarios may take in all.
    pub shrinking: Duration,
}

impl Default for ConformOptions {
    fn default() -> Self {
        Self {
            edition: *Edition::DEFAULT,
            possible: Edition::DEFAULT.choices,
            latency: 0,
            cycle_ms: None,
            seed: 1,
            runs: 300,
            shrinking: Duration::from_secs(10),
        }
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
