//! Three-valued truth: what can be said of a condition when not everything is seen.

use core::fmt;

use crate::Atoms;
use crate::derives::data;

data!(
    /// True, false, or unknown: Kleene's three values.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
    #[cfg_attr(feature = "serde", serde(rename_all = "lowercase"))]
    pub enum Truth {
        /// It does not hold, whatever the unseen is.
        False,
        /// It may hold or not, as the unseen decides.
        Unknown,
        /// It holds, whatever the unseen is.
        True,
    }
);

impl Truth {
    /// Both hold.
    #[must_use]
    pub const fn and(self, other: Self) -> Self {
        match (self, other) {
            (Self::False, _) | (_, Self::False) => Self::False,
            (Self::True, Self::True) => Self::True,
            _ => Self::Unknown,
        }
    }

    /// At least one holds.
    #[must_use]
    pub const fn or(self, other: Self) -> Self {
        match (self, other) {
            (Self::True, _) | (_, Self::True) => Self::True,
            (Self::False, Self::False) => Self::False,
            _ => Self::Unknown,
        }
    }

    /// What is certain when either of the two may be what happened: they agree, or it is unknown.
    #[must_use]
    pub const fn agree(self, other: Self) -> Self {
        match (self, other) {
            (Self::True, Self::True) => Self::True,
            (Self::False, Self::False) => Self::False,
            _ => Self::Unknown,
        }
    }

    /// It does not hold.
    #[must_use]
    pub const fn not(self) -> Self {
        match self {
            Self::False => Self::True,
            Self::Unknown => Self::Unknown,
            Self::True => Self::False,
        }
    }

    /// Whether this may be so.
    pub const fn allows(self, fact: bool) -> bool {
        matches!((self, fact), (Self::Unknown, _) | (Self::True, true) | (Self::False, false))
    }

    /// Whether this allows all that the other does.
    pub const fn covers(self, other: Self) -> bool {
        matches!((self, other), (Self::Unknown, _) | (Self::True, Self::True) | (Self::False, Self::False))
    }

    /// `true`, `unknown` or `false`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::False => "false",
            Self::Unknown => "unknown",
            Self::True => "true",
        }
    }
}

impl From<bool> for Truth {
    fn from(value: bool) -> Self {
        if value { Self::True } else { Self::False }
    }
}

impl fmt::Display for Truth {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// What is known of all atoms: those known to be true, those known to be false, the rest unknown.
///
/// ```
/// use adsdv_spec::{Atom, Atoms, Knowledge, Truth};
/// let known = Knowledge::NOTHING.learn(Atoms::of(&[Atom::Asms, Atom::Tsms]), Atoms::of(&[Atom::Asms]));
/// assert_eq!(known.of(Atom::Asms), Truth::True);
/// assert_eq!(known.of(Atom::Tsms), Truth::False);
/// assert_eq!(known.of(Atom::SdcOpen), Truth::Unknown);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "Claims"))]
pub struct Knowledge {
    on: Atoms,
    off: Atoms,
}

impl Knowledge {
    /// Nothing is known of any atom.
    pub const NOTHING: Self = Self { on: Atoms::NONE, off: Atoms::NONE };

    /// These atoms are known to be true and those to be false; `None` if one is said to be both.
    ///
    /// ```
    /// use adsdv_spec::{Atom, Atoms, Knowledge};
    /// let asms = Atoms::of(&[Atom::Asms]);
    /// assert!(Knowledge::new(asms, Atoms::NONE).is_some());
    /// assert_eq!(Knowledge::new(asms, asms), None);
    /// ```
    pub const fn new(on: Atoms, off: Atoms) -> Option<Self> {
        if on.intersection(off).is_empty() { Some(Self { on, off }) } else { None }
    }

    /// Everything is known: the atoms of the set are true, all others false.
    pub const fn exact(atoms: Atoms) -> Self {
        Self { on: atoms, off: Atoms::ALL.difference(atoms) }
    }

    /// The atoms known to be true.
    pub const fn on(self) -> Atoms {
        self.on
    }

    /// The atoms known to be false.
    pub const fn off(self) -> Atoms {
        self.off
    }

