//! The input vectors: every combination of the conditions that a step can depend on.

use std::collections::HashMap;
use std::sync::{Arc, PoisonError, RwLock};

use adsdv_spec::messages::AsState;
use adsdv_spec::{
    Atom, Atoms, Choice, Control, FIGURE_2, Fault, Faults, Machine, Observation, Reads, Row, Timing,
};

use crate::property::Property;
use crate::step::CYCLE_MS;

/// Which input vectors are tried at a control state.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Vectors {
    /// Every combination of all faults and of all conditions that the rows of the state, the handshake and the memory
    /// mention, whether they can matter at this moment or not.
    #[default]
    Every,
    /// Every combination of those that can still matter, and of the faults that open the shutdown circuit one at a time.
    ///
    /// Two lemmas say that this leaves nothing out: `unread` (a step depends only on what
    /// [`Machine::reads`] names) and `first-fault` (of the opening faults only the one with the lowest number counts).
    Read,
    /// As [`Read`](Self::Read), with one fault only that opens the shutdown circuit, by the lemma `which-fault`: the
    /// others differ from it in the `SHUTDOWN_CAUSE` alone.
    Few,
}

/// The vectors of each set of conditions, made once.
#[derive(Debug, Default)]
pub(crate) struct Cache {
    by_reads: RwLock<HashMap<Key, Arc<[Observation]>>>,
}

/// The bits of the atoms and of the faults, and which vectors.
type Key = (u32, u16, Vectors);

impl Cache {
    /// The vectors for what is read.
    pub(crate) fn get(&self, reads: Reads, vectors: Vectors) -> Arc<[Observation]> {
        let key = (u32::from(reads.atoms), u16::from(reads.faults), vectors);
        // What a panic elsewhere left behind is whole: entries are only ever added.
        if let Some(known) = self.by_reads.read().unwrap_or_else(PoisonError::into_inner).get(&key) {
            return Arc::clone(known);
        }
        let made: Arc<[Observation]> = combinations(reads, vectors).into();
        self.by_reads.write().unwrap_or_else(PoisonError::into_inner).insert(key, Arc::clone(&made));
        made
    }
}

/// What is varied at a control state: what the machine and the properties read.
pub(crate) fn varied(machine: &Machine, document: &Timing, control: &Control, vectors: Vectors) -> Reads {
    let from = control.state;
    match vectors {
        Vectors::Every => {
            let tables = [&machine.interface().table, &FIGURE_2];
            let mentioned =
                tables.iter().fold(HANDSHAKE, |all, table| all.union(mentioned(table.rows(), from)));
            let edges = machine.readings().is(Choice::FaultEdge);
            let remembered = Atoms::when(Atom::MissionRunning, edges && from != AsState::EmergencyBrake);
            let reads = machine.reads(control, CYCLE_MS).atoms;
            let atoms =
                properties_read(control, document, |_| true).union(mentioned).union(remembered).union(reads);
            Reads { atoms: atoms.intersection(Observation::SCOPE), faults: Observation::FAULTS }
        }
        Vectors::Read | Vectors::Few => {
            let reads = machine.reads(control, CYCLE_MS);
            let leads = |to| machine.possible(control, CYCLE_MS).any(|(row, _)| row.to == to);
            let atoms = properties_read(control, document, leads).union(reads.atoms);
            let opening = if atoms.has(Atom::SdcOpen) { Faults::OPENING } else { Faults::NONE };
            let request = Observation::FAULTS.difference(Faults::OPENING);
            let request = if atoms.has(Atom::AiEstop) { request } else { Faults::NONE };
            Reads { atoms, faults: reads.faults.union(opening).union(request) }
        }
    }
}

/// The inputs of the handshake.
const HANDSHAKE: Atoms = Atoms::of(&[Atom::Tsms, Atom::AiHandshake]);

/// The conditions that the rows of a state mention, and the inputs behind those that memory has a part in.
fn mentioned(rows: &[Row], from: AsState) -> Atoms {
    let rows = rows.iter().filter(|row| row.from == from);
    let atoms = rows.flat_map(Row::terms).fold(Atoms::NONE, |all, term| all.union(term.on).union(term.off));
    atoms.iter().filter_map(Atom::input).fold(atoms, Atoms::with)
}

fn properties_read(from: &Control, document: &Timing, leads: impl Fn(AsState) -> bool + Copy) -> Atoms {
    let concerned = Property::of(from.state).iter();
    concerned.fold(Atoms::NONE, |all, (_, property)| all.union(property.reads(from, document, leads)))
}

/// Every observation that inputs can show and that differs in what is read; what is not read is off.
fn combinations(reads: Reads, vectors: Vectors) -> Vec<Observation> {
    // The faults decide these two.
    let atoms: Vec<Atom> = reads.atoms.without(Atom::SdcOpen).without(Atom::AiEstop).iter().collect();
    let faults: Vec<Faults> = subsets(&reads.faults.iter().collect::<Vec<_>>())
        .map(|faults| faults.into_iter().fold(Faults::NONE, Faults::with))
        .filter(|faults| {
            let mut opening = faults.intersection(Faults::OPENING).iter();
            match vectors {
                Vectors::Every => true,
                Vectors::Read => opening.nth(1).is_none(),
                Vectors::Few => opening.all(|fault| fault == Fault::HvilOpenFault),
            }
        })
        .collect();
    subsets(&atoms)
        .map(|atoms| atoms.into_iter().fold(Atoms::NONE, Atoms::with))
        .flat_map(|atoms| faults.iter().map(move |&faults| Observation::new(atoms, faults)))
        .filter(|seen| seen.is_possible())
        .collect()
}

/// Every subset.
fn subsets<T: Copy>(all: &[T]) -> impl Iterator<Item = Vec<T>> {
    let count = 1_usize << all.len();
    (0..count).map(|bits| {
        all.iter().enumerate().filter(|(place, _)| bits >> place & 1 == 1).map(|(_, &item)| item).collect()
    })
}
