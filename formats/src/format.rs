//! Which format a recording has, by how it begins.

use std::fmt;

/// A format that is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Format {
    /// The text of candump (can-utils): of `candump -L`, or as it prints for a person.
    Candump,
}

impl Format {
    /// Every format.
    pub const ALL: [Self; 1] = [Self::Candump];

    /// Its name, as people know it.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Candump => "candump",
        }
    }

    /// The format of a recording that begins so; that of candump where nothing else fits, since it can say of any text what it is not.
    pub(crate) fn of(_head: &[u8]) -> Self {
        Self::Candump
    }
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
