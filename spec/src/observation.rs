//! What a step sees of the inputs, reduced to what can matter: an [`Observation`].

use crate::atoms::{Atom, Atoms};
use crate::faults::{Fault, Faults};
use crate::messages::{
    Ai2VcuBrake, Ai2VcuDriveF, Ai2VcuDriveR, Ai2VcuStatus, Ai2VcuSteer, SteerAngle, Vcu2AiStatus,
    Vcu2AiWheelSpeeds, Vcu2LogStatus,
};
use crate::silence::AiSilence;

/// What one step sees, reduced to what can matter: the atoms and the faults of the inputs.
///
/// It holds only what inputs can show: no atom that the VCU's memory decides, and the shutdown circuit, the emergency stop
/// request and the battery's fault as the faults have them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(from = "ObservationParts"))]
pub struct Observation {
    atoms: Atoms,
    faults: Faults,
}

/// An observation as it is read: [`Observation::new`] makes it one.
#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct ObservationParts {
    atoms: Atoms,
    faults: Faults,
}

#[cfg(feature = "serde")]
impl From<ObservationParts> for Observation {
    fn from(ObservationParts { atoms, faults }: ObservationParts) -> Self {
        Self::new(atoms, faults)
    }
}

impl Observation {
    /// The atoms that the inputs alone decide.
    pub const SCOPE: Atoms = Vcu2AiStatus::SCOPE
        .union(Vcu2LogStatus::SCOPE)
        .union(Ai2VcuStatus::SCOPE)
        .union(Ai2VcuDriveF::SCOPE)
        .union(Ai2VcuDriveR::SCOPE)
        .union(Ai2VcuSteer::SCOPE)
        .union(Ai2VcuBrake::SCOPE)
        .union(AiSilence::SCOPE)
        .union(SteerAngle::SCOPE)
        .union(Vcu2AiWheelSpeeds::SCOPE)
        .union(Self::OF_FAULTS)
        .with(Atom::GoOn);

    /// The atoms that the faults of the inputs decide, whatever else is said of them.
    pub(crate) const OF_FAULTS: Atoms = Atoms::of(&[Atom::SdcOpen, Atom::AiEstop, Atom::BmsFault]);

    /// The faults that the inputs alone decide.
    pub const FAULTS: Faults = Faults::OPENING.with(Fault::AiComputerRequest);

    /// The observation of these atoms and faults, as far as inputs decide them.
    ///
    /// The faults decide whether the shutdown circuit is open (section 3.5), whether the AI Computer asks for an emergency
    /// stop and whether the battery has a fault, whatever `atoms` says of these three.
    pub const fn new(atoms: Atoms, faults: Faults) -> Self {
        let faults = faults.intersection(Self::FAULTS);
        //= RTE-2 to RTE-8
        let open = !faults.intersection(Faults::OPENING).is_empty();
        let atoms = atoms
            .intersection(Self::SCOPE)
            .difference(Self::OF_FAULTS)
            .union(Atoms::when(Atom::SdcOpen, open))
            .union(Atoms::when(Atom::AiEstop, faults.has(Fault::AiComputerRequest)))
            .union(Atoms::when(Atom::BmsFault, faults.has(Fault::BmsFault)));
        Self { atoms, faults }
    }

    /// The atoms that hold, of [`SCOPE`](Self::SCOPE).
    pub const fn atoms(self) -> Atoms {
        self.atoms
    }

    /// The faults that are present, of [`FAULTS`](Self::FAULTS).
    pub const fn faults(self) -> Faults {
        self.faults
    }
}

#[cfg(kani)]
impl kani::Arbitrary for Observation {
    fn any() -> Self {
        Self::new(kani::any(), kani::any())
    }
}

#[cfg(feature = "arbitrary")]
impl arbitrary::Arbitrary<'_> for Observation {
    fn arbitrary(u: &mut arbitrary::Unstructured<'_>) -> arbitrary::Result<Self> {
        Ok(Self::new(u.arbitrary()?, u.arbitrary()?))
    }
}

#[cfg(feature = "proptest")]
impl proptest::arbitrary::Arbitrary for Observation {
    type Parameters = ();
    type Strategy = proptest::strategy::Map<
        proptest::arbitrary::StrategyFor<(Atoms, Faults)>,
        fn((Atoms, Faults)) -> Self,
    >;

    fn arbitrary_with((): ()) -> Self::Strategy {
        use proptest::strategy::Strategy;
        proptest::arbitrary::any::<(Atoms, Faults)>().prop_map(|(atoms, faults)| Self::new(atoms, faults))
    }
}
