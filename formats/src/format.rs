//! Which format a recording has, by how it begins.

use std::fmt;

use crate::blf;

/// How a file of MCAP begins, and ends.
const MCAP: &[u8] = b"\x89MCAP0\r\n";

/// A format that is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Format {
    /// The text of candump (can-utils): of `candump -L`, or as it prints for a person.
    Candump,
    /// The binary log of Vector's tools.
    Blf,
    /// The container that ROS 2 records into.
    Mcap,
}

impl Format {
    /// Every format.
    pub const ALL: [Self; 3] = [Self::Candump, Self::Blf, Self::Mcap];

    /// Its name, as people know it.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Candump => "candump",
            Self::Blf => "Vector BLF",
            Self::Mcap => "MCAP",
        }
    }

    /// The format of a recording that begins so; that of candump where nothing else fits, since it can say of any text what it is not.
    pub(crate) fn of(head: &[u8]) -> Self {
        if head.starts_with(blf::MAGIC) {
            Self::Blf
        } else if head.starts_with(MCAP) {
            Self::Mcap
        } else {
            Self::Candump
        }
    }
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
