//! A scenario with a name, and what it is for.

use std::fmt;

use adsdv_spec::Reading;

use super::Scenario;

/// What a test is generated for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Kind {
    /// A row of Figure 2, or an alternative of one.
    Row,
    /// A condition that decides on its own.
    Condition,
    /// A threshold of a measured value, or a timer: just below, at, and just above.
    Limit,
    /// Two rows that hold at once.
    Pair,
    /// Something for which Figure 2 has no arrow.
    NoArrow,
    /// A phase of the handshake.
    Handshake,
    /// A fault, its flag and its cause.
    Fault,
    /// What is shown in each state, and for each value: what reaches the actuators, and what 520h tells.
    Output,
    /// A question that the document leaves open.
    Reading,
    /// What somebody wants to know: a test that was written, and not generated.
    Written,
}

impl Kind {
    /// Every kind.
    pub const ALL: [Self; 10] = [
        Self::Row,
        Self::Condition,
        Self::Limit,
        Self::Pair,
        Self::NoArrow,
        Self::Handshake,
        Self::Fault,
        Self::Output,
        Self::Reading,
        Self::Written,
    ];

    /// The stable name, such as `row`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Row => "row",
            Self::Condition => "condition",
            Self::Limit => "limit",
            Self::Pair => "pair",
            Self::NoArrow => "no-arrow",
            Self::Handshake => "handshake",
            Self::Fault => "fault",
            Self::Output => "output",
            Self::Reading => "reading",
            Self::Written => "written",
        }
    }
}

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// A test of the suite.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Test {
    /// The stable name, such as `3.7-go-off`.
    pub name: String,
    /// What it is generated for.
    pub kind: Kind,
    /// What it checks, in one sentence.
    pub about: String,
    /// The section of the document, such as `3.7`.
    pub section: String,
    /// The requirements that it checks, as `spec/REQUIREMENTS.md` numbers them.
    pub requirements: Vec<String>,
    /// The question whose answers the test tells apart, if that is what it is for.
    pub reading: Option<Reading>,
    /// The steps.
    pub scenario: Scenario,
}
