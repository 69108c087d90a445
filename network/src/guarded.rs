//! The conditions as the guards see them: those of the inputs, and those that the control state decides with them.

use adsdv_spec::{Atom, Atoms, Fault, Faults, Handshake};

use crate::heard::VALUES;
use crate::network::Wired;
use crate::planes::{AtomPlanes, Planes, show};

/// All conditions as the guards see them, and what the handshake answers, in each lane.
#[derive(Clone, Copy, Debug)]
pub struct Guarded {
    pub(crate) atoms: AtomPlanes,
    /// The lanes that come to each of the handshakes.
    pub(crate) heard: [u64; VALUES],
}

impl Guarded {
    /// The lanes in which an atom holds.
    pub const fn atom(&self, atom: Atom) -> u64 {
        self.atoms[atom as usize]
    }
}

impl Wired<'_> {
    /// What the guards see.
    #[inline]
    pub fn guarded(&self, seen: &Planes) -> Guarded {
        let mut atoms = seen.atoms;
        clear(&mut atoms, self.outside);
        atoms[Atom::SdcOpen as usize] &= any(seen, self.opening);
        let (heard, lost) = self.heard.planes(&atoms);
        let mut rest = self.by_input.bits();
        while rest != 0 {
            let place = rest.trailing_zeros() as usize;
            // What no input has a part in would not wait for one.
            let input = Atom::ALL.get(place).and_then(|atom| atom.input());
            atoms[place] = input.map_or(0, |input| atoms[input as usize]);
            rest &= rest - 1;
        }
        let mut rest = self.always.bits();
        while rest != 0 {
            atoms[rest.trailing_zeros() as usize] = u64::MAX;
            rest &= rest - 1;
        }
        atoms[Atom::AiCommsLost as usize] = lost;
        Guarded { atoms, heard }
    }

    /// The handshakes that lanes come to, each with these lanes.
    pub fn handshakes(&self, guarded: &Guarded) -> impl Iterator<Item = (Handshake, u64)> {
        self.heard.handshakes.into_iter().zip(guarded.heard).filter(|(_, lanes)| *lanes != 0)
    }

    /// The lanes in which all of these conditions hold, and none of those. What the control state decides is not looked at.
    #[inline]
    pub(crate) fn hold(&self, guarded: &Guarded, on: Atoms, off: Atoms) -> u64 {
        if !on.intersection(self.never).is_empty() || !off.intersection(self.always).is_empty() {
            return 0;
        }
        show(&guarded.atoms, on.difference(self.always), off.difference(self.never))
    }
}

fn clear(atoms: &mut AtomPlanes, these: Atoms) {
    let mut rest = these.bits();
    while rest != 0 {
        atoms[rest.trailing_zeros() as usize] = 0;
        rest &= rest - 1;
    }
}

/// The lanes that show any of these faults.
fn any(seen: &Planes, faults: Faults) -> u64 {
    let mut lanes = 0;
    let mut place = 0;
    while place < Fault::ALL.len() {
        if faults.has(Fault::ALL[place]) {
            lanes |= seen.fault(Fault::ALL[place]);
        }
        place += 1;
    }
    lanes
}
