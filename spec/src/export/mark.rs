//! What an arrow is, held against the document.

/// What an arrow of a drawing is, held against the document.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// The document's.
    Usual,
    /// Another than the document's.
    Differs,
    /// The document's, and not there.
    Missing,
}

impl Mark {
    /// What stands before the label of such an arrow.
    pub(super) const fn prefix(self) -> &'static str {
        match self {
            Self::Usual => "",
            Self::Differs => "DIFFERS\n",
            Self::Missing => "MISSING\n",
        }
    }
}
