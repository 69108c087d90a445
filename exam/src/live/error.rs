//! Why an exam in real time ends early.

use std::fmt;

use adsdv_can::bus::Disturbance;
use adsdv_can::socket::OpenError;

/// Why an exam in real time cannot begin, or ends early: what was given, what is wrong with it, and what to do.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LiveError {
    /// The interface, or the program.
    pub what: String,
    /// What is wrong, and what was expected.
    pub why: String,
    /// What to do.
    pub hint: String,
}

impl LiveError {
    pub(super) fn new(what: &str, why: impl Into<String>, hint: impl Into<String>) -> Self {
        Self { what: what.to_owned(), why: why.into(), hint: hint.into() }
    }

    /// Something happened to the bus.
    pub(super) fn disturbed(bus: &str, disturbance: &Disturbance, scenario: &str, time_ms: u64) -> Self {
        let hint = match disturbance {
            Disturbance::Full => {
                "somebody has to acknowledge the frames on a bus of hardware: check the plug, the terminators and the bit rate"
            }
            Disturbance::BusOff => "check the wiring and the bit rate: ip -details link show",
            Disturbance::Down | Disturbance::Gone | Disturbance::Other(_) => {
                "leave the interface up until the exam is over; --namespace makes one that nobody else can take down"
            }
        };
        let (seconds, rest) = (time_ms / 1000, time_ms % 1000);
        Self::new(bus, format!("{disturbance}, in {scenario} at {seconds}.{rest:03} s"), hint)
    }
}

impl From<OpenError> for LiveError {
    fn from(OpenError { what, why, hint }: OpenError) -> Self {
        Self { what, why, hint }
    }
}

impl fmt::Display for LiveError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { what, why, hint } = self;
        write!(f, "{what}: {why}\nhint: {hint}")
    }
}

impl std::error::Error for LiveError {}
