//! Why there is no answer.

use adsdv_formats::{Format, OpenError};
use adsdv_oracle::log::LogError;
use adsdv_report::asked::PinError;
use serde::Serialize;

/// What to give, for everybody who gave something else.
const GIVE: &str = "give a recording of candump, Vector (ASC, BLF), PEAK (TRC), python-can and SavvyCAN (CSV) or ROS 2 (MCAP), also \
                    compressed with gzip or Zstandard";

/// What was given, what is wrong with it, and what to do.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub(crate) struct Refusal {
    what: String,
    why: String,
    hint: String,
}

impl Refusal {
    pub(crate) fn new(what: impl Into<String>, why: impl Into<String>, hint: impl Into<String>) -> Self {
        Self { what: what.into(), why: why.into(), hint: hint.into() }
    }

    /// The page asks for what there is not.
    pub(crate) fn of_request(why: impl Into<String>) -> Self {
        Self::new("the request", why, "load the page again: it and the judge are of different versions")
    }

    /// What cannot be opened.
    pub(crate) fn open(name: &str, error: &OpenError) -> Self {
        let hint = match error {
            OpenError::Read(_) => {
                "choose the file again: it may have changed since, or may be on a disk that is gone"
            }
            OpenError::Foreign(foreign) => foreign.hint,
            OpenError::NotBuilt { .. } => GIVE,
        };
        Self::new(name, error.to_string(), hint)
    }

    /// What can be opened, and not judged.
    pub(crate) fn log(name: &str, error: &LogError) -> Self {
        let hint = match error {
            LogError::Read(_) => "see whether the file is whole; what cannot be read costs the rest of it",
            LogError::NoFrame { .. } => GIVE,
            LogError::NoSuchInterface { .. } | LogError::Rules(_) => "ask for less",
        };
        Self::new(name, error.to_string(), hint)
    }

    /// A reading that cannot be pinned.
    pub(crate) fn pin(error: &PinError) -> Self {
        Self::new(
            format!("reading {}", error.pin()),
            error.to_string(),
            "choose another answer, or another edition",
        )
    }
}

/// The formats that are read, as people know them.
pub(crate) fn formats() -> Vec<&'static str> {
    Format::ALL.map(Format::name).into()
}
