//! Input vectors for machine words: each atom is a bit for each of 64 vectors, so that one instruction asks all of them.

use std::ops::Deref;

use adsdv_spec::{Atom, Atoms, Observation};

/// Input vectors, in words of 64.
#[derive(Debug)]
pub(crate) struct Words {
    seen: Vec<Observation>,
    planes: Vec<Planes>,
}

/// Of so many vectors a machine word has one bit each.
pub(crate) const WORD: usize = u64::BITS as usize;

/// Which of the vectors of a word show each atom: bit by bit in the order of the vectors.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Planes([u64; Atom::ALL.len()]);

impl Words {
    pub(crate) fn of(seen: Vec<Observation>) -> Self {
        let planes = seen.chunks(WORD).map(Planes::of).collect();
        Self { seen, planes }
    }

    /// The words, one after the other: up to 64 vectors each.
    pub(crate) fn words(&self) -> impl Iterator<Item = (&[Observation], &Planes)> {
        self.seen.chunks(WORD).zip(&self.planes)
    }
}

impl FromIterator<Observation> for Words {
    fn from_iter<I: IntoIterator<Item = Observation>>(seen: I) -> Self {
        Self::of(seen.into_iter().collect())
    }
}

/// The vectors, one by one.
impl Deref for Words {
    type Target = [Observation];

    fn deref(&self) -> &[Observation] {
        &self.seen
    }
}

impl Planes {
    fn of(word: &[Observation]) -> Self {
        let plane = |atom: &Atom| {
            let shows = |(place, seen): (usize, &Observation)| u64::from(seen.atoms().has(*atom)) << place;
            word.iter().enumerate().map(shows).fold(0, |plane, bit| plane | bit)
        };
        let mut planes = [0; Atom::ALL.len()];
        planes.iter_mut().zip(Atom::ALL).for_each(|(place, atom)| *place = plane(atom));
        Self(planes)
    }

    /// Which vectors show all of these atoms, and none of those.
    pub(crate) fn show(&self, on: Atoms, off: Atoms) -> u64 {
        let plane = |atom: Atom| self.0.get(atom as usize).copied().unwrap_or_default();
        let all = on.iter().fold(u64::MAX, |all, atom| all & plane(atom));
        off.iter().fold(all, |all, atom| all & !plane(atom))
    }
}

#[cfg(test)]
mod tests {
    use adsdv_spec::Faults;

    use super::*;

    #[test]
    fn a_word_shows_what_its_vectors_show() {
        let seen = |atoms: &[Atom]| Observation::new(Atoms::of(atoms), Faults::NONE);
        let (one, other) = (seen(&[Atom::Asms]), seen(&[Atom::Asms, Atom::Tsms]));
        let vectors: Words = (0..70).map(|place| if place % 3 == 0 { one } else { other }).collect();
        let shows = |on: &[Atom], off: &[Atom]| -> Vec<usize> {
            let words = vectors.words().enumerate();
            let bits = |(word, (_, planes)): (usize, (_, &Planes))| {
                let bits = planes.show(Atoms::of(on), Atoms::of(off));
                (0..64).filter(move |bit| bits >> bit & 1 == 1).map(move |bit| word * 64 + bit)
            };
            words.flat_map(bits).filter(|&place| place < vectors.len()).collect()
        };
        let every = |third: bool| (0..70).filter(|place| (place % 3 == 0) == third).collect::<Vec<_>>();
        assert_eq!(shows(&[Atom::Asms], &[Atom::Tsms]), every(true));
        assert_eq!(shows(&[Atom::Tsms], &[]), every(false));
        assert!(shows(&[], &[Atom::Asms]).is_empty());
    }
}
