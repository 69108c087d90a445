//! What is known of an observation.

use crate::atoms::{Atom, Atoms};
use crate::belief::KnownFaults;
use crate::faults::{Fault, Faults};
use crate::observation::Observation;
use crate::truth::{Knowledge, Truth};

/// What is known of an [`Observation`]: of its conditions, and of its faults.
///
/// ```
/// use adsdv_spec::{Atom, Fault, Faults, Knowledge, Truth};
/// use adsdv_spec::belief::{Glimpse, KnownFaults};
///
/// // The flag of a fault that opens the circuit tells that the circuit is open.
/// let faults = KnownFaults::new(Faults::of(&[Fault::HvilOpenFault]), Faults::NONE);
/// let seen = Glimpse::new(Knowledge::NOTHING, faults);
/// assert_eq!(seen.atoms().of(Atom::SdcOpen), Truth::True);
/// assert_eq!(seen.atoms().of(Atom::Asms), Truth::Unknown);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Glimpse {
    atoms: Knowledge,
    faults: KnownFaults,
}

impl Glimpse {
    /// Nothing is known.
    pub const NOTHING: Self = Self::new(Knowledge::NOTHING, KnownFaults::NOTHING);

    /// What is known of the observation when this is known of its conditions and of its faults, each of which tells something of
    /// the other. Where they disagree, what is present and what is on count.
    pub const fn new(atoms: Knowledge, faults: KnownFaults) -> Self {
        let estop = Faults::NONE.with(Fault::AiComputerRequest);
        let bms = Faults::NONE.with(Fault::BmsFault);
        let faults = learn_faults(faults, estop, atoms.of(Atom::AiEstop));
        let faults = learn_faults(faults, bms, atoms.of(Atom::BmsFault));
        let faults = learn_faults(faults, Faults::OPENING, atoms.of(Atom::SdcOpen));
        let present = faults.present().intersection(Observation::FAULTS);
        let never = Faults::ALL.difference(Observation::FAULTS);
        let faults = KnownFaults::new(present, faults.absent().union(never));
        let open = match faults.any_of(Faults::OPENING) {
            Truth::Unknown if atoms.on().has(Atom::SdcOpen) => Truth::True,
            known => known,
        };
        let atoms = atoms
            .learn(Atoms::ALL.difference(Observation::SCOPE), Atoms::NONE)
            .set(Atom::SdcOpen, open)
            .set(Atom::AiEstop, faults.of(Fault::AiComputerRequest))
            .set(Atom::BmsFault, faults.of(Fault::BmsFault));
        Self { atoms, faults }
    }

    /// Everything is known.
    pub const fn exact(seen: Observation) -> Self {
        Self { atoms: Knowledge::exact(seen.atoms()), faults: KnownFaults::exact(seen.faults()) }
    }

    /// What is known of the conditions that inputs decide; all others are off.
    pub const fn atoms(&self) -> Knowledge {
        self.atoms
    }

    /// What is known of the faults that inputs decide; all others are absent.
    pub const fn faults(&self) -> KnownFaults {
        self.faults
    }

    /// Whether this may be what was observed.
    pub const fn allows(&self, seen: Observation) -> bool {
        self.atoms.allows(seen.atoms()) && self.faults.allows(seen.faults())
    }

    /// Whether this allows all that the other does.
    pub const fn covers(&self, other: &Self) -> bool {
        self.atoms.on().is_subset(other.atoms.on())
            && self.atoms.off().is_subset(other.atoms.off())
            && self.faults.covers(other.faults)
    }

    /// What is known when either may be what was so.
    #[must_use]
    pub const fn or(&self, other: &Self) -> Self {
        Self { atoms: self.atoms.meet(other.atoms), faults: self.faults.or(other.faults) }
    }
}

/// What is known of the faults when one of these is present, or none is.
const fn learn_faults(known: KnownFaults, these: Faults, any: Truth) -> KnownFaults {
    let (present, mut absent) = (known.present(), known.absent());
    match any {
        Truth::False => KnownFaults::new(present, absent.union(these)),
        Truth::True if present.intersection(these).is_empty() => {
            // Where none is left that it could be, it may be any of them.
            if these.is_subset(absent) {
                absent = absent.difference(these);
            }
            let left = these.difference(absent);
            let only = if left.bits().is_power_of_two() { left } else { Faults::NONE };
            KnownFaults::new(present.union(only), absent)
        }
        Truth::True | Truth::Unknown => known,
    }
}
