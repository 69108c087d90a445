//! Margins: how close the run came to its limits, whether or not it went past one.
//!
//! `kept.rs` keeps the worst of each measure while the bus goes on, in memory that does not grow; `notice.rs` is where the judge
//! notices what is worth keeping; `list.rs` makes the margins of it. A value past its limit is one only where the judge has
//! reported it: in what is not certain, nobody came close to anything.

mod kept;
mod list;
mod notice;

pub(super) use kept::{AT_SPEED, Kept};

use super::finding::Party;

macro_rules! measures {
    ($($(#[$doc:meta])* $measure:ident = $id:literal, $needs:ident;)*) => {
        /// What was measured. The identifiers are stable.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum Measure { $($(#[$doc])* $measure,)* }

        impl Measure {
            /// Every measure.
            pub const ALL: &'static [Self] = &[$(Self::$measure),*];

            /// The stable identifier, such as `ready-dwell`.
            pub const fn id(self) -> &'static str {
                match self { $(Self::$measure => $id,)* }
            }

            /// Which side of the limit is the right one.
            pub const fn needs(self) -> Needs {
                match self { $(Self::$measure => Needs::$needs,)* }
            }
        }
    };
}

/// Which side of a limit is the right one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Needs {
    /// The value is to be no higher.
    AtMost,
    /// The value is to be no lower.
    AtLeast,
}

measures! {
    /// The slowest answer to an edge of the handshake.
    HandshakeAnswer = "handshake-answer", AtMost;
    /// The longest time between two frames of a message.
    MessageGap = "message-gap", AtMost;
    /// The longest time from a condition of an arrow to EMERGENCY_BRAKE to that state.
    SlowestReaction = "slowest-reaction", AtMost;
    /// The shortest such time.
    FastestReaction = "fastest-reaction", AtMost;
    /// The highest wheel speed at which FINISHED was declared in AS_DRIVING.
    FinishedSpeed = "finished-speed", AtMost;
    /// The highest wheel speed at which NEUTRAL was requested in AS_DRIVING.
    NeutralSpeed = "neutral-speed", AtMost;
    /// The steer angle, to either side, at which AS_DRIVING was entered.
    SteerAtGo = "steer-at-go", AtMost;
    /// The shortest time of AS_READY before AS_DRIVING, from when another state was shown last.
    ReadyDwell = "ready-dwell", AtLeast;
}

/// Where a limit is from. What only has a cycle stands behind what has a limit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Basis {
    /// The edition of the document.
    Document,
    /// The judge's own deadline for an effect, for the document has none.
    Deadline,
    /// The cycle of a message, for which the edition has no limit.
    Cycle,
}

impl Basis {
    /// `document`, `deadline` or `cycle`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Document => "document",
            Self::Deadline => "deadline",
            Self::Cycle => "cycle",
        }
    }
}

/// How close the run came to one limit.
#[derive(Clone, Debug, PartialEq)]
pub struct Margin {
    /// What was measured.
    pub what: Measure,
    /// The identifier of the message that it was measured of, where there are several.
    pub message: Option<u16>,
    /// Whose margin it is.
    pub party: Party,
    /// The section of the document.
    pub section: &'static str,
    /// The requirements behind the limit, as `spec/REQUIREMENTS.md` has them; none behind a cycle.
    pub requirements: Vec<&'static str>,
    /// The worst value.
    pub value: f64,
    /// The limit.
    pub limit: f64,
    /// The unit of both.
    pub unit: &'static str,
    /// Where the limit is from.
    pub basis: Basis,
    /// When the value was seen, in nanoseconds since the first frame.
    pub t_ns: i64,
}

impl Margin {
    /// The share of the limit that was left: 0 at the limit, negative past it.
    pub fn left(&self) -> f64 {
        let left = match self.what.needs() {
            Needs::AtMost => self.limit - self.value,
            Needs::AtLeast => self.value - self.limit,
        };
        if self.limit > 0.0 { left / self.limit } else { left }
    }

    /// The closest first; those of a cycle last.
    fn order(&self, other: &Self) -> std::cmp::Ordering {
        let cycle = |margin: &Self| margin.basis == Basis::Cycle;
        cycle(self).cmp(&cycle(other)).then(self.left().total_cmp(&other.left()))
    }
}
