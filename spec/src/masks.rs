//! A term, ready to be evaluated.

use crate::atoms::{Atom, Atoms};
use crate::truth::{Knowledge, Truth};

/// A term, ready to be evaluated: of the atoms that count, exactly those that must be on are.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TermMasks {
    on: Atoms,
    /// The atoms that count: those that must hold and those that must not.
    care: Atoms,
}

impl TermMasks {
    /// The term that always holds.
    pub(crate) const EMPTY: Self = Self { on: Atoms::NONE, care: Atoms::NONE };

    pub(crate) const fn new(on: Atoms, off: Atoms) -> Self {
        Self { on, care: on.union(off) }
    }

    pub(crate) const fn without(self, atom: Atom) -> Self {
        Self { on: self.on.without(atom), care: self.care.without(atom) }
    }

    /// The atoms that must hold.
    pub(crate) const fn on(self) -> Atoms {
        self.on
    }

    /// The atoms that count.
    pub(crate) const fn care(self) -> Atoms {
        self.care
    }

    #[inline(always)]
    #[expect(clippy::inline_always, reason = "as in machine.rs")]
    pub(crate) const fn holds(self, atoms: Atoms) -> bool {
        atoms.intersection(self.care).bits() == self.on.bits()
    }

    /// Whether it holds, as far as is known.
    pub(crate) const fn truth(self, known: Knowledge) -> Truth {
        known.all_hold(self.on, self.care.difference(self.on))
    }

    /// What is known when it holds.
    pub(crate) const fn given(self, known: Knowledge) -> Knowledge {
        known.learn(self.care, self.on)
    }

    /// What is known when it does not hold, of one that may: where one condition alone is unknown, that is what fails.
    pub(crate) const fn refuted(self, known: Knowledge) -> Knowledge {
        let unknown = self.care.difference(known.on()).difference(known.off());
        if unknown.bits().is_power_of_two() {
            known.learn(unknown, unknown.difference(self.on))
        } else {
            known
        }
    }
}
