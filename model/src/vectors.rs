//! The input vectors: every combination of the conditions that a step can depend on.

use std::collections::HashMap;
use std::sync::{Arc, PoisonError, RwLock};

use adsdv_spec::messages::AsState;
use adsdv_spec::{Atom, Atoms, Choice, Control, Fault, Faults, Machine, Observation, Reads, Row, Timing};

use crate::cycle::cycle_ms;
use crate::document::Document;
use crate::planes::Words;
use crate::property::Property;

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
    by_reads: RwLock<HashMap<Key, Arc<Words>>>,
}

/// The bits of the atoms and of the faults, and which vectors.
type Key = (u32, u16, Vectors);

impl Cache {
    /// The vectors for what is read.
    pub(crate) fn get(&self, reads: Reads, vectors: Vectors) -> Arc<Words> {
        let key = (u32::from(reads.atoms), u16::from(reads.faults), vectors);
        // What a panic elsewhere left behind is whole: entries are only ever added.
        if let Some(known) = self.by_reads.read().unwrap_or_else(PoisonError::into_inner).get(&key) {
            return Arc::clone(known);
        }
        let made = Arc::new(Words::of(combinations(reads, vectors)));
        self.by_reads.write().unwrap_or_else(PoisonError::into_inner).insert(key, Arc::clone(&made));
        made
    }
}

/// What is varied at a control state: what the machine and the properties read.
pub(crate) fn varied(machine: &Machine, document: &Timing, control: &Control, vectors: Vectors) -> Reads {
    let (from, edition) = (control.state, Document::of_machine(machine).edition);
    let properties_read = |leads: &dyn Fn(AsState) -> bool| {
        let concerned = Property::of(edition, from).iter();
        concerned.fold(Atoms::NONE, |all, (_, property)| all.union(property.reads(control, document, leads)))
    };
    match vectors {
        Vectors::Every => {
            let tables = [&machine.edition().rules.table, &edition.rules.table];
            let mentioned =
                tables.iter().fold(HANDSHAKE, |all, table| all.union(mentioned(table.rows(), from)));
            let edges = machine.readings().is(Choice::FaultEdge);
            let remembered = Atoms::when(Atom::MissionRunning, edges && from != AsState::EmergencyBrake);
            let reads = machine.reads(control, cycle_ms(machine)).atoms;
            let atoms = properties_read(&|_| true).union(mentioned).union(remembered).union(reads);
            Reads {
                atoms: atoms.intersection(machine.scope().union(edition.scope())),
                faults: Observation::FAULTS,
            }
        }
        Vectors::Read | Vectors::Few => {
            let reads = machine.reads(control, cycle_ms(machine));
            let leads = |to| machine.possible(control, cycle_ms(machine)).any(|(row, _)| row.to == to);
            let atoms = properties_read(&leads).union(reads.atoms);
            // A fault of the battery that does not open the circuit is no fault like the others.
            let apart = atoms.has(Atom::SdcOpen) && machine.readings().is(Choice::BmsDriving);
            let atoms = atoms.union(Atoms::when(Atom::BmsFault, apart));
            let opening = if atoms.has(Atom::SdcOpen) { Faults::OPENING } else { Faults::NONE };
            let opening = opening.union(Faults::when(Fault::BmsFault, atoms.has(Atom::BmsFault)));
            let request = Observation::FAULTS.difference(Faults::OPENING);
            let request = if atoms.has(Atom::AiEstop) { request } else { Faults::NONE };
            Reads { atoms, faults: reads.faults.union(opening).union(request) }
        }
    }
}

/// The same, and so many more of the conditions that inputs show.
pub(crate) fn with_further(reads: Reads, count: usize) -> Reads {
    let others = Observation::SCOPE.difference(BY_FAULTS).difference(reads.atoms);
    Reads { atoms: others.iter().take(count).fold(reads.atoms, Atoms::with), ..reads }
}

/// The conditions that the faults decide.
const BY_FAULTS: Atoms = Atoms::of(&[Atom::SdcOpen, Atom::AiEstop, Atom::BmsFault]);

/// The inputs of the handshake.
const HANDSHAKE: Atoms = Atoms::of(&[Atom::Tsms, Atom::AiHandshake]);

