//! How something looks that is said of a run, or of a program.

use serde::Serialize;

/// How an answer looks; its words say it all.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Mood {
    /// As it should be.
    Good,
    /// Worth a look.
    Care,
    /// Not as it should be.
    Bad,
    /// Not known, or not there.
    Unknown,
}
