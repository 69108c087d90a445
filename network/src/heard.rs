//! What is heard of the AI Computer: a function of three conditions, so that a table of eight values has all of it.

use adsdv_spec::{Atom, Atoms, Handshake, Machine};

use crate::planes::AtomPlanes;

/// How many values [`Machine::HEARD`] can have.
pub(crate) const VALUES: usize = 1 << Machine::HEARD.len();

/// [`Machine::hear`] from one handshake, for each value of the conditions by which it goes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Heard {
    /// The handshakes afterwards, each once.
    pub(crate) handshakes: [Handshake; VALUES],
    /// Of each value, which of them it is.
    which: [u8; VALUES],
    /// The values at which communication is lost, a bit each.
    lost: u8,
    /// How many values there are: conditions that the edition does not have are the last, and off.
    values: usize,
}

impl Heard {
    pub(crate) fn of(machine: &Machine, before: Handshake, dt_ms: u32) -> Self {
        let mut heard =
            Self { handshakes: [Handshake::IDLE; VALUES], which: [0; VALUES], lost: 0, values: VALUES };
        while heard.values > 1 && !machine.scope().has(Machine::HEARD[heard.values.ilog2() as usize - 1]) {
            heard.values /= 2;
        }
        let mut distinct = 0;
        let mut value = 0;
        while value < heard.values {
            let (handshake, lost) = machine.hear(before, atoms(value), dt_ms);
            let mut which = 0;
            while which < distinct && heard.handshakes[which] != handshake {
                which += 1;
            }
            heard.handshakes[which] = handshake;
            distinct = distinct.max(which + 1);
            heard.which[value] = which as u8;
            heard.lost |= u8::from(lost) << value;
            value += 1;
        }
        heard
    }

    /// Whether anything that is heard loses the communication.
    pub(crate) const fn can_be_lost(&self) -> bool {
        self.lost != 0
    }

    /// The lanes that come to each handshake, and those in which communication is lost.
    #[inline]
    pub(crate) fn planes(&self, atoms: &AtomPlanes) -> ([u64; VALUES], u64) {
        let mut of = [0; VALUES];
        let mut lost = 0;
        let mut value = 0;
        while value < self.values {
            let mut lanes = u64::MAX;
            let mut place = 0;
            while place < Machine::HEARD.len() {
                let shown = atoms[Machine::HEARD[place] as usize];
                lanes &= if value >> place & 1 == 1 { shown } else { !shown };
                place += 1;
            }
            of[self.which[value] as usize % VALUES] |= lanes;
            lost |= if self.lost >> value & 1 == 1 { lanes } else { 0 };
            value += 1;
        }
        (of, lost)
    }
}

/// The conditions that hold at a value: a bit for each.
fn atoms(value: usize) -> Atoms {
    let places = Machine::HEARD.iter().enumerate();
    places.fold(Atoms::NONE, |all, (place, &atom): (usize, &Atom)| {
        all.union(Atoms::when(atom, value >> place & 1 == 1))
    })
}
