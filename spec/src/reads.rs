//! What a step can depend on: the conditions that an arrow, the handshake or the memory can still read.
//!
//! From one control state, observations that agree on these are taken alike, so that an enumeration of observations
//! needs to vary nothing else.

use crate::atoms::{Atom, Atoms};
use crate::control::Control;
use crate::faults::{Fault, Faults};
use crate::machine::{Machine, Taken};
use crate::messages::AsState;
use crate::observation::Observation;
use crate::readings::Choice;
use crate::table::{Row, Term};
use crate::truth::{Knowledge, Truth};

impl Atom {
    /// The input that decides an atom together with the VCU's memory; `None` for all atoms that one of the two decides
    /// alone.
    pub const fn input(self) -> Option<Self> {
        match self {
            Self::GoEdge => Some(Self::GoOn),
            Self::MissionFinishedEdge => Some(Self::MissionFinished),
            Self::DirectionNeutralEdge => Some(Self::DirectionNeutral),
            _ => None,
        }
    }
}

/// What a step can depend on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Reads {
    /// The atoms, of [`Observation::SCOPE`].
    pub atoms: Atoms,
    /// The faults, of [`Observation::FAULTS`]. Of those that open the shutdown circuit only the one with the lowest
    /// number counts, and that of the battery where its atom is read.
    pub faults: Faults,
}

impl Reads {
    /// What is left of an observation when everything that is not read is taken away: the same for all observations
    /// that a step takes alike.
    ///
    /// It need not be an observation that inputs can show.
    #[must_use]
    pub const fn of(&self, seen: Observation) -> Observation {
        let faults = seen.faults().intersection(self.faults);
        let opening = faults.intersection(Faults::OPENING);
        let battery = opening.intersection(Faults::when(Fault::BmsFault, self.atoms.has(Atom::BmsFault)));
        let first = Faults::of_cause(opening.cause()).union(battery);
        Observation::new(seen.atoms().intersection(self.atoms), faults.difference(opening).union(first))
    }
}

impl Machine {
    /// What a step from this control state, `dt_ms` later, can depend on: for all observations of which
    /// [`Reads::of`] leaves the same, the next control state and the row taken are the same.
    ///
    /// ```
    /// use adsdv_spec::{Atom, Control, Machine};
    /// let off = Machine::REFERENCE.reads(&Control::INITIAL, 10);
    /// assert!(off.atoms.has(Atom::EbsArmed)); // AS_OFF is left only with the EBS armed,
    /// assert!(!off.atoms.has(Atom::GoOn)); // and "Go" does not matter there.
    /// ```
    pub fn reads(&self, control: &Control, dt_ms: u32) -> Reads {
        let known = self.known(control, dt_ms);
        let mut atoms = Atoms::of(&[Atom::Tsms, Atom::AiHandshake]);
        if self.readings().is(Choice::HandshakeAlways) {
            atoms = atoms.without(Atom::Tsms);
        }
        // A step into AS_READY arms the "Go" edge, and one into AS_DRIVING remembers what may change.
        let begun = (atoms, control.state == AsState::Ready, control.state == AsState::Driving);
        // A fold and not a loop: for a proof the rows that are gone through are constants then.
        let (mut atoms, ready, driving) =
            self.possible(control, dt_ms).fold(begun, |(atoms, ready, driving), (row, term)| {
                let to = |state| row.to == state;
                (
                    atoms.union(term.on).union(term.off),
                    ready || to(AsState::Ready),
                    driving || to(AsState::Driving),
                )
            });
        if ready {
            atoms = atoms.union(self.arming_reads(known));
        }
        if driving && self.readings().is(Choice::FaultEdge) {
            atoms = atoms.with(Atom::MissionRunning).with(Atom::DirectionNeutral);
        }
        // A message that is missed loses the communication, and nothing else.
        atoms = atoms.union(Atoms::when(Atom::AiMessagesMissed, atoms.has(Atom::AiCommsLost)));
        atoms = atoms.iter().filter_map(Atom::input).fold(atoms, Atoms::with);
        let opening = if atoms.has(Atom::SdcOpen) { Faults::OPENING } else { Faults::NONE };
        let opening = opening.union(Faults::when(Fault::BmsFault, atoms.has(Atom::BmsFault)));
        let request = Faults::when(Fault::AiComputerRequest, atoms.has(Atom::AiEstop));
        Reads { atoms: atoms.intersection(self.scope()), faults: opening.union(request) }
    }

    /// The alternatives that some inputs can make a step from this control state take, in the order of evaluation.
    pub fn possible(&self, control: &Control, dt_ms: u32) -> impl Iterator<Item = (&Row, &Term)> {
        let known = self.known(control, dt_ms);
        let table = &self.edition().rules.table;
        let arrows =
            self.arrows(control.state).filter_map(|taken| Some((taken.row(table)?, taken.term(table)?)));
        arrows.filter(move |(_, term)| term.truth(known) != Truth::False)
    }

    /// Whether [`Machine::possible`] has this alternative: some inputs can make a step from this control state take it. One that
    /// the table or these readings do not have is never taken.
    ///
    /// ```
    /// use adsdv_spec::{AsState, Control, Machine, Taken};
    /// let (vcu, first) = (Machine::REFERENCE, Taken { row: 0, term: 0 }); // from AS_OFF to AS_READY
    /// assert!(vcu.is_possible(&Control::INITIAL, 10, first));
    /// assert!(!vcu.is_possible(&Control { power_cycle_needed: true, ..Control::INITIAL }, 10, first));
    /// ```
    pub fn is_possible(&self, control: &Control, dt_ms: u32, taken: Taken) -> bool {
        let table = &self.edition().rules.table;
        let (Some(row), Some(term)) = (taken.row(table), taken.term(table)) else { return false };
        row.from == control.state
            && term.readings.is_subset(self.readings().choices())
            && term.truth(self.known(control, dt_ms)) != Truth::False
    }

    /// What the control state decides at a step whatever the inputs are.
    fn known(&self, control: &Control, dt_ms: u32) -> Knowledge {
        let least = self.memory_atoms(control, dt_ms, Atoms::NONE);
        let most = self.memory_atoms(control, dt_ms, Atoms::ALL).with(Atom::AiCommsLost);
        let never = Atoms::ALL.difference(Observation::SCOPE).difference(most);
        Knowledge::NOTHING.learn(least.union(never), least)
    }
}