/// The conditions that the rows of a state mention, and the inputs behind those that memory has a part in.
fn mentioned(rows: &[Row], from: AsState) -> Atoms {
    let rows = rows.iter().filter(|row| row.from == from);
    let atoms = rows.flat_map(Row::terms).fold(Atoms::NONE, |all, term| all.union(term.on).union(term.off));
    atoms.iter().filter_map(Atom::input).fold(atoms, Atoms::with)
}

/// Every observation that inputs can show and that differs in what is read; what is not read is off.
fn combinations(reads: Reads, vectors: Vectors) -> Vec<Observation> {
    let atoms: Vec<Atom> = reads.atoms.difference(BY_FAULTS).iter().collect();
    // A fault of the battery is a condition of its own where it is read, beside what opens the shutdown circuit.
    let battery = reads.atoms.has(Atom::BmsFault);
    let mut faults: Vec<Faults> = subsets(&reads.faults.iter().collect::<Vec<_>>())
        .map(|faults| faults.into_iter().fold(Faults::NONE, Faults::with))
        .filter(|faults| {
            let opening = faults.intersection(Faults::OPENING);
            let mut opening = if battery { opening.without(Fault::BmsFault) } else { opening }.iter();
            match vectors {
                Vectors::Every => true,
                Vectors::Read => opening.nth(1).is_none(),
                Vectors::Few => opening.all(|fault| fault == Fault::HvilOpenFault),
            }
        })
        .collect();
    if vectors == Vectors::Every {
        // Those that decide the same conditions, and have the same cause, come one after the other.
        faults.sort_by_key(|&faults| class(Observation::new(Atoms::NONE, faults)));
    }
    let seen = subsets(&atoms)
        .map(|atoms| atoms.into_iter().fold(Atoms::NONE, Atoms::with))
        .flat_map(|atoms| faults.iter().map(move |&faults| Observation::new(atoms, faults)))
        .filter(|seen| seen.is_possible());
    let mut seen: Vec<Observation> = seen.collect();
    if vectors == Vectors::Every {
        // So that those of a word come to little that differs.
        seen.sort_by_cached_key(|&seen| class(seen));
    }
    seen
}

/// What the faults of an observation decide, their cause, and what is heard of the AI Computer.
fn class(seen: Observation) -> (Atoms, u8, [bool; 3]) {
    let cause = seen.faults().intersection(Faults::OPENING).cause();
    let heard = Machine::HEARD.map(|atom| seen.atoms().has(atom));
    (seen.atoms().intersection(BY_FAULTS), cause as u8, heard)
}

/// Every subset.
pub(crate) fn subsets<T: Copy>(all: &[T]) -> impl Iterator<Item = Vec<T>> {
    let count = 1_usize << all.len();
    (0..count).map(|bits| {
        all.iter().enumerate().filter(|(place, _)| bits >> place & 1 == 1).map(|(_, &item)| item).collect()
    })
}

#[cfg(test)]
mod tests {
    use std::fmt::Write as _;

    use adsdv_spec::{Edition, Readings};
    use expect_test::expect;

    use super::*;

