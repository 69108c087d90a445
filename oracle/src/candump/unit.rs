//! What a log is made of.

use std::fmt;

/// What a log is made of, by which an entry has its place.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Unit {
    /// Lines of text, with columns.
    #[default]
    Line,
    /// Objects of a binary file (BLF), with bytes.
    Object,
    /// Records of a binary file (MCAP), with bytes.
    Record,
}

impl Unit {
    /// `line`, `object` or `record`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Line => "line",
            Self::Object => "object",
            Self::Record => "record",
        }
    }

    /// What a place within one is called: `column` or `byte`.
    pub const fn part(self) -> &'static str {
        match self {
            Self::Line => "column",
            Self::Object | Self::Record => "byte",
        }
    }
}

impl fmt::Display for Unit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
