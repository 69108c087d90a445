//! What is known of the faults.

use crate::faults::{Fault, Faults};
use crate::truth::Truth;

/// What is known of all faults: those known to be present, those known not to be, the rest unknown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct KnownFaults {
    present: Faults,
    absent: Faults,
}

impl KnownFaults {
    /// Nothing is known of any fault.
    pub const NOTHING: Self = Self { present: Faults::NONE, absent: Faults::NONE };

    /// These faults are known to be present and those not to be; one that is said to be both is present.
    pub const fn new(present: Faults, absent: Faults) -> Self {
        Self { present, absent: absent.difference(present) }
    }

    /// Everything is known: the faults of the set are present, all others are not.
    pub const fn exact(faults: Faults) -> Self {
        Self { present: faults, absent: Faults::ALL.difference(faults) }
    }

    /// The faults known to be present.
    pub const fn present(self) -> Faults {
        self.present
    }

    /// The faults known not to be present.
    pub const fn absent(self) -> Faults {
        self.absent
    }

    /// The faults that may be present.
    pub const fn possible(self) -> Faults {
        Faults::ALL.difference(self.absent)
    }

    /// What is known of one fault.
    pub const fn of(self, fault: Fault) -> Truth {
        self.any_of(Faults::NONE.with(fault))
    }

    /// Whether one of these faults is present.
    pub const fn any_of(self, faults: Faults) -> Truth {
        if !self.present.intersection(faults).is_empty() {
            Truth::True
        } else if faults.is_subset(self.absent) {
            Truth::False
        } else {
            Truth::Unknown
        }
    }

    /// Whether exactly these may be the faults.
    pub const fn allows(self, faults: Faults) -> bool {
        self.present.is_subset(faults) && self.absent.intersection(faults).is_empty()
    }

    /// Whether this allows all that the other does.
    pub const fn covers(self, other: Self) -> bool {
        self.present.is_subset(other.present) && self.absent.is_subset(other.absent)
    }

    /// What is known of these alone: all others are absent.
    #[must_use]
    pub const fn of_these(self, faults: Faults) -> Self {
        Self {
            present: self.present.intersection(faults),
            absent: self.absent.union(Faults::ALL.difference(faults)),
        }
    }

    /// What is known when either may be what was so.
    #[must_use]
    pub const fn or(self, other: Self) -> Self {
        Self {
            present: self.present.intersection(other.present),
            absent: self.absent.intersection(other.absent),
        }
    }

    /// What is known of the faults of both together.
    #[must_use]
    pub const fn together(self, other: Self) -> Self {
        Self { present: self.present.union(other.present), absent: self.absent.intersection(other.absent) }
    }
}
