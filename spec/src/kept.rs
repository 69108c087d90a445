//! What a step keeps of what it sees: the flags of the memory, each with the conditions under which it is set.

use crate::atoms::{Atom, Atoms};

/// Conditions that are as they must be: all of these hold, and none of those does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Literals {
    /// The atoms that must hold.
    pub on: Atoms,
    /// The atoms that must not hold.
    pub off: Atoms,
}

impl Literals {
    /// No condition at all: it always holds.
    pub(crate) const EVER: Self = Self { on: Atoms::NONE, off: Atoms::NONE };

    pub(crate) const fn and_off(self, atom: Atom) -> Self {
        Self { off: self.off.with(atom), ..self }
    }

    /// Whether these atoms are as they must be.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "as in machine.rs")]
    pub const fn hold(self, atoms: Atoms) -> bool {
        atoms.intersection(self.on.union(self.off)).bits() == self.on.bits()
    }

    /// The same, where there may be none that ever do.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "as in machine.rs")]
    pub(crate) const fn some_hold(some: Option<Self>, atoms: Atoms) -> bool {
        match some {
            Some(literals) => literals.hold(atoms),
            None => false,
        }
    }
}

/// What a step keeps until the next one, by the conditions that its guards saw: each flag of
/// [`Control`](crate::Control) is set when its conditions hold, and never where there are none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Kept {
    /// "Go" is off, and, where it must be seen so while all else is in order, it is (section 3.2, item 3).
    pub go_seen_low: Option<Literals>,
    /// `MISSION_STATUS` is RUNNING.
    pub was_running: Option<Literals>,
    /// `DIRECTION_REQUEST` is FORWARD.
    pub was_forward: Option<Literals>,
}

impl Kept {
    pub(crate) const NOTHING: Self = Self { go_seen_low: None, was_running: None, was_forward: None };

    /// What tells a change from what was there before.
    pub(crate) const OF_EDGES: Self = Self {
        was_running: Some(Literals { on: Atoms::of(&[Atom::MissionRunning]), off: Atoms::NONE }),
        was_forward: Some(Literals::EVER.and_off(Atom::DirectionNeutral)),
        ..Self::NOTHING
    };
}
