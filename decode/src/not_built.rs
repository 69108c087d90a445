//! A format that this build has not.

use std::fmt;

/// The format is a feature of the build, which this one was built without.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NotBuilt {
    /// The format.
    pub format: &'static str,
    /// The feature of this crate, and of `adsdv`, that builds it in.
    pub feature: &'static str,
}

impl fmt::Display for NotBuilt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { format, feature } = self;
        write!(f, "this build does not write {format}: it was built without the feature {feature}")
    }
}

impl std::error::Error for NotBuilt {}