    /// What is varied when a state begins, and when it has lasted for long.
    #[test]
    fn what_is_varied() {
        let others = Edition::DEFAULT.alternatives();
        let other = Machine::new(*Edition::DEFAULT, others.iter().fold(Readings::DEFAULT, Readings::with));
        let mut text = String::new();
        for (name, machine) in [("default", Machine::REFERENCE), ("other", other)] {
            for vectors in [Vectors::Every, Vectors::Read, Vectors::Few] {
                for state in AsState::ALL {
                    let _ = write!(text, "{name} readings, {vectors:?}, {state}:");
                    for in_state_ms in [0, 15_000] {
                        let control = Control { state, in_state_ms, ..Control::INITIAL };
                        let reads = varied(&machine, &Edition::DEFAULT.rules.timing, &control, vectors);
                        let (atoms, faults) = (reads.atoms.len(), reads.faults.len());
                        let vectors = Cache::default().get(reads, vectors).len();
                        let _ = write!(text, " {atoms} and {faults} in {vectors},");
                    }
                    text.push('\n');
                }
            }
        }
        expect![[r"
            default readings, Every, AS_OFF: 7 and 7 in 14336, 7 and 7 in 14336,
            default readings, Every, AS_READY: 11 and 7 in 57344, 11 and 7 in 57344,
            default readings, Every, AS_DRIVING: 10 and 7 in 21504, 10 and 7 in 21504,
            default readings, Every, EMERGENCY_BRAKE: 4 and 7 in 1792, 4 and 7 in 1792,
            default readings, Every, AS_FINISHED: 6 and 7 in 1792, 6 and 7 in 1792,
            default readings, Read, AS_OFF: 7 and 0 in 128, 7 and 0 in 128,
            default readings, Read, AS_READY: 6 and 7 in 216, 11 and 7 in 6912,
            default readings, Read, AS_DRIVING: 10 and 7 in 2592, 10 and 7 in 2592,
            default readings, Read, EMERGENCY_BRAKE: 3 and 0 in 8, 4 and 0 in 16,
            default readings, Read, AS_FINISHED: 6 and 7 in 216, 6 and 7 in 216,
            default readings, Few, AS_OFF: 7 and 0 in 128, 7 and 0 in 128,
            default readings, Few, AS_READY: 6 and 7 in 64, 11 and 7 in 2048,
            default readings, Few, AS_DRIVING: 10 and 7 in 768, 10 and 7 in 768,
            default readings, Few, EMERGENCY_BRAKE: 3 and 0 in 8, 4 and 0 in 16,
            default readings, Few, AS_FINISHED: 6 and 7 in 64, 6 and 7 in 64,
            other readings, Every, AS_OFF: 8 and 7 in 21504, 8 and 7 in 21504,
            other readings, Every, AS_READY: 12 and 7 in 114688, 12 and 7 in 114688,
            other readings, Every, AS_DRIVING: 11 and 7 in 32256, 11 and 7 in 32256,
            other readings, Every, EMERGENCY_BRAKE: 4 and 7 in 1792, 4 and 7 in 1792,
            other readings, Every, AS_FINISHED: 7 and 7 in 3584, 7 and 7 in 3584,
            other readings, Read, AS_OFF: 7 and 0 in 128, 7 and 0 in 128,
            other readings, Read, AS_READY: 6 and 7 in 216, 11 and 7 in 6912,
            other readings, Read, AS_DRIVING: 11 and 7 in 3888, 11 and 7 in 3888,
            other readings, Read, EMERGENCY_BRAKE: 3 and 0 in 8, 4 and 0 in 16,
            other readings, Read, AS_FINISHED: 6 and 7 in 216, 6 and 7 in 216,
            other readings, Few, AS_OFF: 7 and 0 in 128, 7 and 0 in 128,
            other readings, Few, AS_READY: 6 and 7 in 64, 11 and 7 in 2048,
            other readings, Few, AS_DRIVING: 11 and 7 in 1152, 11 and 7 in 1152,
            other readings, Few, EMERGENCY_BRAKE: 3 and 0 in 8, 4 and 0 in 16,
            other readings, Few, AS_FINISHED: 6 and 7 in 64, 6 and 7 in 64,
        "]]
        .assert_eq(&text);
    }

    #[test]
    fn rows_mention_conditions_and_what_is_behind_them() {
        let mentions = |from| mentioned(Edition::DEFAULT.rules.table.rows(), from);
        assert_eq!(mentions(AsState::EmergencyBrake), Atoms::of(&[Atom::EbsTimerComplete, Atom::Asms]));
        let go = Atoms::of(&[Atom::GoEdge, Atom::GoOn]);
        assert!(
            go.is_subset(mentions(AsState::Ready)) && go.intersection(mentions(AsState::Finished)).is_empty()
        );
    }

    #[test]
    fn every_subset_comes_once() {
        let all: Vec<Vec<u8>> = subsets(&[1, 2, 3]).collect();
        assert_eq!(
            all,
            [vec![], vec![1], vec![2], vec![1, 2], vec![3], vec![1, 3], vec![2, 3], vec![1, 2, 3]]
        );
    }
}
