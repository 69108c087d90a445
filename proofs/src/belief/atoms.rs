//! The conditions that memory decides.

use adsdv_spec::belief::Memory;
use adsdv_spec::{Atom, Atoms, Knowledge, Observation};

use super::{around, covers};
use crate::prelude::*;

/// **What is known of all conditions allows those that there are**: for every control state that the memory allows, and every
/// condition of the inputs that is allowed, whether the state's time has come and whether communication is lost or not. With all
/// known it is them, and who knows less knows no more of them.
///
/// Requirements: SM-1, DRV-4, ETO-1, HS-9.
#[cfg_attr(kani, kani::proof, kani::unwind(2))]
pub fn conditions_that_memory_decides_are_known() {
    let subject = subject();
    let machine = subject.machine();
    let control = around::any_control();
    let (in_state_ms, comms_lost, inputs): (u16, bool, Atoms) = (kani::any(), kani::any(), kani::any());
    let inputs = inputs.intersection(Observation::SCOPE);
    let atoms = inputs.union(machine.control_atoms(&control, in_state_ms, comms_lost, inputs));

    let elapsed = in_state_ms >= machine.edition().rules.timing.in_state_limit(control.state);
    let (memory, seen) = (around::memory(&control), around::atoms(inputs));
    let known = subject.known_atoms(control.state, &memory, seen, elapsed, comms_lost);
    let exact = memory == Memory::exact(&control) && seen == Knowledge::exact(inputs);
    kani::cover!(!exact && atoms.has(Atom::GoEdge), "not all is known, and the edge of \"Go\" counts");
    kani::cover!(exact && atoms.has(Atom::EbsTimerComplete), "all is known, and the time has come");
    assert!(known.allows(atoms), "what is so may be");
    assert!(!exact || known == Knowledge::exact(atoms), "all stays known");

    let less = around::more_memories(memory);
    let less = subject.known_atoms(control.state, &less, seen.forget(kani::any()), elapsed, comms_lost);
    assert!(covers(less, known), "who knows less allows as much");
}

theorems![conditions_that_memory_decides_are_known];
