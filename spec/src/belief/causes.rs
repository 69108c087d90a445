//! What `SHUTDOWN_CAUSE` may be.

use crate::belief::KnownFaults;
use crate::faults::{Fault, Faults};
use crate::messages::ShutdownCause;

/// What `SHUTDOWN_CAUSE` may be.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Causes {
    /// Whether it may be NO SHUTDOWN.
    pub none: bool,
    /// The faults that it may name.
    pub faults: Faults,
}

impl Causes {
    /// Any cause.
    pub const ANY: Self = Self { none: true, faults: Faults::ALL };

    /// This one and no other.
    pub const fn exact(cause: ShutdownCause) -> Self {
        let faults = Faults::of_cause(cause);
        Self { none: faults.is_empty(), faults }
    }

    /// Whether it may be this one.
    pub const fn allows(self, cause: ShutdownCause) -> bool {
        match Fault::of_cause(cause) {
            Some(fault) => self.faults.has(fault),
            None => self.none,
        }
    }

    /// Whether this allows all that the other does.
    pub const fn covers(self, other: Self) -> bool {
        (self.none || !other.none) && other.faults.is_subset(self.faults)
    }

    /// Whether it may be none at all.
    pub const fn is_empty(self) -> bool {
        !self.none && self.faults.is_empty()
    }

    /// What is known when either may be what was so.
    #[must_use]
    pub const fn or(self, other: Self) -> Self {
        Self { none: self.none || other.none, faults: self.faults.union(other.faults) }
    }

    /// What the cause may be of a shutdown for all faults that are present: the one with the lowest number. `some`: there is
    /// one at least.
    pub const fn first_of(faults: KnownFaults, some: bool) -> Self {
        match Fault::of_cause(faults.present().cause()) {
            // None behind the first that is certain can be the first of all.
            Some(first) => Self { none: false, faults: faults.possible().up_to(first) },
            None => Self { none: !some, faults: faults.possible() },
        }
    }

    /// What a cause becomes when there is a shutdown for one of these: one that was there before stays.
    #[must_use]
    pub const fn then(self, later: Self) -> Self {
        if self.none { Self { none: false, ..self }.or(later) } else { self }
    }

    /// What the flags of the causes are: the fault of a cause stays shown.
    pub const fn shown(self) -> KnownFaults {
        let only = !self.none && self.faults.bits().is_power_of_two();
        KnownFaults::new(if only { self.faults } else { Faults::NONE }, Faults::ALL.difference(self.faults))
    }
}
