//! What was shown last of each condition, for as long as that is likely to be so still.

use adsdv_spec::{Atom, Atoms, Knowledge};

use crate::judge::SILENCE_NS;

/// For so long a condition counts as it was shown last: then nothing is known of the VCU any more, either.
const FADES_NS: i64 = SILENCE_NS;

/// The changes that count: what an input decides together with memory.
pub(crate) const EDGES: Atoms = {
    let (mut edges, mut place) = (Atoms::NONE, 0);
    while place < Atom::ALL.len() {
        edges = edges.union(Atoms::when(Atom::ALL[place], Atom::ALL[place].input().is_some()));
        place += 1;
    }
    edges
};

/// What was shown last of each condition.
#[derive(Debug)]
pub(super) struct LastKnown {
    known: Knowledge,
    /// What is not known any more.
    unknown: Atoms,
    /// Since when, of these.
    since: [i64; Atom::ALL.len()],
}

impl LastKnown {
    pub(super) const fn new() -> Self {
        Self { known: Knowledge::NOTHING, unknown: Atoms::NONE, since: [0; Atom::ALL.len()] }
    }

    /// What counts at a time when this is known for certain, and the messages of these conditions are late.
    pub(super) fn at(&mut self, t: i64, known: Knowledge, late: Atoms) -> Knowledge {
        let certain = known.on().union(known.off());
        let fading = late.difference(certain);
        // One that was there is over.
        let before = self.known.on().difference(EDGES).union(self.known.off()).intersection(fading);
        self.unknown = self.unknown.difference(certain);
        let mut kept = before;
        for atom in before.iter() {
            let Some(since) = self.since.get_mut(atom as usize) else { continue };
            if !self.unknown.has(atom) {
                *since = t;
            }
            if t.saturating_sub(*since) > FADES_NS {
                kept = kept.without(atom);
            }
        }
        self.unknown = self.unknown.union(before);
        self.known = known.learn(kept, self.known.on());
        self.known
    }

    /// Nothing counts any more.
    pub(super) fn forget(&mut self) {
        *self = Self::new();
    }

    /// What counts, as it was when that was last asked.
    pub(super) const fn all(&self) -> Knowledge {
        self.known
    }
}

#[cfg(test)]
mod tests {
    use adsdv_spec::Truth;

    use super::*;

    #[test]
    fn what_was_shown_counts_for_half_a_second() {
        let mut shown = LastKnown::new();
        let asms = Knowledge::NOTHING.set(Atom::Asms, Truth::True).set(Atom::DwellElapsed, Truth::True);
        assert_eq!(shown.at(0, asms, Atoms::NONE), asms);
        let late = Atoms::NONE.with(Atom::Asms);
        let kept = shown.at(10, Knowledge::NOTHING, late);
        assert_eq!((kept.of(Atom::Asms), kept.of(Atom::DwellElapsed)), (Truth::True, Truth::Unknown));
        assert_eq!(shown.at(10 + FADES_NS, Knowledge::NOTHING, late).of(Atom::Asms), Truth::True);
        assert_eq!(shown.at(11 + FADES_NS, Knowledge::NOTHING, late).of(Atom::Asms), Truth::Unknown);
        let off = Knowledge::NOTHING.set(Atom::Asms, Truth::False);
        assert_eq!(
            shown.at(12 + FADES_NS, off, late).of(Atom::Asms),
            Truth::False,
            "what is certain counts at once"
        );
    }
}
