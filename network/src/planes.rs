//! Up to 64 observations, as words.

use adsdv_spec::{Atom, Atoms, Fault, Faults, Observation};

/// How many lanes a word has.
pub const LANES: usize = u64::BITS as usize;

/// A plane for each bit of [`Atoms`].
pub(crate) type AtomPlanes = [u64; u32::BITS as usize];

/// Up to 64 observations: each atom and each fault as a word, with a bit for each of them.
///
/// ```
/// use adsdv_network::Planes;
/// use adsdv_spec::{Atom, Atoms, Fault, Faults, Observation};
///
/// let open = Observation::new(Atoms::NONE, Faults::NONE.with(Fault::EbsFault));
/// let planes = Planes::of(&[Observation::default(), open]);
/// assert_eq!((planes.atom(Atom::SdcOpen), planes.fault(Fault::EbsFault), planes.lanes()), (0b10, 0b10, 0b11));
/// assert_eq!(planes.seen(1), open);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(kani, derive(kani::Arbitrary))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
pub struct Planes {
    pub(crate) atoms: AtomPlanes,
    /// A plane for each bit of [`Faults`].
    faults: [u64; u16::BITS as usize],
    lanes: u64,
}

impl Planes {
    /// No observation.
    pub const EMPTY: Self =
        Self { atoms: [0; u32::BITS as usize], faults: [0; u16::BITS as usize], lanes: 0 };

    /// These observations, the first in the lowest bit. Those beyond the sixty-fourth are left out.
    pub fn of(seen: &[Observation]) -> Self {
        let lanes = seen.iter().take(LANES).enumerate();
        lanes.fold(Self::EMPTY, |planes, (lane, &seen)| planes.with(lane, seen))
    }

    /// The same with this observation in a lane; there are none from [`LANES`] on.
    #[must_use]
    pub const fn with(mut self, lane: usize, seen: Observation) -> Self {
        if lane >= LANES {
            return self;
        }
        let mut place = 0;
        while place < self.atoms.len() {
            self.atoms[place] = set(self.atoms[place], lane, seen.atoms().bits() >> place & 1 == 1);
            place += 1;
        }
        place = 0;
        while place < self.faults.len() {
            self.faults[place] = set(self.faults[place], lane, seen.faults().bits() >> place & 1 == 1);
            place += 1;
        }
        self.lanes = set(self.lanes, lane, true);
        self
    }

    /// The observation in a lane; where none is, that of nothing.
    pub fn seen(&self, lane: usize) -> Observation {
        let on = |plane: u64| lane < LANES && plane >> lane & 1 == 1;
        let atoms = Atom::ALL.iter().filter(|&&atom| on(self.atom(atom)));
        let faults = Fault::ALL.iter().filter(|&&fault| on(self.fault(fault)));
        let atoms = atoms.fold(Atoms::NONE, |all, &atom| all.with(atom));
        Observation::new(atoms, faults.fold(Faults::NONE, |all, &fault| all.with(fault)))
    }

    /// The lanes that have an observation.
    pub const fn lanes(&self) -> u64 {
        self.lanes
    }

    /// The lanes that show an atom.
    #[inline]
    pub const fn atom(&self, atom: Atom) -> u64 {
        self.atoms[atom as usize]
    }

    /// The lanes that show a fault.
    #[inline]
    pub const fn fault(&self, fault: Fault) -> u64 {
        self.faults[fault as usize]
    }

    /// The lanes that show all of these atoms, and none of those.
    #[inline]
    pub const fn show(&self, on: Atoms, off: Atoms) -> u64 {
        show(&self.atoms, on, off)
    }
}

/// The lanes in which all of these atoms hold, and none of those.
#[inline]
pub(crate) const fn show(planes: &AtomPlanes, on: Atoms, off: Atoms) -> u64 {
    let mut lanes = u64::MAX;
    let mut on = on.bits();
    while on != 0 {
        lanes &= planes[on.trailing_zeros() as usize];
        on &= on - 1;
    }
    let mut off = off.bits();
    while off != 0 {
        lanes &= !planes[off.trailing_zeros() as usize];
        off &= off - 1;
    }
    lanes
}

const fn set(plane: u64, lane: usize, on: bool) -> u64 {
    plane & !(1 << lane) | (on as u64) << lane
}

const _: () = assert!(Atom::ALL.len() <= 32 && Fault::ALL.len() <= 16, "a plane for each");
