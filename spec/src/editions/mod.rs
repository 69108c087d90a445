//! The editions of the interface: a folder for each, in which it stands as what it changes.

mod v3_0;

pub use v3_0::V3_0;

use crate::edition::Edition;

impl Edition {
    /// Every edition, the oldest first.
    pub const ALL: &'static [&'static Self] = &[&Self::V3_0];

    /// The edition that holds where nothing names another and no recording tells.
    pub const DEFAULT: &'static Self = &Self::V3_0;
}