    /// What is known of one atom.
    pub const fn of(self, atom: crate::Atom) -> Truth {
        if self.on.has(atom) {
            Truth::True
        } else if self.off.has(atom) {
            Truth::False
        } else {
            Truth::Unknown
        }
    }

    /// Whether all of `on` are true and all of `off` are false: false as soon as one is known not to be.
    pub(crate) const fn all_hold(self, on: Atoms, off: Atoms) -> Truth {
        if !on.intersection(self.off).is_empty() || !off.intersection(self.on).is_empty() {
            Truth::False
        } else if on.is_subset(self.on) && off.is_subset(self.off) {
            Truth::True
        } else {
            Truth::Unknown
        }
    }

    /// With the atoms of `scope` now known: true those in `values`, false the others.
    #[must_use]
    pub const fn learn(self, scope: Atoms, values: Atoms) -> Self {
        let on = scope.intersection(values);
        Self {
            on: self.on.difference(scope).union(on),
            off: self.off.difference(scope).union(scope.difference(on)),
        }
    }

    /// With one atom set to a truth value.
    #[must_use]
    pub const fn set(self, atom: crate::Atom, value: Truth) -> Self {
        let scope = Atoms::NONE.with(atom);
        match value {
            Truth::True => self.learn(scope, scope),
            Truth::False => self.learn(scope, Atoms::NONE),
            Truth::Unknown => self.forget(scope),
        }
    }

    /// With the atoms of `scope` unknown again.
    #[must_use]
    pub const fn forget(self, scope: Atoms) -> Self {
        Self { on: self.on.difference(scope), off: self.off.difference(scope) }
    }

    /// What is known when either may be what was in force: only that on which both agree.
    #[must_use]
    pub const fn meet(self, other: Self) -> Self {
        Self { on: self.on.intersection(other.on), off: self.off.intersection(other.off) }
    }

    /// Whether an exact set of atoms is one that this knowledge allows.
    pub const fn allows(self, atoms: Atoms) -> bool {
        self.on.is_subset(atoms) && self.off.intersection(atoms).is_empty()
    }
}

/// What someone says is known, before it is looked at.
#[cfg(feature = "serde")]
#[derive(Default, serde::Deserialize)]
#[serde(rename = "Knowledge", default, deny_unknown_fields)]
struct Claims {
    on: Atoms,
    off: Atoms,
}

/// The atoms that are said to be both true and false.
#[cfg(feature = "serde")]
struct Contradiction(Atoms);

#[cfg(feature = "serde")]
impl fmt::Display for Contradiction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "both on and off: {}; an atom is known to be one of them, or neither", self.0)
    }
}

#[cfg(feature = "serde")]
impl TryFrom<Claims> for Knowledge {
    type Error = Contradiction;

    fn try_from(Claims { on, off }: Claims) -> Result<Self, Contradiction> {
        Self::new(on, off).ok_or(Contradiction(on.intersection(off)))
    }
}

#[cfg(kani)]
impl kani::Arbitrary for Knowledge {
    fn any() -> Self {
        let (on, off): (Atoms, Atoms) = (kani::any(), kani::any());
        Self { on, off: off.difference(on) }
    }
}

#[cfg(feature = "arbitrary")]
impl arbitrary::Arbitrary<'_> for Knowledge {
    fn arbitrary(u: &mut arbitrary::Unstructured<'_>) -> arbitrary::Result<Self> {
        let (on, off): (Atoms, Atoms) = u.arbitrary()?;
        Ok(Self { on, off: off.difference(on) })
    }
}

#[cfg(feature = "proptest")]
impl proptest::arbitrary::Arbitrary for Knowledge {
    type Parameters = ();
    type Strategy =
        proptest::strategy::Map<proptest::arbitrary::StrategyFor<(Atoms, Atoms)>, fn((Atoms, Atoms)) -> Self>;

    fn arbitrary_with((): ()) -> Self::Strategy {
        use proptest::strategy::Strategy;
        proptest::arbitrary::any::<(Atoms, Atoms)>()
            .prop_map(|(on, off)| Self { on, off: off.difference(on) })
    }
}
