//! Who sends a message.

use core::fmt;

use crate::derives::data;

data!(
    /// Who sends a message.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
    pub enum Node {
        /// The AI Computer.
        #[cfg_attr(feature = "serde", serde(rename = "AI"))]
        Ai,
        /// The Vehicle Control Unit.
        #[cfg_attr(feature = "serde", serde(rename = "VCU"))]
        Vcu,
    }
);

impl Node {
    /// The name of the node in the CAN database.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Ai => "AI",
            Self::Vcu => "VCU",
        }
    }
}

impl fmt::Display for Node {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}
